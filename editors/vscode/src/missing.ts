// Error messages for a missing swarmc.

import * as vscode from "vscode";

const INSTALL = "Install swarmc";
const SELECT = "Select Interpreter";
const SETTINGS = "Open Settings";
const LOG = "Show Log";

/** Show the reason, with buttons for remedies. */
export function showMissing(found: { readonly missing: string; readonly setting?: string }): void {
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

/** Open the settings editor in the scope of the setting. */
function openSettings(setting: string): Thenable<unknown> {
  const inWorkspace = vscode.workspace.getConfiguration().inspect(setting)?.workspaceValue;
  return vscode.commands.executeCommand(
    `workbench.action.${inWorkspace ? "openWorkspaceSettings" : "openSettings"}`,
    { query: setting },
  );
}

/** What the bundled copy can do instead of something. */
interface Instead {
  readonly title: string;
  readonly run: () => Thenable<unknown>;
}

/** Show that the bundled copy lacks a feature. */
export function showBundledLimit(what: string, instead?: Instead): void {
  const text = `To ${what}, install the Python package swarmdsl, or select an interpreter that has it.`;
  const buttons = [...(instead ? [instead.title] : []), INSTALL, SELECT];
  void vscode.window.showErrorMessage(text, ...buttons).then((chosen) => {
    if (chosen === instead?.title) {
      return instead?.run();
    }
    if (chosen === INSTALL) {
      return vscode.commands.executeCommand("swarmdsl.install");
    }
    return chosen === SELECT
      ? vscode.commands.executeCommand("swarmdsl.selectInterpreter")
      : undefined;
  });
}
