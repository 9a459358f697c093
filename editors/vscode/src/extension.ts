// Entry points of the extension: activation with its commands, deactivation.

import * as vscode from "vscode";

import { debug, provideDebugger } from "./debug.ts";
import { followNodes, followTrace } from "./follow.ts";
import { install } from "./install.ts";
import { selectInterpreter } from "./interpreter.ts";
import { chooseModel, newModel } from "./models.ts";
import { play, test } from "./play.ts";
import { Preview } from "./preview.ts";
import { newProject } from "./projects.ts";
import { onSelect } from "./python.ts";
import { type At, type Place, renameAt, showReferences } from "./references.ts";
import { renewSchemas, useSchemas } from "./schemas.ts";
import { Server } from "./server.ts";
import { simulate } from "./simulate.ts";
import { showStatus } from "./status.ts";
import type { Simulated, Subject } from "./subject.ts";
import { build, provideTasks } from "./tasks.ts";
import { exploreTests } from "./testing/explorer.ts";
import { verify } from "./verify.ts";
import { welcome } from "./welcome.ts";

// The publisher and name of the extension, and the id in the manifest.
const WALKTHROUGH = "swarmdsl.swarm#start";

let server: Server | undefined;

export function activate(context: vscode.ExtensionContext): void {
  const log = vscode.window.createOutputChannel("Swarm", { log: true });
  const started = new Server(context.extensionUri, log);
  server = started;
  const preview = new Preview(context.extensionUri, started);
  const refresh = (): void => void started.refresh();
  context.subscriptions.push(
    log,
    started,
    preview,
    showStatus(started),
    provideTasks(started),
    exploreTests(started),
    command("restartServer", () => started.restart()),
    command("selectInterpreter", selectInterpreter),
    command("install", () => install(started, context.extensionUri)),
    command("showLog", () => log.show()),
    command("useSchemas", () => useSchemas(context)),
    command("getStarted", () =>
      vscode.commands.executeCommand("workbench.action.openWalkthrough", WALKTHROUGH),
    ),
    command("newProject", () => newProject(started)),
    command("newModel", () => newModel(context.extensionUri)),
    command("simulate", async (file?: vscode.Uri | string, subject?: Simulated) => {
      const uri = await savedFile(file);
      return uri && simulate(started, uri, subject);
    }),
    command("simulateInRealTime", async (file?: vscode.Uri | string, subject?: Simulated) => {
      const uri = await savedFile(file);
      return uri && simulate(started, uri, subject, preview);
    }),
    provideDebugger(started, preview, log),
    command("debug", async (file?: vscode.Uri | string, subject?: Simulated) => {
      const uri = await savedFile(file);
      return uri && debug(preview, uri, subject);
    }),
    command("play", async (file?: vscode.Uri | string, subject?: Simulated) => {
      const uri = await savedFile(file);
      return uri && play(started, uri, subject);
    }),
    command("test", async (file?: vscode.Uri | string) => {
      const uri = await savedFile(file);
      return uri && test(started, uri);
    }),
    command("build", async (file?: vscode.Uri | string) => {
      const uri = await savedFile(file);
      return uri && build(started, uri);
    }),
    command("verify", async (file?: vscode.Uri | string, subject?: Simulated) => {
      const uri = await savedFile(file);
      return uri && verify(started, uri, subject);
    }),
    command("followTrace", async (file?: vscode.Uri | string) => {
      const uri = await savedFile(file);
      return uri && followTrace(started, preview, uri, log);
    }),
    command("followNodes", async (file?: vscode.Uri | string) => {
      const uri = await savedFile(file);
      return uri && followNodes(started, preview, uri, log);
    }),
    command("preview", async (file?: vscode.Uri | string, subject?: Subject) => {
      const uri = await targetFile(file);
      return uri && preview.show(uri, subject);
    }),
    command("references", (file: string, at: At, places: Place[]) => showReferences(file, at, places)),
    command("rename", (file: string, at: At) => renameAt(file, at)),
    welcome(() => {
      refresh();
      // Without a model, no change starts the server.
      context.subscriptions.push(
        vscode.workspace.onDidChangeConfiguration((event) => {
          if (event.affectsConfiguration("swarmdsl.server")) {
            refresh();
          }
        }),
        vscode.workspace.onDidGrantWorkspaceTrust(refresh),
      );
      void onSelect(refresh).then((listening) => context.subscriptions.push(listening));
    }),
  );
  void renewSchemas(context);
}

export function deactivate(): Promise<void> | undefined {
  return server?.stop();
}

function command(name: string, run: (...args: never[]) => unknown): vscode.Disposable {
  return vscode.commands.registerCommand(`swarmdsl.${name}`, run);
}

/** File of a command: its argument, the active file, or one of the workspace. */
async function targetFile(
  file: vscode.Uri | string | undefined,
): Promise<vscode.Uri | undefined> {
  if (file !== undefined) {
    return typeof file === "string" ? vscode.Uri.parse(file) : file;
  }
  const document = vscode.window.activeTextEditor?.document;
  return document?.languageId === "swarm" ? document.uri : chooseModel();
}

/** File of a command that runs swarmc, which reads from disk: a new file is saved first. */
async function savedFile(file: vscode.Uri | string | undefined): Promise<vscode.Uri | undefined> {
  const uri = await targetFile(file);
  return uri?.scheme === "untitled" ? vscode.workspace.save(uri) : uri;
}
