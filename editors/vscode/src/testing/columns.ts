// Places in files that swarmc names, as those of the editor.

import { readFileSync } from "node:fs";

/** Position that counts from 0, in the UTF-16 units of the editor. */
export interface Position {
  readonly line: number;
  readonly character: number;
}

/** Units before a column of a line; columns count from 1, in characters. */
export function unitsBefore(line: string, column: number): number {
  let units = 0;
  for (let left = column - 1; left > 0; left--) {
    units += (line.codePointAt(units) ?? 0) > 0xffff ? 2 : 1;
  }
  return units;
}

/** Files that the records of a list or a run name, each read once. */
export class Texts {
  // Lines of a file; none if units are characters in all of it, or it cannot be read.
  private readonly lines = new Map<string, readonly string[]>();

  /** Position of a line and a column, counted from 1, in the file of a path. */
  position(path: string, line: number, column: number): Position {
    const lines = this.lines.get(path) ?? wideLines(path);
    this.lines.set(path, lines);
    return { line: line - 1, character: unitsBefore(lines[line - 1] ?? "", column) };
  }
}

function wideLines(path: string): string[] {
  try {
    const text = readFileSync(path, "utf8");
    return /[\ud800-\udbff]/.test(text) ? text.split("\n") : [];
  } catch {
    return []; // it is gone meanwhile
  }
}
