// Finds the tests of the workspace, again after each change of what they depend on.

import * as vscode from "vscode";

import type { Server } from "../server.ts";
import { runTests } from "./process.ts";
import type { FileRecord, TestRecord } from "./records.ts";
import { type Tree, workingFolder } from "./tree.ts";

export const TESTS = "**/*.swarmtest.toml";
// Models, projects, scenarios and tests; folders have no such names when they come, go or move.
const READ = /\.(swarm|toml|scxml|msg|srv|action)$|[\\/][^\\/.]+$/;
const DELAY = 300; // milliseconds without a change before the list is made

export class Discovery implements vscode.Disposable {
  private readonly server: Server;
  private readonly tree: Tree;
  private readonly disposables: vscode.Disposable[] = [];
  private timer: NodeJS.Timeout | undefined;
  private running: Promise<void> | undefined;
  private stopping: vscode.CancellationTokenSource | undefined;

  constructor(server: Server, tree: Tree) {
    this.server = server;
    this.tree = tree;
    const watcher = vscode.workspace.createFileSystemWatcher("**/*");
    const changed = (uri: vscode.Uri): void => {
      if (READ.test(uri.path)) {
        this.later();
      }
    };
    this.disposables.push(
      watcher,
      watcher.onDidCreate(changed),
      watcher.onDidChange(changed),
      watcher.onDidDelete(changed),
      vscode.workspace.onDidChangeWorkspaceFolders(() => this.later()),
      // Another swarmc may read tests that this one does not.
      server.onChange(({ kind }) => (kind === "running" || kind === "missing" ? this.later() : undefined)),
    );
  }

  dispose(): void {
    clearTimeout(this.timer);
    this.stopping?.cancel();
    vscode.Disposable.from(...this.disposables).dispose();
  }

  /** Find the tests when nothing has changed for a moment. */
  later(): void {
    clearTimeout(this.timer);
    this.timer = setTimeout(() => void this.refresh(), DELAY);
  }

  /** Find the tests now; a search that is under way is out of date. */
  async refresh(): Promise<void> {
    clearTimeout(this.timer);
    this.stopping?.cancel();
    const stopping = new vscode.CancellationTokenSource();
    this.stopping = stopping;
    const before = this.running;
    const search = (async (): Promise<void> => {
      await before;
      await this.find(stopping.token);
    })();
    this.running = search.catch(() => undefined);
    await search;
  }

  private async find(token: vscode.CancellationToken): Promise<void> {
    const files = await vscode.workspace.findFiles(TESTS);
    if (token.isCancellationRequested) {
      return;
    }
    if (!files.length) {
      this.tree.show([]);
      return;
    }
    const found = await this.server.found();
    if (!("launch" in found)) {
      this.tree.explain(files, `The tests cannot be read. ${found.missing}`);
      return;
    }
    const folders = new Set(
      files.map((file) => vscode.workspace.getWorkspaceFolder(file)?.uri.fsPath ?? file.fsPath),
    );
    const records: (FileRecord | TestRecord)[] = [];
    const { told, errors } = await runTests(
      found.launch,
      ["--list", "--format", "json", ...folders],
      workingFolder(files[0]),
      {
        record: (record) => {
          if (record.type === "file" || record.type === "test") {
            records.push(record);
          }
        },
      },
      token,
    );
    if (token.isCancellationRequested) {
      return;
    }
    if (told) {
      this.tree.show(records);
    } else {
      const which = `the swarmc of ${found.launch.origin}`;
      this.tree.explain(files, `${which} cannot list tests: it may be too old.\n${errors}`);
    }
  }
}
