// States and transitions that tests cover, as the gutter of the editor shows them.

import * as vscode from "vscode";

import type { CoverageRecord, Element } from "./records.ts";
import { absolute } from "./tree.ts";

interface Found {
  readonly states: Element[];
  readonly transitions: Element[];
}

/** Coverage of a file. Its share is that of `swarmc test --coverage`. */
export class SwarmCoverage extends vscode.FileCoverage {
  readonly details: readonly vscode.FileCoverageDetail[];

  constructor(uri: vscode.Uri, { states, transitions }: Found) {
    const all = [...states, ...transitions];
    super(uri, new vscode.TestCoverageCount(all.filter(({ reached }) => reached).length, all.length));
    this.details = [
      // The gutter shows statements; the view of the coverage lists declarations.
      ...all.map((each) => new vscode.StatementCoverage(each.reached, rangeOf(each))),
      ...states.map((each) => new vscode.DeclarationCoverage(each.name, each.reached, rangeOf(each))),
    ];
  }
}

/** Coverage of each file that has states or transitions; paths are relative to a folder. */
export function coverageOf(records: readonly CoverageRecord[], folder: string): SwarmCoverage[] {
  const files = new Map<string, Found>();
  const add = (kind: keyof Found, elements: readonly Element[]): void => {
    for (const each of elements) {
      if (each.file !== null) {
        const path = absolute(each.file, folder);
        const found = files.get(path) ?? { states: [], transitions: [] };
        found[kind].push(each);
        files.set(path, found);
      }
    }
  };
  for (const { states, transitions } of records) {
    add("states", states);
    add("transitions", transitions);
  }
  return [...files].map(([path, found]) => new SwarmCoverage(vscode.Uri.file(path), found));
}

function rangeOf({ line, column, end_line, end_column }: Element): vscode.Range {
  return new vscode.Range(line - 1, column - 1, end_line - 1, end_column - 1);
}
