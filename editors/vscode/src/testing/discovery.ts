// Finds the tests of the workspace, again after each change of what they depend on.

import * as vscode from "vscode";

import type { Server } from "../server.ts";
import { runTests } from "./process.ts";
import type { FileRecord, TestRecord } from "./records.ts";
import type { Tree } from "./tree.ts";
import { isHidden, isRead, mayHold } from "./watched.ts";

const TESTS = "**/*.swarmtest.toml";
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
    const { asRelativePath } = vscode.workspace;
    const changed = (isOf: (path: string) => boolean) => (uri: vscode.Uri): void => {
      if (isOf(asRelativePath(uri, false)) || tree.isBelow(uri)) {
        this.later();
      }
    };
    this.disposables.push(
      watcher,
      watcher.onDidCreate(changed(mayHold)),
      watcher.onDidChange(changed(isRead)),
      watcher.onDidDelete(changed(mayHold)),
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
    const found = await vscode.workspace.findFiles(TESTS);
    const files = found.filter((file) => !isHidden(vscode.workspace.asRelativePath(file, false)));
    if (token.isCancellationRequested) {
      return;
    }
    if (!files.length) {
      this.tree.show([]);
      return;
    }
    const swarmc = await this.server.found();
    if (!("launch" in swarmc)) {
      this.tree.explain(files, `The tests cannot be read. ${swarmc.missing}`);
      return;
    }
    const folders = new Set(
      files.map((file) => vscode.workspace.getWorkspaceFolder(file)?.uri.fsPath ?? file.fsPath),
    );
    const records: (FileRecord | TestRecord)[] = [];
    const { told, errors } = await runTests(
      swarmc.launch,
      ["--list", "--format", "json", ...folders],
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
      const which = `The swarmc of ${swarmc.launch.origin}`;
      this.tree.explain(files, `${which} cannot list tests: it may be too old.\n${errors}`);
    }
  }
}
