// Mistakes in test files, in the problems view: the language server reads models only.

import * as vscode from "vscode";

import { described, type FileRecord, type TestRecord } from "./records.ts";
import { locationOf } from "./tree.ts";

/** Show the mistakes of listed files; those of their models are the language server's. */
export function showMistakes(
  collection: vscode.DiagnosticCollection,
  records: readonly (FileRecord | TestRecord)[],
  folder: string,
): void {
  collection.clear();
  for (const record of records) {
    const uri = vscode.Uri.file(record.file);
    const found = (record.type === "file" ? record.problems : []).flatMap((problem) => {
      const place = locationOf(problem, folder);
      if (place?.uri.toString() !== uri.toString()) {
        return [];
      }
      const severity = problem.severity === "error" ? "Error" : "Warning";
      return new vscode.Diagnostic(place.range, described(problem), vscode.DiagnosticSeverity[severity]);
    });
    collection.set(uri, found);
  }
}
