// The commands that show in the preview where robots are.

import * as vscode from "vscode";

import { tell, tellBundled } from "./missing.ts";
import { Nodes } from "./nodes.ts";
import type { Preview } from "./preview.ts";
import type { Server } from "./server.ts";
import { Trace } from "./trace.ts";

const NAME = /^\/?([A-Za-z_]\w*(\/[A-Za-z_]\w*)*\/?)?$/;
let last = "";

/** Light up where robots are in the preview of a file's model, by a trace that they write. */
export async function followTrace(preview: Preview, file: vscode.Uri): Promise<void> {
  const chosen = await vscode.window.showOpenDialog({
    title: "The trace of a simulation, or of robots",
    openLabel: "Follow",
    defaultUri: vscode.Uri.joinPath(file, ".."),
    filters: { Traces: ["jsonl", "json"], "All files": ["*"] },
  });
  const trace = chosen?.[0];
  if (trace) {
    await preview.show(file);
    preview.light((moved) => new Trace(trace.fsPath, "", moved));
  }
}

/** The same, by what nodes of ROS 2 say while they run. */
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
    tellBundled("follow nodes of ROS 2");
    return;
  }
  const name = await vscode.window.showInputBox({
    title: "Follow ROS 2 Nodes",
    prompt: "The name of a node or of a namespace; nothing for all nodes",
    placeHolder: "/sar/uav_0",
    value: last,
    validateInput: (text) => (NAME.test(text) ? undefined : "This is no name in ROS."),
  });
  if (name === undefined) {
    return;
  }
  last = name;
  await preview.show(file);
  preview.light(
    (moved) =>
      new Nodes(launch, file.fsPath, name, moved, (said) => {
        log.error(said);
        // What is wrong and what to do, each in a line of its own.
        const lines = [...said.matchAll(/^(?:error\[SW\d+\]:|\s*= help:) (.*)$/gm)];
        const why = lines.map(([, line]) => line).join("; ");
        tell({ missing: why || "The swarmc that follows nodes of ROS 2 has ended." });
      }),
  );
}
