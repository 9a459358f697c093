// Diagnostics of TOML files that a checker of schemas has too.

/** Part of a diagnostic; lines count from 0. */
export interface Found {
  readonly source?: string | undefined;
  readonly code?: unknown;
  readonly range: { readonly start: { readonly line: number } };
}

const SOURCE = "swarmc";
// No TOML, an unknown key, a wrong value, a missing key: names of the model are in no schema.
const IN_SCHEMAS = new Set(["SW0011", "SW0012", "SW0013", "SW1008"]);

/** Diagnostics of swarmc without those at a line where another extension reports something. */
export function withoutRepeated<Kind extends Found>(own: readonly Kind[], all: readonly Found[]): Kind[] {
  const lines = new Set(all.filter(({ source }) => source !== SOURCE).map(({ range }) => range.start.line));
  return own.filter((each) => !(IN_SCHEMAS.has(codeOf(each)) && lines.has(each.range.start.line)));
}

function codeOf({ code }: Found): string {
  const value = typeof code === "object" && code && "value" in code ? code.value : code;
  return String(value);
}
