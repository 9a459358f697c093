// Commands that simulate a model in a terminal, in virtual time or in real time.

import { mkdtemp, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";

import * as vscode from "vscode";

import { scenarioFolders } from "./entries.ts";
import { showBundledLimit } from "./missing.ts";
import type { Preview } from "./preview.ts";
import type { Server } from "./server.ts";
import { type Simulated, type Subject, swarmsFirst } from "./subject.ts";
import { run } from "./tasks.ts";
import { Trace } from "./trace.ts";

interface Scenario extends vscode.QuickPickItem {
  readonly uri: vscode.Uri | undefined;
}

// Keys are details of document symbols.
const KINDS: Record<string, Simulated["kind"]> = { swarm: "swarm", "state machine": "machine" };

/**
 * Simulate `subject`, or let the user choose one of the file.
 *
 * With a preview, simulate in real time and highlight the active states there.
 */
export async function simulate(
  server: Server,
  file: vscode.Uri,
  subject?: Simulated,
  preview?: Preview,
): Promise<void> {
  const launch = await server.swarmc();
  if (!launch) {
    return;
  }
  if (launch.bundled) {
    // The debug adapter of the bundled copy simulates, and shows the run in the preview.
    const debug = () => vscode.commands.executeCommand("swarmdsl.debug", file, subject);
    showBundledLimit("simulate a model in a terminal", { title: "Debug", run: debug });
    return;
  }
  const chosen = subject ?? (await chooseSubject(file, "Simulate"));
  const scenario = chosen && (await chooseScenario(file));
  if (!scenario) {
    return;
  }
  // swarmc reads files from disk.
  await vscode.workspace.saveAll(false);
  const folder = preview && (await mkdtemp(join(tmpdir(), "swarm-")));
  const trace = folder && join(folder, "trace.jsonl");
  const args = ["simulate", file.fsPath, `--${chosen.kind}`, chosen.name];
  // Of a property, the verdict is shown.
  const shown = chosen.kind === "property" ? "none" : "text";
  args.push(...(trace ? ["--real-time", "--trace-file", trace] : ["--trace", shown]));
  if (scenario.uri) {
    args.push("--scenario", scenario.uri.fsPath);
  }
  const task = new vscode.Task(
    { type: "swarmdsl", command: "simulate" },
    vscode.workspace.getWorkspaceFolder(file) ?? vscode.TaskScope.Workspace,
    `simulate ${chosen.name}`,
    "swarmc",
    run(launch, args, dirname(file.fsPath)),
  );
  if (!preview || !folder || !trace) {
    await vscode.tasks.executeTask(task);
    return;
  }
  const machine: Subject | undefined =
    chosen.kind === "machine" ? { kind: "machine", name: chosen.name } : undefined;
  await preview.show(file, machine);
  const highlights = preview.highlight((moved) => new Trace(trace, machine?.name ?? "", moved));
  const running = await vscode.tasks.executeTask(task);
  const ended = vscode.tasks.onDidEndTask(async ({ execution }) => {
    if (execution === running) {
      ended.dispose();
      await highlights.end();
      await rm(folder, { recursive: true, force: true });
    }
  });
}

/** The swarm or state machine of the file; the user chooses if there are several. */
export async function chooseSubject(
  file: vscode.Uri,
  title: string,
): Promise<Simulated | undefined> {
  const found = await subjectsOf(file);
  if (found.length <= 1) {
    if (!found.length) {
      void vscode.window.showInformationMessage(
        "This file has no swarm and no state machine.",
      );
    }
    return found[0];
  }
  const items = found.map((each) => ({
    label: each.name,
    description: each.kind === "swarm" ? "swarm" : "state machine",
    each,
  }));
  return (await vscode.window.showQuickPick(items, { title }))?.each;
}

/** The swarms and state machines of the file, in this order. */
export async function subjectsOf(file: vscode.Uri): Promise<Simulated[]> {
  const outline = await vscode.commands.executeCommand<vscode.DocumentSymbol[] | undefined>(
    "vscode.executeDocumentSymbolProvider",
    file,
  );
  const found = (outline ?? []).flatMap(({ name, detail }): Simulated[] => {
    const kind = KINDS[detail];
    return kind ? [{ kind, name }] : [];
  });
  return swarmsFirst(found);
}

/** Let the user choose a scenario beside the file or in `scenarios`, if there are any. */
export async function chooseScenario(file: vscode.Uri): Promise<Scenario | undefined> {
  const none: Scenario = {
    label: "No scenario",
    description: "every function succeeds after a second",
    uri: undefined,
  };
  const lists = await Promise.all(
    scenarioFolders(file.fsPath)
      .filter((folder) => vscode.workspace.getWorkspaceFolder(vscode.Uri.file(folder)))
      .map((folder) => vscode.workspace.findFiles(new vscode.RelativePattern(folder, "*.toml"))),
  );
  const found = lists
    .flat()
    .filter(({ path }) => !/(^|\/)swarm\.toml$|\.swarmtest\.toml$/.test(path))
    .map((uri): Scenario => ({ label: vscode.workspace.asRelativePath(uri), uri }));
  return found.length
    ? vscode.window.showQuickPick([...found, none], { title: "Scenario" })
    : none;
}
