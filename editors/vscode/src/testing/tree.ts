// Items of the Test view: test files of the workspace, and their tests.

import * as vscode from "vscode";

import { Texts } from "./columns.ts";
import { absolute } from "./process.ts";
import { described, type FileRecord, type Problem, type TestRecord } from "./records.ts";

/** Identity of a test; `file` is its path as `swarmc` tells it. */
interface Known {
  readonly id: string;
  readonly file: string;
}

export class Tree {
  private readonly controller: vscode.TestController;
  // swarmc ids of tests; an item of a file has none.
  private readonly tests = new WeakMap<vscode.TestItem, Known>();

  constructor(controller: vscode.TestController) {
    this.controller = controller;
  }

  /** All files. */
  get files(): vscode.TestItem[] {
    return [...this.controller.items].map(([, item]) => item);
  }

  /** Item that the tree has now for one that it had; undefined if there is none any more. */
  current(item: vscode.TestItem): vscode.TestItem | undefined {
    const file = item.uri && this.controller.items.get(item.uri.toString());
    return item.id === file?.id ? file : file?.children.get(item.id);
  }

  /** True if a file of the tree is in a folder. */
  isBelow({ path }: vscode.Uri): boolean {
    return this.files.some(({ uri }) => uri?.path.startsWith(`${path}/`));
  }

  /** Identity of a test; undefined of a file. */
  testOf(item: vscode.TestItem): Known | undefined {
    return this.tests.get(item);
  }

  /** Item of a test that swarmc names; created if it is new. */
  item(
    { id, name, file, line, column }: Omit<TestRecord, "type" | "subject" | "problems">,
    texts: Texts,
  ): vscode.TestItem {
    const uri = vscode.Uri.file(file);
    const parent = this.file(uri);
    const known = parent.children.get(id);
    const item = known ?? this.controller.createTestItem(id, name, uri);
    const at = texts.position(uri.fsPath, line, column);
    const start = new vscode.Position(at.line, at.character);
    item.range = new vscode.Range(start, start);
    item.sortText = String(line).padStart(8, "0");
    this.tests.set(item, { id, file });
    if (!known) {
      parent.children.add(item);
    }
    return item;
  }

  /** Item of a file; created if it is new. */
  file(uri: vscode.Uri): vscode.TestItem {
    const known = this.controller.items.get(uri.toString());
    if (known) {
      return known;
    }
    const label = vscode.workspace.asRelativePath(uri);
    const item = this.controller.createTestItem(uri.toString(), label, uri);
    this.controller.items.add(item);
    return item;
  }

  /** Show what a list has; tests and files that it does not have leave the tree. */
  show(records: readonly (FileRecord | TestRecord)[]): void {
    const texts = new Texts();
    const found = new Map<vscode.TestItem, vscode.TestItem[]>();
    for (const record of records) {
      const parent = this.file(vscode.Uri.file(record.file));
      const tests = found.get(parent) ?? [];
      found.set(parent, tests);
      if (record.type === "file") {
        parent.error = problemText(record.problems.filter(() => !record.read));
        continue;
      }
      const item = this.item(record, texts);
      item.error = problemText(record.problems);
      item.description = record.subject?.name ?? "";
      tests.push(item);
    }
    for (const [parent, tests] of found) {
      parent.children.replace(tests);
    }
    this.controller.items.replace([...found.keys()]);
  }

  /** Show files of which nothing else is known, with the reason. */
  explain(files: readonly vscode.Uri[], why: string): void {
    const items = files.map((uri) => this.file(uri));
    this.controller.items.replace(items);
    items.forEach((item) => (item.error = why));
  }
}

/** Text of problems, errors first; undefined without any. */
function problemText(problems: readonly Problem[]): string | undefined {
  const isError = ({ severity }: Problem): boolean => severity === "error";
  const sorted = [...problems.filter(isError), ...problems.filter((each) => !isError(each))];
  return sorted.length ? sorted.map(described).join("\n\n") : undefined;
}

/** Place of a problem; undefined without one. */
export function locationOf(problem: Problem, texts: Texts): vscode.Location | undefined {
  const { file, line, column, end_line, end_column } = problem;
  if (file === null || line === null || column === null) {
    return undefined;
  }
  const uri = vscode.Uri.file(absolute(file));
  const start = texts.position(uri.fsPath, line, column);
  const end = texts.position(uri.fsPath, end_line ?? line, end_column ?? column);
  const range = new vscode.Range(start.line, start.character, end.line, end.character);
  return new vscode.Location(uri, range);
}
