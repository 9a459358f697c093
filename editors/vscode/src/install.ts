// Command that installs swarmc for a Python, with pip in a terminal.

import { join } from "node:path";

import * as vscode from "vscode";

import { askInterpreter, BROWSE, type Choice, storeInterpreter } from "./interpreter.ts";
import { INTERPRETER_SETTING, isRecent, OLDEST, PATH_SETTING } from "./launch.ts";
import { interpreterIn, onPath, probe } from "./probe.ts";
import type { Server } from "./server.ts";
import { finished } from "./tasks.ts";

// The choice of an environment that does not exist yet.
const NEW = "new";

/** Ask for a Python and for consent, install the sources that the extension brings, and use them. */
export async function install(server: Server, extension: vscode.Uri): Promise<void> {
  const [folder] = vscode.workspace.isTrusted ? (vscode.workspace.workspaceFolders ?? []) : [];
  const environment = folder && join(folder.uri.fsPath, ".venv");
  const isNew = environment !== undefined && !(await interpreterIn(environment));
  const first: Choice[] = isNew
    ? [{ label: "$(add) New environment", detail: environment, interpreter: NEW }, BROWSE]
    : [BROWSE];
  const chosen = await askInterpreter("Python to install swarmc for", first);
  if (!chosen) {
    return;
  }
  const creator = chosen === NEW ? await recentPython() : chosen;
  if (creator === undefined) {
    void vscode.window.showErrorMessage(`There is no Python ${OLDEST.join(".")} or later on the PATH.`);
    return;
  }
  const archive = vscode.Uri.joinPath(extension, "swarmdsl.zip").fsPath;
  const created = chosen === NEW && environment !== undefined ? environment : undefined;
  const pip = ["-m", "pip", "install", "--upgrade", archive];
  const steps = created
    ? [`${creator} -m venv ${created}`, `pip install ${archive}, in this environment`]
    : [`${creator} ${pip.join(" ")}`];
  const detail = `A terminal runs:\n${steps.join("\n")}\n\npip fetches the packages that swarmc needs.`;
  const answer = await vscode.window.showInformationMessage(
    "Install swarmc?",
    { modal: true, detail },
    "Install",
  );
  if (!answer || (created && !(await succeeds("create the environment", creator, ["-m", "venv", created])))) {
    return;
  }
  const interpreter = created ? await interpreterIn(created) : creator;
  if (interpreter && (await succeeds("install swarmc", interpreter, pip))) {
    const settings = vscode.workspace.getConfiguration();
    // The search finds the new one, unless a setting names another.
    if (!created || settings.get(PATH_SETTING) || settings.get(INTERPRETER_SETTING)) {
      await storeInterpreter(interpreter);
    }
    await server.refresh();
    void vscode.window.showInformationMessage(`swarmc is installed for ${interpreter}.`);
  }
}

/** The first Python on the PATH that swarmc can run with. */
async function recentPython(): Promise<string | undefined> {
  for (const interpreter of await onPath("python3", "python")) {
    const python = await probe.python(interpreter);
    if (python && isRecent(python)) {
      return interpreter;
    }
  }
  return undefined;
}

/** Run a program in a terminal, which says why it fails; return true if it ends with 0. */
async function succeeds(name: string, program: string, args: string[]): Promise<boolean> {
  const task = new vscode.Task(
    { type: "swarmdsl", command: "install" },
    vscode.TaskScope.Workspace,
    name,
    "swarmc",
    // Python imports modules from its working directory.
    new vscode.ProcessExecution(program, args, { cwd: __dirname }),
  );
  return (await finished(task)) === 0;
}
