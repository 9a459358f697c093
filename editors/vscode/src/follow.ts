// Commands that show what robots do: on a live page, or in the preview.

import * as vscode from "vscode";

import { showLive } from "./live.ts";
import { showMissing, showBundledLimit } from "./missing.ts";
import { Nodes } from "./nodes.ts";
import type { Preview } from "./preview.ts";
import type { Server } from "./server.ts";
import { Trace } from "./trace.ts";

const NAME = /^\/?([A-Za-z_]\w*(\/[A-Za-z_]\w*)*\/?)?$/;
let last = "";

/**
 * Play a trace of a file's model while it is written.
 *
 * The bundled copy of swarmc cannot: then the preview highlights the active states.
 */
export async function followTrace(
  server: Server,
  preview: Preview,
  file: vscode.Uri,
  log: vscode.LogOutputChannel,
): Promise<void> {
  const chosen = await vscode.window.showOpenDialog({
    title: "Trace of a simulation or of robots",
    openLabel: "Follow",
    defaultUri: vscode.Uri.joinPath(file, ".."),
    filters: { Traces: ["jsonl", "json"], "All files": ["*"] },
  });
  const trace = chosen?.[0];
  if (!trace) {
    return;
  }
  const launch = await server.swarmc();
  if (launch && !launch.bundled) {
    showLive(launch, file, trace.fsPath, (said) => tellEnd(said, "plays the trace", log));
    return;
  }
  await preview.show(file);
  preview.highlight((moved) => new Trace(trace.fsPath, "", moved));
}

/** Highlight active states from running ROS 2 nodes. */
export async function followNodes(
  server: Server,
  preview: Preview,
  file: vscode.Uri,
  log: vscode.LogOutputChannel,
): Promise<void> {
  const launch = await server.swarmc();
  if (!launch) {
    return;
  }
  if (launch.bundled) {
    showBundledLimit("follow ROS 2 nodes");
    return;
  }
  const name = await vscode.window.showInputBox({
    title: "Follow ROS 2 Nodes",
    prompt: "Name of a node or namespace; empty for all nodes",
    placeHolder: "/sar/uav_0",
    value: last,
    validateInput: (text) => (NAME.test(text) ? undefined : "Not a valid ROS name."),
  });
  if (name === undefined) {
    return;
  }
  last = name;
  await preview.show(file);
  preview.highlight(
    (moved) =>
      new Nodes(launch, file.fsPath, name, moved, (said) =>
        tellEnd(said, "follows ROS 2 nodes", log),
      ),
  );
}

/** Tell why swarmc has ended by itself. */
function tellEnd(said: string, what: string, log: vscode.LogOutputChannel): void {
  log.error(said);
  // Join the error and its help, one line each.
  const lines = [...said.matchAll(/^(?:error\[SW\d+\]:|\s*= help:) (.*)$/gm)];
  const why = lines.map(([, line]) => line).join("; ");
  showMissing({ missing: why || `The swarmc process that ${what} has ended.` });
}
