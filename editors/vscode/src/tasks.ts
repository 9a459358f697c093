// Tasks of type `swarmdsl`, with diagnostics in the problems view.

import * as vscode from "vscode";

import type { Launch } from "./launch.ts";
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

function createTask(definition: Definition, folder: vscode.WorkspaceFolder, launch: Launch): vscode.Task {
  const { command, watch = false, args = [] } = definition;
  const line = [command, ...(watch ? ["--watch"] : []), ...args];
  const reported = command === "check" || command === "build";
  const task = new vscode.Task(
    definition,
    folder,
    line.join(" "),
    "swarmc",
    run(launch, [...line, ...(reported ? ["--format", "concise"] : [])], folder.uri.fsPath),
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

/** Execution of swarmc in a task. */
export function run(launch: Launch, args: readonly string[], cwd: string): vscode.ProcessExecution {
  return new vscode.ProcessExecution(launch.command, [...launch.args, ...args], { cwd });
}
