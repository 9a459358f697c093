// The Test view: its controller, its profiles, and runs after each save.

import * as vscode from "vscode";

import type { Server } from "../server.ts";
import { SwarmCoverage } from "./coverage.ts";
import { Discovery } from "./discovery.ts";
import { type Kind, Runs } from "./runs.ts";
import { Tree } from "./tree.ts";

const DELAY = 200; // milliseconds: a save may change several files
const SAVED = /\.(swarm|toml|scxml|msg|srv|action)$/;

/** Show the tests of the workspace in the Test view. */
export function exploreTests(server: Server): vscode.Disposable {
  const controller = vscode.tests.createTestController("swarmdsl", "Swarm");
  const tree = new Tree(controller);
  const discovery = new Discovery(server, tree);
  const runs = new Runs(controller, server, tree);
  const profile = (label: string, kind: Kind, of: vscode.TestRunProfileKind): vscode.TestRunProfile =>
    controller.createRunProfile(
      label,
      of,
      (request, token) =>
        request.continuous ? runOnSave(runs, request, kind, token) : runs.run(request, kind, token),
      true,
      undefined,
      kind !== "debug",
    );
  profile("Run", "run", vscode.TestRunProfileKind.Run);
  profile("Play", "debug", vscode.TestRunProfileKind.Debug);
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
  request: vscode.TestRunRequest,
  kind: Kind,
  token: vscode.CancellationToken,
): void {
  let timer: NodeJS.Timeout | undefined;
  let running: vscode.CancellationTokenSource | undefined;
  const start = (): void => {
    running?.cancel();
    running = new vscode.CancellationTokenSource();
    void runs.run(request, kind, running.token);
  };
  const saving = vscode.workspace.onDidSaveTextDocument(({ uri }) => {
    if (SAVED.test(uri.path)) {
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
