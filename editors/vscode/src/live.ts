// Live page of a trace: swarmc serves it, and it grows while the trace is written.

import { spawn } from "node:child_process";
import { homedir } from "node:os";
import { basename } from "node:path";

import * as vscode from "vscode";

import type { Launch } from "./launch.ts";
import { ADDRESS, MAX_OUTPUT } from "./nodes.ts";

/** Show the page beside the text until it is closed; `ended` is called if swarmc ends before. */
export function showLive(
  launch: Launch,
  file: vscode.Uri,
  trace: string,
  ended: (why: string) => void,
): void {
  const child = spawn(
    launch.command,
    [...launch.args, "play", file.fsPath, "--follow", trace],
    // Python would import modules from the folder of the model.
    { cwd: homedir(), stdio: ["ignore", "pipe", "pipe"] },
  );
  let panel: vscode.WebviewPanel | undefined;
  let isClosed = false;
  let output = "";
  const collect = (chunk: string): void => {
    output = (output + chunk).slice(-MAX_OUTPUT);
    const address = panel ? undefined : ADDRESS.exec(output)?.[0];
    if (address !== undefined) {
      panel = open(`Live run of ${basename(trace)}`);
      panel.onDidDispose(() => {
        isClosed = true;
        child.kill("SIGINT");
      });
      void fill(panel.webview, address);
    }
  };
  child.stdout.setEncoding("utf8").on("data", collect);
  child.stderr.setEncoding("utf8").on("data", collect);
  const end = (why: string): void => {
    if (!isClosed) {
      isClosed = true;
      ended(why);
    }
  };
  child.on("error", (error) => end(error.message));
  child.on("close", () => end(output.trim()));
}

function open(title: string): vscode.WebviewPanel {
  return vscode.window.createWebviewPanel("swarmdsl.live", title, vscode.ViewColumn.Beside, {
    enableScripts: true,
    localResourceRoots: [],
    retainContextWhenHidden: true,
  });
}

/** Frame a page of this computer, also in a window of a remote one. */
async function fill(webview: vscode.Webview, address: string): Promise<void> {
  const page = (await vscode.env.asExternalUri(vscode.Uri.parse(address))).toString(true);
  const policy = `default-src 'none'; frame-src ${page}; style-src 'unsafe-inline'`;
  webview.html = `<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="${policy}">
<style>html, body, iframe { width: 100%; height: 100%; margin: 0; padding: 0; border: 0; }</style>
</head>
<body><iframe src="${page}" title="live run"></iframe></body>
</html>`;
}
