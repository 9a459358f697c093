// States and transitions that tests cover, as the gutter of the editor shows them.

import * as vscode from "vscode";

import type { Texts } from "./columns.ts";
import { absolute } from "./process.ts";
import type { CoverageRecord, Element } from "./records.ts";

interface Found {
  readonly states: Element[];
  readonly transitions: Element[];
}

/** Coverage of a file. Its share is that of `swarmc test --coverage`. */
export class SwarmCoverage extends vscode.FileCoverage {
  readonly details: readonly vscode.FileCoverageDetail[];

  constructor(uri: vscode.Uri, { states, transitions }: Found, texts: Texts) {
    const rangeOf = ({ line, column, end_line, end_column }: Element): vscode.Range => {
      const start = texts.position(uri.fsPath, line, column);
      const end = texts.position(uri.fsPath, end_line, end_column);
      return new vscode.Range(start.line, start.character, end.line, end.character);
    };
    const all = [...states, ...transitions];
    super(uri, new vscode.TestCoverageCount(all.filter(({ reached }) => reached).length, all.length));
    this.details = [
      // The gutter shows statements; the view of the coverage lists declarations.
      ...all.map((each) => new vscode.StatementCoverage(each.reached, rangeOf(each))),
      ...states.map((each) => new vscode.DeclarationCoverage(each.name, each.reached, rangeOf(each))),
    ];
  }
}

/** Coverage of each file that has states or transitions. */
export function coverageOf(records: readonly CoverageRecord[], texts: Texts): SwarmCoverage[] {
  const files = new Map<string, Found>();
  const add = (kind: keyof Found, elements: readonly Element[]): void => {
    for (const each of elements) {
      if (each.file !== null) {
        const path = absolute(each.file);
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
  return [...files].map(([path, found]) => new SwarmCoverage(vscode.Uri.file(path), found, texts));
}
