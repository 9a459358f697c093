// Folders of a project, and what may be in them.

import { dirname, join } from "node:path";

/** True if `swarmc new` ignores an entry: settings of tools, but no file that it writes. */
export function isHidden(name: string): boolean {
  return name.startsWith(".") && name !== ".gitignore";
}

/** Folders with scenarios for a model: its own, and those that projects have. */
export function scenarioFolders(model: string): string[] {
  const folder = dirname(model);
  return [folder, join(folder, "scenarios"), join(dirname(folder), "scenarios")];
}
