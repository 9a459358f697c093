// The Test view: its controller, its profiles, and runs after each save.

import * as vscode from "vscode";

import type { Server } from "../server.ts";
import { SwarmCoverage } from "./coverage.ts";
import { Discovery } from "./discovery.ts";
import { type Kind, Runs } from "./runs.ts";
import { Tree } from "./tree.ts";
import { isRead } from "./watched.ts";

const DELAY = 200; // milliseconds: a save may change several files

/** Show the tests of the workspace in the Test view. */
export function exploreTests(server: Server): vscode.Disposable {
  const controller = vscode.tests.createTestController("swarmdsl", "Swarm");
  const tree = new Tree(controller);
  const discovery = new Discovery(server, tree);
  const runs = new Runs(controller, server, tree);
  const profile = (
    label: string,
    kind: Kind,
    of: vscode.TestRunProfileKind,
    isDefault = true,
  ): vscode.TestRunProfile =>
    controller.createRunProfile(
      label,
      of,
      (request, token) =>
        request.continuous ? runOnSave(runs, tree, request, kind, token) : runs.run(request, kind, token),
      isDefault,
      undefined,
      kind === "run" || kind === "coverage",
    );
  profile("Run", "run", vscode.TestRunProfileKind.Run);
  profile("Play", "play", vscode.TestRunProfileKind.Run, false);
  profile("Debug", "debug", vscode.TestRunProfileKind.Debug);
  const coverage = profile("Run with Coverage", "coverage", vscode.TestRunProfileKind.Coverage);
  coverage.loadDetailedCoverage = async (_run, file) =>
    file instanceof SwarmCoverage ? [...file.details] : [];
  controller.refreshHandler = () => discovery.refresh();
  discovery.later();
  return vscode.Disposable.from(discovery, controller);
}

/** Run a request after each save of a model or a test, until it is cancelled. */
function runOnSave(
  runs: Runs,
  tree: Tree,
  request: vscode.TestRunRequest,
  kind: Kind,
  token: vscode.CancellationToken,
): void {
  let timer: NodeJS.Timeout | undefined;
  let running: vscode.CancellationTokenSource | undefined;
  let ended = Promise.resolve();
  // Files and tests come and go.
  const present = (items: readonly vscode.TestItem[]): vscode.TestItem[] =>
    items.flatMap((each) => tree.current(each) ?? []);
  const start = (): void => {
    running?.cancel();
    const stopping = new vscode.CancellationTokenSource();
    running = stopping;
    const run = (): Promise<void> => {
      // The editor shows each request once.
      const again = new vscode.TestRunRequest(
        request.include && present(request.include),
        request.exclude && present(request.exclude),
        request.profile,
        true,
      );
      return runs.run(again, kind, stopping.token);
    };
    // The one before still says of its tests that they are skipped.
    ended = ended.then(run, run);
  };
  const saving = vscode.workspace.onDidSaveTextDocument(({ uri }) => {
    if (isRead(uri.path)) {
      clearTimeout(timer);
      timer = setTimeout(start, DELAY);
    }
  });
  token.onCancellationRequested(() => {
    clearTimeout(timer);
    running?.cancel();
    saving.dispose();
  });
}
