// Tasks of type `swarmdsl`, with diagnostics in the problems view.

import { dirname } from "node:path";

import * as vscode from "vscode";

import type { Launch } from "./launch.ts";
import { showBundledLimit } from "./missing.ts";
import type { Server } from "./server.ts";

interface Definition extends vscode.TaskDefinition {
  readonly command: string;
  readonly watch?: boolean;
  readonly args?: readonly string[];
}

const OFFERED: readonly Definition[] = [
  { type: "swarmdsl", command: "build" },
  { type: "swarmdsl", command: "build", watch: true },
  { type: "swarmdsl", command: "check" },
  { type: "swarmdsl", command: "test" },
];

// The language server shows the same as the first one in open files, but nothing of targets.
const MATCHERS = ["$swarmc", "$swarmc-build"];

export function provideTasks(server: Server): vscode.Disposable {
  return vscode.tasks.registerTaskProvider("swarmdsl", {
    async provideTasks() {
      const launch = await server.swarmc();
      const folders = vscode.workspace.workspaceFolders ?? [];
      return launch
        ? folders.flatMap((folder) => OFFERED.map((each) => createTask(each, folder, launch)))
        : [];
    },
    async resolveTask({ definition, scope }) {
      const launch = await server.swarmc();
      const folder = scope && typeof scope === "object" ? scope : vscode.workspace.workspaceFolders?.[0];
      return launch && folder && createTask(definition as Definition, folder, launch);
    },
  });
}

/** A task that runs in a folder of the workspace, or in another one by its path. */
function createTask(
  definition: Definition,
  folder: vscode.WorkspaceFolder | string,
  launch: Launch,
): vscode.Task {
  const { command, watch = false, args = [] } = definition;
  const line = [command, ...(watch ? ["--watch"] : []), ...args];
  const reported = command === "check" || command === "build";
  const [scope, path] =
    typeof folder === "string"
      ? ([vscode.TaskScope.Workspace, folder] as const)
      : ([folder, folder.uri.fsPath] as const);
  const task = new vscode.Task(
    definition,
    scope,
    line.join(" "),
    "swarmc",
    run(launch, [...line, ...(reported ? ["--format", "concise"] : [])], path),
    reported ? MATCHERS.map((each) => (watch ? `${each}-watch` : each)) : [],
  );
  task.isBackground = watch;
  if (command === "test") {
    task.group = vscode.TaskGroup.Test;
  } else if (reported) {
    task.group = vscode.TaskGroup.Build;
  }
  return task;
}

/** Build the models in the folder of a file, for the targets of its project. */
export async function build(server: Server, file: vscode.Uri): Promise<void> {
  const launch = await server.swarmc();
  if (!launch) {
    return;
  }
  if (launch.bundled) {
    showBundledLimit("build a model");
    return;
  }
  // swarmc reads files from disk.
  await vscode.workspace.saveAll(false);
  const definition = { type: "swarmdsl", command: "build", args: [dirname(file.fsPath)] };
  const folder = vscode.workspace.getWorkspaceFolder(file);
  await vscode.tasks.executeTask(createTask(definition, folder ?? dirname(file.fsPath), launch));
}

/** Run a task until its process ends; return the exit code, undefined without one. */
export function finished(task: vscode.Task): Promise<number | undefined> {
  const running = vscode.tasks.executeTask(task);
  return new Promise((resolve, reject) => {
    const ended = vscode.tasks.onDidEndTaskProcess(async ({ execution, exitCode }) => {
      if (execution === (await running)) {
        ended.dispose();
        resolve(exitCode);
      }
    });
    running.then(undefined, (error: unknown) => {
      ended.dispose();
      reject(error);
    });
  });
}

/** Execution of swarmc in a task. */
export function run(launch: Launch, args: readonly string[], cwd: string): vscode.ProcessExecution {
  return new vscode.ProcessExecution(launch.command, [...launch.args, ...args], { cwd });
}
