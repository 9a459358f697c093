// Status bar item of the server, for files of the language.

import * as vscode from "vscode";

import type { Server, Status } from "./server.ts";

const LINKS = [
  "[Restart](command:swarmdsl.restartServer)",
  "[Select Interpreter](command:swarmdsl.selectInterpreter)",
  "[Show Log](command:swarmdsl.showLog)",
].join(" · ");

/** Show the item while a file of the language is active. */
export function showStatus(server: Server): vscode.Disposable {
  const item = vscode.window.createStatusBarItem("swarmdsl", vscode.StatusBarAlignment.Right, 100);
  item.name = "Swarm";
  item.command = "swarmdsl.showLog";
  const show = (status: Status): void => {
    const { icon, text, detail, wrong } = described(status);
    item.text = `$(${icon}) ${text}`;
    item.accessibilityInformation = { label: `Swarm: ${detail.replaceAll(/\s+/g, " ")}` };
    item.tooltip = new vscode.MarkdownString(`${detail}\n\n${LINKS}`);
    item.tooltip.isTrusted = { enabledCommands: LINKS.match(/(?<=command:)[\w.]+/g) ?? [] };
    item.backgroundColor = wrong
      ? new vscode.ThemeColor("statusBarItem.warningBackground")
      : undefined;
  };
  const follow = (editor: vscode.TextEditor | undefined): void =>
    editor?.document.languageId === "swarm" ? item.show() : item.hide();
  show({ kind: "stopped" });
  follow(vscode.window.activeTextEditor);
  return vscode.Disposable.from(
    item,
    server.onChange(show),
    vscode.window.onDidChangeActiveTextEditor(follow),
  );
}

function described(status: Status): { icon: string; text: string; detail: string; wrong?: true } {
  switch (status.kind) {
    case "running": {
      const { launch, version } = status;
      const detail = `swarmc ${version} of ${launch.origin}\n\n\`${launch.command}\``;
      return { icon: "check", text: `swarmc ${version}`, detail };
    }
    case "starting":
      return { icon: "loading~spin", text: "swarmc", detail: "swarmc is starting" };
    case "stopped":
      return { icon: "circle-slash", text: "swarmc", detail: "swarmc is not running", wrong: true };
    case "missing":
      return { icon: "warning", text: "swarmc", detail: status.why, wrong: true };
  }
}
