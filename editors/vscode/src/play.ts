// Command that plays a run: swarmc simulates it and writes a page, which is shown beside the text.

import { mkdtemp, readFile, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";

import * as vscode from "vscode";

import { showBundledLimit } from "./missing.ts";
import type { Server } from "./server.ts";
import { chooseScenario, chooseSubject } from "./simulate.ts";
import type { Simulated } from "./subject.ts";
import { run } from "./tasks.ts";

/** Play a run of `subject`, or let the user choose one of the file. */
export async function play(server: Server, file: vscode.Uri, subject?: Simulated): Promise<void> {
  const launch = await server.swarmc();
  if (!launch) {
    return;
  }
  if (launch.bundled) {
    showBundledLimit("play a run");
    return;
  }
  const chosen = subject ?? (await chooseSubject(file, "Play Run"));
  const scenario = chosen && (await chooseScenario(file));
  if (!scenario) {
    return;
  }
  // swarmc reads files from disk.
  await vscode.workspace.saveAll(false);
  const folder = await mkdtemp(join(tmpdir(), "swarm-"));
  const page = join(folder, "run.html");
  const args = ["play", file.fsPath, `--${chosen.kind}`, chosen.name, "-o", page];
  if (scenario.uri) {
    args.push("--scenario", scenario.uri.fsPath);
  }
  const task = new vscode.Task(
    { type: "swarmdsl", command: "play" },
    vscode.workspace.getWorkspaceFolder(file) ?? vscode.TaskScope.Workspace,
    `play ${chosen.name}`,
    "swarmc",
    run(launch, args, dirname(file.fsPath)),
  );
  task.presentationOptions = { reveal: vscode.TaskRevealKind.Silent };
  const running = await vscode.tasks.executeTask(task);
  const ended = vscode.tasks.onDidEndTask(async ({ execution }) => {
    if (execution === running) {
      ended.dispose();
      await showPage(page, chosen.name);
      await rm(folder, { recursive: true, force: true });
    }
  });
}

/** Show a page that swarmc has written; where there is none, the terminal says why. */
async function showPage(path: string, name: string): Promise<void> {
  let html: string;
  try {
    html = await readFile(path, "utf8");
  } catch {
    void vscode.window.showWarningMessage(`There is no run of ${name}: see the terminal.`);
    return;
  }
  const panel = vscode.window.createWebviewPanel(
    "swarmdsl.run",
    `Run of ${name}`,
    vscode.ViewColumn.Beside,
    // The page runs nothing but its own script, and asks for nothing.
    { enableScripts: true, localResourceRoots: [], retainContextWhenHidden: true },
  );
  panel.webview.html = html;
}
