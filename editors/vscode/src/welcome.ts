// Welcome view of a workspace without models, and the start with the first model.

import * as vscode from "vscode";

import { MODELS } from "./models.ts";

// Key in the `when` clause of the view.
const NO_MODELS = "swarmdsl.noModels";

/** Show the view while there is no model; call `start` once, with the first model or open file. */
export function welcome(start: () => void): vscode.Disposable {
  let isStarted = false;
  const startOnce = (): void => {
    if (!isStarted) {
      isStarted = true;
      start();
    }
  };
  const show = async (hasModels: boolean): Promise<void> => {
    await vscode.commands.executeCommand("setContext", NO_MODELS, !hasModels && hasFolders());
    if (hasModels) {
      startOnce();
    }
  };
  const search = async (): Promise<void> => {
    const { findFiles } = vscode.workspace;
    const hasModels = (await findFiles(MODELS, undefined, 1)).length > 0;
    await show(hasModels);
    if (!hasModels && hasFolders() && !(await findFiles("**/*", undefined, 1)).length) {
      // Views in the explorer begin folded. In an empty folder, there is nothing else to see.
      await vscode.commands.executeCommand("swarmdsl.welcome.focus");
    }
  };
  const startWith = (document: vscode.TextDocument): void =>
    document.languageId === "swarm" ? startOnce() : undefined;
  const files = vscode.workspace.createFileSystemWatcher(MODELS, false, true, false);
  vscode.workspace.textDocuments.forEach(startWith);
  void search();
  return vscode.Disposable.from(
    files,
    files.onDidCreate(() => show(true)),
    files.onDidDelete(search),
    vscode.workspace.onDidChangeWorkspaceFolders(search),
    vscode.workspace.onDidOpenTextDocument(startWith),
    // An empty tree: its welcome content is in the manifest.
    vscode.window.registerTreeDataProvider<never>("swarmdsl.welcome", {
      getTreeItem: (element) => element,
      getChildren: () => [],
    }),
  );
}

function hasFolders(): boolean {
  return Boolean(vscode.workspace.workspaceFolders?.length);
}
