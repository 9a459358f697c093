// Files of models: a new one, and the one to run.

import { basename } from "node:path";

import * as vscode from "vscode";

/** Pattern of all models in the workspace. */
export const MODELS = "**/*.swarm";

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
  await vscode.window.showTextDocument(file, { preview: false });
}

/** The model of the workspace; the user chooses if there are several. */
export async function chooseModel(): Promise<vscode.Uri | undefined> {
  const found = await vscode.workspace.findFiles(MODELS);
  if (!found.length) {
    const create = "New Project...";
    const answer = await vscode.window.showInformationMessage("There is no .swarm file here.", create);
    if (answer) {
      await vscode.commands.executeCommand("swarmdsl.newProject");
    }
  }
  if (found.length <= 1) {
    return found[0];
  }
  const items = found
    .map((uri) => ({ label: vscode.workspace.asRelativePath(uri), uri }))
    .sort((one, other) => one.label.localeCompare(other.label));
  return (await vscode.window.showQuickPick(items, { title: "Model" }))?.uri;
}

/** Package name for a name of a file or folder. */
export function packageName(file: string): string {
  const name = file.toLowerCase().replace(/\W+/g, "_").replace(/^_+|_+$/g, "");
  return /^[a-z]/.test(name) ? name : `model_${name}`.replace(/_$/, "");
}
