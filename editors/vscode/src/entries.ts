// Entries of a folder in which a project can be created.

/** True if `swarmc new` ignores an entry: settings of tools, but no file that it writes. */
export function isHidden(name: string): boolean {
  return name.startsWith(".") && name !== ".gitignore";
}
