// Debugger: `swarmc debug` runs a simulation, which the preview shows.

import { homedir } from "node:os";
import { basename, dirname } from "node:path";

import * as vscode from "vscode";

import type { Active, Highlights, Moved, Steps } from "./highlights.ts";
import type { DebugCommand, Preview } from "./preview.ts";
import type { Server } from "./server.ts";
import { chooseScenario, chooseSubject } from "./simulate.ts";
import type { Simulated } from "./subject.ts";

export const TYPE = "swarm";
const MOVED = "swarmMoved";

/** Event that would do something now, with data to fill in if it has any. */
interface Sendable {
  readonly event: string;
  readonly label: string;
  readonly to: readonly string[];
  readonly data?: object;
}

/** Run as the adapter shows it; while it stands still also with events to send, and variables. */
interface Shown extends Steps {
  readonly time?: number;
  readonly active: Active;
  readonly member?: string;
  readonly thread?: number;
  readonly members?: readonly string[];
  readonly reason?: string;
  readonly events?: readonly Sendable[];
  readonly variables?: Record<string, string>;
}

/** Debug a run of `subject`, or let the user choose one of the file; the preview shows it. */
export async function debug(preview: Preview, file: vscode.Uri, subject?: Simulated): Promise<void> {
  const chosen = subject ?? (await chooseSubject(file, "Debug"));
  const scenario = chosen && (await chooseScenario(file));
  if (!scenario) {
    return;
  }
  // The adapter reads files from disk.
  await vscode.workspace.saveAll(false);
  await preview.show(file, chosen.kind === "property" ? undefined : { kind: chosen.kind, name: chosen.name });
  await vscode.debug.startDebugging(vscode.workspace.getWorkspaceFolder(file), {
    type: TYPE,
    request: "launch",
    name: `Debug ${chosen.name}`,
    program: file.fsPath,
    [chosen.kind]: chosen.name,
    ...(scenario.uri && { scenario: scenario.uri.fsPath }),
    cwd: dirname(file.fsPath),
  });
}

/** Start adapters, complete configurations, and show sessions in the preview. */
export function provideDebugger(
  server: Server,
  preview: Preview,
  log: vscode.LogOutputChannel,
): vscode.Disposable {
  let shown: { readonly session: vscode.DebugSession; readonly highlights: Run } | undefined;
  return vscode.Disposable.from(
    vscode.debug.registerDebugAdapterDescriptorFactory(TYPE, {
      async createDebugAdapterDescriptor() {
        const launch = await server.swarmc();
        if (!launch) {
          throw new Error("There is no swarmc that could run the model.");
        }
        const args = [...launch.args, "debug"];
        log.info(`debugging with swarmc of ${launch.origin}: ${[launch.command, ...args].join(" ")}`);
        // Python would import modules from the folder of the model.
        return new vscode.DebugAdapterExecutable(launch.command, args, { cwd: homedir() });
      },
    }),
    vscode.debug.registerDebugConfigurationProvider(TYPE, {
      async resolveDebugConfiguration(folder, configuration) {
        const made = configuration.type ? configuration : await configurationOf(configuration);
        return made && { cwd: folder?.uri.fsPath, ...made };
      },
    }),
    vscode.debug.onDidReceiveDebugSessionCustomEvent(({ session, event, body }) => {
      if (session.type !== TYPE || event !== MOVED) {
        return;
      }
      if (shown?.session !== session) {
        shown = { session, highlights: preview.highlight((moved) => new Run(moved)) };
      }
      const run = body as Shown;
      shown.highlights.move(run);
      show(run);

      function show(seen: Shown): void {
        preview.showDebug(controls(seen), (command) => void act(session, seen, command, log, show));
      }
    }),
    vscode.debug.onDidTerminateDebugSession((session) => {
      if (shown?.session === session) {
        shown.highlights.dispose();
        shown = undefined;
        preview.showDebug(null, () => undefined);
      }
    }),
  );
}

/** Configuration for the model of the active editor, without a launch.json. */
async function configurationOf(
  given: vscode.DebugConfiguration,
): Promise<vscode.DebugConfiguration | undefined> {
  const document = vscode.window.activeTextEditor?.document;
  if (document?.languageId !== "swarm" || document.uri.scheme !== "file") {
    void vscode.window.showInformationMessage("Open the .swarm file to debug.");
    return undefined;
  }
  const chosen = await chooseSubject(document.uri, "Debug");
  return (
    chosen && {
      ...given,
      type: TYPE,
      request: "launch",
      name: `Debug ${basename(document.fileName)}`,
      program: document.fileName,
      [chosen.kind]: chosen.name,
    }
  );
}

/** Controls for the page of the preview. */
function controls({ time, member, thread, members, reason, events, variables }: Shown): object {
  return { time, held: events !== undefined, member, thread, members, reason, events, variables };
}

async function act(
  session: vscode.DebugSession,
  { thread }: Shown,
  { request, event, data, look }: DebugCommand,
  log: vscode.LogOutputChannel,
  show: (seen: Shown) => void,
): Promise<void> {
  try {
    if (event !== undefined) {
      await session.customRequest("swarmSend", { event, ...(data && { data }) });
    } else if (look !== undefined) {
      show(await session.customRequest("swarmPicture", { threadId: look }) as Shown);
    } else if (request === "terminate") {
      await vscode.debug.stopDebugging(session);
    } else if (request !== undefined) {
      await session.customRequest("swarmGo", { request, threadId: thread ?? 1 });
    }
  } catch (error) {
    log.warn(String(error));
    void vscode.window.showWarningMessage(error instanceof Error ? error.message : String(error));
  }
}

/** Active states of a session. */
class Run implements Highlights {
  private active: Active = {};
  private readonly moved: Moved;

  constructor(moved: Moved) {
    this.moved = moved;
  }

  move({ active, taken, entered }: Shown): void {
    this.active = active;
    this.moved(active, { ...(taken && { taken }), ...(entered && { entered }) });
  }

  resend(): void {
    this.moved(this.active, {});
  }

  dispose(): void {
    this.moved(Object.fromEntries(Object.keys(this.active).map((member) => [member, null])), {});
  }
}
