// Command of the references lens.

import * as vscode from "vscode";

/** Location sent by the language server. */
export interface Place {
  readonly uri: string;
  readonly range: { readonly start: At; readonly end: At };
}
interface At {
  readonly line: number;
  readonly character: number;
}

/** Show the references to the declaration at a position. */
export async function showReferences(
  file: string,
  at: At,
  places: readonly Place[],
): Promise<void> {
  await vscode.commands.executeCommand(
    "editor.action.showReferences",
    vscode.Uri.parse(file),
    position(at),
    places.map(
      ({ uri, range: { start, end } }) =>
        new vscode.Location(
          vscode.Uri.parse(uri),
          new vscode.Range(position(start), position(end)),
        ),
    ),
  );
}

function position({ line, character }: At): vscode.Position {
  return new vscode.Position(line, character);
}
