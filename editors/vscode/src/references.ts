// The command behind what stands above a declaration: how often it is used, and where.

import * as vscode from "vscode";

/** A place as the language server names it. */
export interface Place {
  readonly uri: string;
  readonly range: { readonly start: At; readonly end: At };
}
interface At {
  readonly line: number;
  readonly character: number;
}

/** Show where something is used that is declared at a place in a file. */
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
