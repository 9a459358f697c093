// Command that proves properties in a terminal, and plays counterexamples.

import { mkdtemp, readFile, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";

import * as vscode from "vscode";

import type { Launch } from "./launch.ts";
import { showBundledLimit } from "./missing.ts";
import { playPage } from "./play.ts";
import type { Server } from "./server.ts";
import { chooseSubject, subjectsOf } from "./simulate.ts";
import type { Simulated } from "./subject.ts";
import { run } from "./tasks.ts";

// A user waits for it.
const LIMIT = "1min";

/** Parts of the results of `swarmc verify` that are shown. */
interface Results {
  readonly subject: string;
  readonly properties: readonly {
    readonly name: string;
    readonly verdict: string;
    readonly reason?: string;
    readonly run?: string;
  }[];
  readonly findings: readonly {
    readonly code: string;
    readonly name: string;
    readonly run?: string;
  }[];
}

interface Shown extends vscode.QuickPickItem {
  readonly run: string;
}

/** Verify `subject`, or let the user choose one of the file, and show a run that is wrong. */
export async function verify(
  server: Server,
  file: vscode.Uri,
  subject?: Simulated,
): Promise<void> {
  const launch = await server.swarmc();
  if (!launch) {
    return;
  }
  if (launch.bundled) {
    showBundledLimit("verify a model");
    return;
  }
  const chosen = subject ?? (await chooseSubject(file, "Verify"));
  if (!chosen) {
    return;
  }
  // swarmc reads files from disk.
  await vscode.workspace.saveAll(false);
  const folder = await mkdtemp(join(tmpdir(), "swarm-"));
  const results = join(folder, "results.json");
  const args = ["verify", file.fsPath, `--${chosen.kind}`, chosen.name, "--limit", LIMIT];
  args.push("-o", join(folder, "runs"), "--results", results);
  const task = new vscode.Task(
    { type: "swarmdsl", command: "verify" },
    vscode.workspace.getWorkspaceFolder(file) ?? vscode.TaskScope.Workspace,
    `verify ${chosen.name}`,
    "swarmc",
    run(launch, args, dirname(file.fsPath)),
  );
  const running = await vscode.tasks.executeTask(task);
  const ended = vscode.tasks.onDidEndTask(async ({ execution }) => {
    if (execution === running) {
      ended.dispose();
      await showResults(results, file, launch);
      await rm(folder, { recursive: true, force: true });
    }
  });
}

async function showResults(path: string, file: vscode.Uri, launch: Launch): Promise<void> {
  let results: Results;
  try {
    results = JSON.parse(await readFile(path, "utf8")) as Results;
  } catch {
    return; // the terminal says why there are none
  }
  const shown = await chooseRun(results);
  if (!shown) {
    return;
  }
  const subject = (await subjectsOf(file)).find(({ name }) => name === results.subject);
  const of = subject ? [`--${subject.kind}`, subject.name] : [];
  const words = ["play", file.fsPath, ...of, "--counterexample", shown.run, "-o"];
  if (!(await playPage(launch, file, shown.label, words))) {
    void vscode.window.showWarningMessage(`The run of ${shown.label} has no page: see the terminal.`);
  }
}

/** The run that shows what is wrong; the user chooses if there are several. */
async function chooseRun({ properties, findings }: Results): Promise<Shown | undefined> {
  const wrong = [
    ...properties.map((each) => ({ ...each, description: each.verdict })),
    ...findings.map((each) => ({ ...each, description: each.code })),
  ];
  const items = wrong.flatMap(({ name, description, run }): Shown[] =>
    run === undefined ? [] : [{ label: name, description, run }],
  );
  if (items.length > 1) {
    return vscode.window.showQuickPick(items, { title: "Counterexample" });
  }
  if (!items.length) {
    const verdicts = properties.map(({ name, verdict }) => `${name}: ${verdict}`);
    void vscode.window.showInformationMessage(
      ["No run was found that is wrong.", ...verdicts].join(" "),
    );
  }
  return items[0];
}
