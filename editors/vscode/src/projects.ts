// Command that creates a project with `swarmc new`.

import { execFile } from "node:child_process";
import { basename } from "node:path";

import * as vscode from "vscode";

import type { Launch } from "./launch.ts";
import { isHidden } from "./entries.ts";
import { showBundledLimit } from "./missing.ts";
import { packageName } from "./models.ts";
import type { Server } from "./server.ts";

interface Template extends vscode.QuickPickItem {
  readonly target: string;
}

const TEMPLATES: readonly Template[] = [
  {
    label: "Project for ROS 2",
    detail: "A swarm with a behaviour, tests, a scenario, and packages for ROS 2",
    target: "ros2",
  },
  {
    label: "Project for ROS 1",
    detail: "The same swarm, with SMACH and packages for ROS 1",
    target: "smach",
  },
];

/** Ask for a template, a folder and a name; create the project and open it. */
export async function newProject(server: Server): Promise<void> {
  const launch = await server.swarmc();
  if (!launch) {
    return;
  }
  if (launch.bundled) {
    showBundledLimit("create a project");
    return;
  }
  const title = "New Project";
  const template = await vscode.window.showQuickPick(TEMPLATES, { title });
  const parent = template && (await chooseFolder());
  if (!parent) {
    return;
  }
  const entries = await vscode.workspace.fs.readDirectory(parent);
  const isEmpty = entries.every(([name]) => isHidden(name));
  const name = await vscode.window.showInputBox({
    title,
    prompt: isEmpty ? "Name of the project in this folder" : "Name of the project and its folder",
    value: isEmpty ? packageName(basename(parent.fsPath)) : "rescue",
    validateInput: (text) =>
      /^[a-z][a-z0-9_]*$/.test(text) ? undefined : "Write it in snake_case, beginning with a letter.",
  });
  if (!name) {
    return;
  }
  const folder = isEmpty ? parent : vscode.Uri.joinPath(parent, name);
  const failure = await vscode.window.withProgress(
    { location: vscode.ProgressLocation.Notification, title: `Creating project ${name}` },
    () => create(launch, name, folder.fsPath, template.target),
  );
  if (failure !== undefined) {
    void vscode.window.showErrorMessage(failure);
    return;
  }
  if (vscode.workspace.getWorkspaceFolder(folder)) {
    const model = vscode.Uri.joinPath(folder, "models", `${name}.swarm`);
    await vscode.window.showTextDocument(model, { preview: false });
    return;
  }
  await vscode.commands.executeCommand("vscode.openFolder", folder, {
    forceNewWindow: Boolean(vscode.workspace.workspaceFolders?.length),
  });
}

async function chooseFolder(): Promise<vscode.Uri | undefined> {
  const [folder] = vscode.workspace.workspaceFolders ?? [];
  const chosen = await vscode.window.showOpenDialog({
    title: "Folder of the new project, or the one around it",
    openLabel: "Create Project Here",
    canSelectFiles: false,
    canSelectFolders: true,
    ...(folder && { defaultUri: folder.uri }),
  });
  return chosen?.[0];
}

/** Run `swarmc new`; return why it failed, or undefined. */
function create(
  launch: Launch,
  name: string,
  folder: string,
  target: string,
): Promise<string | undefined> {
  const args = ["new", name, "--folder", folder, "--target", target, "--format", "concise"];
  // Python imports modules from its working directory.
  const options = { cwd: __dirname };
  return new Promise((resolve) => {
    execFile(launch.command, [...launch.args, ...args], options, (error, _, stderr) => {
      const [, message] = /error\[SW\d+\] (.+)/.exec(stderr) ?? [];
      resolve(error ? (message ?? (stderr.trim() || error.message)) : undefined);
    });
  });
}
