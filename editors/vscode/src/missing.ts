// What the user can do where no swarmc can be run.

import * as vscode from "vscode";

const SELECT = "Select Interpreter";
const SETTINGS = "Open Settings";
const LOG = "Show Log";

/** Tell why there is none, with buttons for what helps. */
export function tell(found: { readonly missing: string; readonly setting?: string }): void {
  const buttons = found.setting ? [SETTINGS, SELECT, LOG] : [SELECT, LOG];
  void vscode.window.showErrorMessage(found.missing, ...buttons).then((chosen) => {
    if (chosen === SELECT) {
      return vscode.commands.executeCommand("swarmdsl.selectInterpreter");
    }
    if (chosen === SETTINGS) {
      return openSettings(found.setting ?? "");
    }
    return chosen === LOG ? vscode.commands.executeCommand("swarmdsl.showLog") : undefined;
  });
}

/** Show a setting where it is set. */
function openSettings(setting: string): Thenable<unknown> {
  const inWorkspace = vscode.workspace.getConfiguration().inspect(setting)?.workspaceValue;
  return vscode.commands.executeCommand(
    `workbench.action.${inWorkspace ? "openWorkspaceSettings" : "openSettings"}`,
    { query: setting },
  );
}

/** Tell that the copy that comes with the extension does not do what is asked for. */
export function tellBundled(what: string): void {
  const text = `To ${what}, install the Python package swarmdsl, and select its interpreter.`;
  void vscode.window.showErrorMessage(text, SELECT).then((chosen) =>
    chosen ? vscode.commands.executeCommand("swarmdsl.selectInterpreter") : undefined,
  );
}
