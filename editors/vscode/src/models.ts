// Command that creates a new model.

import { basename } from "node:path";

import * as vscode from "vscode";

/** Ask for a file, write a template to it, and open it. */
export async function newModel(extension: vscode.Uri): Promise<void> {
  const [folder] = vscode.workspace.workspaceFolders ?? [];
  const chosen = await vscode.window.showSaveDialog({
    title: "New Model",
    saveLabel: "Create",
    filters: { Swarm: ["swarm"] },
    ...(folder && { defaultUri: vscode.Uri.joinPath(folder.uri, "model.swarm") }),
  });
  if (!chosen) {
    return;
  }
  const template = vscode.Uri.joinPath(extension, "templates", "model.swarm");
  const text = new TextDecoder().decode(await vscode.workspace.fs.readFile(template));
  const file = chosen.path.endsWith(".swarm") ? chosen : chosen.with({ path: `${chosen.path}.swarm` });
  const made = text.replace(/^package \w+/m, `package ${packageName(basename(file.path, ".swarm"))}`);
  await vscode.workspace.fs.writeFile(file, new TextEncoder().encode(made));
  await vscode.window.showTextDocument(file);
}

/** Package name for a file name. */
function packageName(file: string): string {
  const name = file.toLowerCase().replace(/\W+/g, "_").replace(/^_+|_+$/g, "");
  return /^[a-z]/.test(name) ? name : `model_${name}`.replace(/_$/, "");
}
