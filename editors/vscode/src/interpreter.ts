// Command that selects the interpreter for swarmc.

import * as vscode from "vscode";

import { interpreterIn, onPath, probe } from "./probe.ts";
import { selectedInterpreter } from "./python.ts";
import { INTERPRETER_SETTING, PATH_SETTING } from "./launch.ts";

interface Choice extends vscode.QuickPickItem {
  readonly interpreter: string | undefined;
}

const AUTOMATIC: Choice = {
  label: "$(search) Find automatically",
  detail: "Python extension, .venv or PATH; else the bundled server",
  interpreter: "",
};
const BROWSE: Choice = { label: "$(folder-opened) Browse...", interpreter: undefined };

/** Ask for an interpreter; store it for the workspace, or for the user without one. */
export async function selectInterpreter(): Promise<void> {
  const chosen = await vscode.window.showQuickPick(choices(), {
    title: "Select the Python for swarmc",
    placeHolder: "Interpreter with the package swarmdsl, or any Python 3.10 or later",
  });
  if (!chosen) {
    return;
  }
  const interpreter = chosen.interpreter ?? (await browse());
  if (interpreter === undefined) {
    return;
  }
  const target = vscode.workspace.workspaceFolders?.length
    ? vscode.ConfigurationTarget.Workspace
    : vscode.ConfigurationTarget.Global;
  const settings = vscode.workspace.getConfiguration();
  await settings.update(INTERPRETER_SETTING, interpreter || undefined, target);
  if (settings.inspect<string>(PATH_SETTING)?.workspaceValue) {
    // It takes precedence over the interpreter.
    await settings.update(PATH_SETTING, undefined, target);
  }
}

async function choices(): Promise<Choice[]> {
  const folders = vscode.workspace.workspaceFolders ?? [];
  const found = new Set<string>();
  if (vscode.workspace.isTrusted) {
    const selected = await selectedInterpreter(folders[0]?.uri);
    const environments = await Promise.all(
      folders.map((each) => interpreterIn(vscode.Uri.joinPath(each.uri, ".venv").fsPath)),
    );
    [selected, ...environments].forEach((each) => each && found.add(each));
  }
  (await onPath("python3", "python")).forEach((each) => found.add(each));
  const described = await Promise.all(
    [...found].map(async (interpreter): Promise<Choice | undefined> => {
      const python = await probe.python(interpreter);
      return (
        python && {
          label: interpreter,
          description: `Python ${python.version.join(".")}${python.hasServer ? ", swarmdsl" : ""}`,
          interpreter,
        }
      );
    }),
  );
  return [AUTOMATIC, BROWSE, ...described.filter((each) => each !== undefined)];
}

async function browse(): Promise<string | undefined> {
  const chosen = await vscode.window.showOpenDialog({ openLabel: "Select Interpreter" });
  return chosen?.[0]?.fsPath;
}
