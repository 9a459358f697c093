// Debugs a test of the Test view: a session of the debug adapter, up to the result of the test.

import * as vscode from "vscode";

import { TYPE } from "../debug.ts";
import type { Cancelled } from "./process.ts";
import type { ResultRecord } from "./records.ts";

const TESTED = "swarmTested";

/** End of a session. */
export interface Debugged {
  /** False if the adapter did not launch the test. */
  readonly started: boolean;
  /** Undefined if the session ended before the test did. */
  readonly result?: ResultRecord;
}

// Marks the configuration of each session: others may debug the same test.
let sessions = 0;

/** Debug a test until its session ends, or end it when the run is cancelled. */
export async function debugTest(
  id: string,
  item: vscode.TestItem,
  run: vscode.TestRun,
  stopped: Cancelled,
): Promise<Debugged> {
  const mark = ++sessions;
  const isOurs = ({ configuration }: vscode.DebugSession): boolean => configuration["mark"] === mark;
  let result: ResultRecord | undefined;
  let over = (): void => undefined;
  const ended = new Promise<void>((resolve) => (over = resolve));
  let session: vscode.DebugSession | undefined;
  const end = (): void => {
    if (session && stopped.isCancellationRequested) {
      void vscode.debug.stopDebugging(session);
    }
  };
  const listening = vscode.Disposable.from(
    vscode.debug.onDidStartDebugSession((started) => {
      if (isOurs(started)) {
        session = started;
        end();
      }
    }),
    vscode.debug.onDidReceiveDebugSessionCustomEvent(({ session: teller, event, body }) => {
      if (event === TESTED && isOurs(teller)) {
        result = body as ResultRecord;
      }
    }),
    vscode.debug.onDidTerminateDebugSession((gone) => (isOurs(gone) ? over() : undefined)),
    stopped.onCancellationRequested(end),
  );
  try {
    const configuration = { type: TYPE, request: "launch", name: item.label, test: id, mark };
    const folder = item.uri && vscode.workspace.getWorkspaceFolder(item.uri);
    const started = await vscode.debug.startDebugging(folder, configuration, { testRun: run });
    if (started) {
      await ended;
    }
    return { started, ...(result && { result }) };
  } finally {
    listening.dispose();
  }
}
