// Commands of the language server that show references, or rename what a refactoring has made.

import * as vscode from "vscode";

/** Location sent by the language server. */
export interface Place {
  readonly uri: string;
  readonly range: { readonly start: At; readonly end: At };
}
export interface At {
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

/** Let the user rename what is at a position. */
export async function renameAt(file: string, at: At): Promise<void> {
  await vscode.commands.executeCommand("editor.action.rename", [vscode.Uri.parse(file), position(at)]);
}

function position({ line, character }: At): vscode.Position {
  return new vscode.Position(line, character);
}
