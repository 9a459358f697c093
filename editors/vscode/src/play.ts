// Commands that play runs: swarmc writes a page, which is shown beside the text.

import { mkdtemp, readFile, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import { basename, dirname, join } from "node:path";

import * as vscode from "vscode";

import type { Launch } from "./launch.ts";
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
  const more = scenario.uri ? ["--scenario", scenario.uri.fsPath] : [];
  const words = ["play", file.fsPath, `--${chosen.kind}`, chosen.name, ...more];
  const isShown = await playPage(launch, file, chosen.name, [...words, "-o"]);
  if (!isShown) {
    void vscode.window.showWarningMessage(`There is no run of ${chosen.name}: see the terminal.`);
  }
}

/** Run the tests beside a file, and play the first that fails. */
export async function test(server: Server, file: vscode.Uri): Promise<void> {
  const launch = await server.swarmc();
  if (!launch) {
    return;
  }
  await vscode.workspace.saveAll(false);
  const folder = dirname(file.fsPath);
  await playPage(launch, file, "the test that fails", ["test", folder, "--play"]);
}

/**
 * Let swarmc write a page, to a path after the last argument, and show it.
 *
 * Returns false without a page: the terminal says why.
 */
export async function playPage(
  launch: Launch,
  file: vscode.Uri,
  name: string,
  args: readonly string[],
): Promise<boolean> {
  const folder = await mkdtemp(join(tmpdir(), "swarm-"));
  const page = join(folder, "run.html");
  const command = args[0] ?? "";
  const task = new vscode.Task(
    { type: "swarmdsl", command },
    vscode.workspace.getWorkspaceFolder(file) ?? vscode.TaskScope.Workspace,
    `${command} ${basename(file.fsPath)}`,
    "swarmc",
    run(launch, [...args, page], dirname(file.fsPath)),
  );
  // A run is on its page, and the results of tests are in the terminal.
  const { Always, Silent } = vscode.TaskRevealKind;
  task.presentationOptions = { reveal: command === "test" ? Always : Silent };
  const running = await vscode.tasks.executeTask(task);
  await new Promise<void>((resolve) => {
    const ended = vscode.tasks.onDidEndTask(({ execution }) => {
      if (execution === running) {
        ended.dispose();
        resolve();
      }
    });
  });
  const html = await readFile(page, "utf8").catch(() => undefined);
  await rm(folder, { recursive: true, force: true });
  if (html !== undefined) {
    showPage(html, name);
  }
  return html !== undefined;
}

/** Show the page of a run beside the text. */
export function showPage(html: string, name: string): void {
  const panel = vscode.window.createWebviewPanel(
    "swarmdsl.run",
    `Run of ${name}`,
    vscode.ViewColumn.Beside,
    // The page runs nothing but its own script, and asks for nothing.
    { enableScripts: true, localResourceRoots: [], retainContextWhenHidden: true },
  );
  panel.webview.html = html;
}
