// Entry points of the extension: activation with its commands, deactivation.

import * as vscode from "vscode";

import { followNodes, followTrace } from "./follow.ts";
import { selectInterpreter } from "./interpreter.ts";
import { newModel } from "./models.ts";
import { play, test } from "./play.ts";
import { Preview } from "./preview.ts";
import { onSelect } from "./python.ts";
import { type Place, showReferences } from "./references.ts";
import { Server } from "./server.ts";
import { simulate } from "./simulate.ts";
import { showStatus } from "./status.ts";
import type { Simulated, Subject } from "./subject.ts";
import { provideTasks } from "./tasks.ts";
import { verify } from "./verify.ts";

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
    command("restartServer", () => started.restart()),
    command("selectInterpreter", selectInterpreter),
    command("showLog", () => log.show()),
    command("newModel", () => newModel(context.extensionUri)),
    command("simulate", async (file?: vscode.Uri | string, subject?: Simulated) => {
      const uri = await savedFile(file);
      return uri && simulate(started, uri, subject);
    }),
    command("simulateInRealTime", async (file?: vscode.Uri | string, subject?: Simulated) => {
      const uri = await savedFile(file);
      return uri && simulate(started, uri, subject, preview);
    }),
    command("play", async (file?: vscode.Uri | string, subject?: Simulated) => {
      const uri = await savedFile(file);
      return uri && play(started, uri, subject);
    }),
    command("test", async (file?: vscode.Uri | string) => {
      const uri = await savedFile(file);
      return uri && test(started, uri);
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
    command("preview", (file?: vscode.Uri | string, subject?: Subject) => {
      const uri = targetFile(file);
      return uri && preview.show(uri, subject);
    }),
    command("references", (file: string, at: Place["range"]["start"], places: Place[]) =>
      showReferences(file, at, places),
    ),
    vscode.workspace.onDidChangeConfiguration((event) => {
      if (event.affectsConfiguration("swarmdsl.server")) {
        refresh();
      }
    }),
    vscode.workspace.onDidGrantWorkspaceTrust(refresh),
  );
  void onSelect(refresh).then((listening) => context.subscriptions.push(listening));
  refresh();
}

export function deactivate(): Promise<void> | undefined {
  return server?.stop();
}

function command(name: string, run: (...args: never[]) => unknown): vscode.Disposable {
  return vscode.commands.registerCommand(`swarmdsl.${name}`, run);
}

/** File of a command: its argument, or the active file. */
function targetFile(file: vscode.Uri | string | undefined): vscode.Uri | undefined {
  if (typeof file === "string") {
    return vscode.Uri.parse(file);
  }
  const document = vscode.window.activeTextEditor?.document;
  return file ?? (document?.languageId === "swarm" ? document.uri : undefined);
}

/** File of a command that runs swarmc, which reads from disk: a new file is saved first. */
async function savedFile(file: vscode.Uri | string | undefined): Promise<vscode.Uri | undefined> {
  const uri = targetFile(file);
  return uri?.scheme === "untitled" ? vscode.workspace.save(uri) : uri;
}
