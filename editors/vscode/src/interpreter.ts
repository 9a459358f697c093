// Choice of the interpreter for swarmc, and the command that stores one.

import { homedir } from "node:os";

import * as vscode from "vscode";

import { environmentsIn, interpreterIn, onPath, probe, unique } from "./probe.ts";
import { selectedInterpreter } from "./python.ts";
import { INTERPRETER_SETTING, PATH_SETTING } from "./launch.ts";

export interface Choice extends vscode.QuickPickItem {
  /** Undefined if the user is to name the file. */
  readonly interpreter: string | undefined;
}

const AUTOMATIC: Choice = {
  label: "$(search) Find automatically",
  detail: "Python extension, .venv or PATH; else the bundled server",
  interpreter: "",
};
export const BROWSE: Choice = { label: "$(folder-opened) Browse...", interpreter: undefined };

/** Ask for an interpreter and store it. */
export async function selectInterpreter(): Promise<void> {
  const interpreter = await askInterpreter("Select the Python for swarmc", [AUTOMATIC, BROWSE]);
  if (interpreter !== undefined) {
    await storeInterpreter(interpreter);
  }
}

/** Let the user choose among `first` and the interpreters that are found. */
export async function askInterpreter(
  title: string,
  first: readonly Choice[],
): Promise<string | undefined> {
  const chosen = await vscode.window.showQuickPick(choices(first), {
    title,
    placeHolder: "Interpreter with the package swarmdsl, or any Python 3.10 or later",
  });
  return chosen && (chosen.interpreter ?? (await browse()));
}

/** Store an interpreter for the workspace, or for the user without one; none if it is empty. */
export async function storeInterpreter(interpreter: string): Promise<void> {
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

async function choices(first: readonly Choice[]): Promise<Choice[]> {
  const folders = vscode.workspace.workspaceFolders ?? [];
  const found: (string | undefined)[] = [];
  if (vscode.workspace.isTrusted) {
    const selected = await selectedInterpreter(folders[0]?.uri);
    const environments = await Promise.all(
      folders.map((each) => interpreterIn(vscode.Uri.joinPath(each.uri, ".venv").fsPath)),
    );
    found.push(selected, ...environments);
  }
  found.push(...(await environmentsIn(homedir())), ...(await onPath("python3", "python")));
  const described = await Promise.all(
    (await unique(found)).map(async (interpreter): Promise<Choice | undefined> => {
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
  return [...first, ...described.filter((each) => each !== undefined)];
}

async function browse(): Promise<string | undefined> {
  const chosen = await vscode.window.showOpenDialog({ openLabel: "Select Interpreter" });
  return chosen?.[0]?.fsPath;
}
