// Runs tests of the Test view, and shows their results while they come.

import { mkdtemp, readFile, rm } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";

import * as vscode from "vscode";

import { showPage } from "../play.ts";
import type { Server } from "../server.ts";
import { Texts } from "./columns.ts";
import { coverageOf } from "./coverage.ts";
import { debugTest } from "./debugging.ts";
import { type Cancelled, chosen, type Ended, runTests } from "./process.ts";
import {
  type CoverageRecord,
  described,
  type EndRecord,
  failure,
  type Problem,
  type ResultRecord,
  type TestingRecord,
} from "./records.ts";
import { locationOf, type Tree } from "./tree.ts";

// Characters of what swarmc tells that a message has.
const LONGEST_TEXT = 2000;

export type Kind = "run" | "play" | "debug" | "coverage";

export class Runs {
  private readonly controller: vscode.TestController;
  private readonly server: Server;
  private readonly tree: Tree;

  constructor(controller: vscode.TestController, server: Server, tree: Tree) {
    this.controller = controller;
    this.server = server;
    this.tree = tree;
  }

  /**
   * Run the tests of a request; of kind `play`, play the first that fails or the only one.
   *
   * Of kind `debug`, they run one after the other.
   */
  async run(
    request: vscode.TestRunRequest,
    kind: Kind,
    token: vscode.CancellationToken,
  ): Promise<void> {
    const { files, tests, all } = wanted(request, this.tree);
    if (!all.length) {
      return; // without arguments, swarmc would run what it finds
    }
    const run = this.controller.createTestRun(request);
    all.forEach((item) => run.enqueued(item));
    const found = await this.server.found();
    if (!("launch" in found)) {
      const why = `The tests cannot be run. ${found.missing}`;
      all.forEach((item) => run.errored(item, new vscode.TestMessage(why)));
      run.appendOutput(`${why}\r\n`);
      run.end();
      return;
    }
    const texts = new Texts();
    const stopped = either(token, run.token);
    if (kind === "debug") {
      await this.debug(run, all, texts, stopped);
      run.end();
      return;
    }
    const pages = kind === "play" ? await mkdtemp(join(tmpdir(), "swarm-")) : undefined;
    const page = pages && join(pages, "run.html");
    const pending = new Set(all);
    const coverage: CoverageRecord[] = [];
    let end: EndRecord | undefined;
    const args = ["--results", "-", ...(kind === "coverage" ? ["--coverage"] : [])];
    args.push(...(page ? ["--play", page] : []), ...chosen(files, tests));
    const ended = await runTests(
      found.launch,
      args,
      {
        record: (record) => {
          if (record.type === "coverage") {
            coverage.push(record);
          } else if (record.type === "end") {
            end = record;
          } else {
            this.show(run, record, texts, pending);
          }
        },
        text: (text) => run.appendOutput(text.replace(/\r?\n/g, "\r\n")),
      },
      stopped,
    );
    if (stopped.isCancellationRequested) {
      pending.forEach((item) => run.skipped(item));
    } else {
      tellPending(run, pending, end, ended);
    }
    coverageOf(coverage, texts).forEach((each) => run.addCoverage(each));
    run.end();
    if (pages && page) {
      const html = await readFile(page, "utf8").catch(() => undefined);
      await rm(pages, { recursive: true, force: true });
      if (html !== undefined) {
        showPage(html, all.length === 1 && all[0] ? all[0].label : "the test that fails");
      } else if (!stopped.isCancellationRequested) {
        void vscode.window.showInformationMessage(
          "There is no run to play: of several tests, the first that fails is played. See the test results.",
        );
      }
    }
  }

  /** Debug tests until a session ends without a result: the user has had enough. */
  private async debug(
    run: vscode.TestRun,
    items: readonly vscode.TestItem[],
    texts: Texts,
    stopped: Cancelled,
  ): Promise<void> {
    let goesOn = true;
    for (const item of items) {
      if (!goesOn || stopped.isCancellationRequested) {
        run.skipped(item);
        continue;
      }
      run.started(item);
      // A file that cannot be read may have no tests.
      const id = this.tree.testOf(item)?.id ?? item.uri?.fsPath ?? "";
      const { started, result } = await debugTest(id, item, run, stopped);
      if (result) {
        // The time would include that of the user.
        const { seconds: _, ...timeless } = result;
        showResult(run, item, timeless, texts);
      } else if (started) {
        run.skipped(item);
      } else {
        run.errored(item, placed("The debugger did not start: see its message.", item));
      }
      goesOn = started && result !== undefined;
    }
  }

  /** Show a record. Tests that are not wanted may run too, where a command line is too short. */
  private show(
    run: vscode.TestRun,
    record: TestingRecord,
    texts: Texts,
    pending: Set<vscode.TestItem>,
  ): void {
    if (record.type === "file" && !record.read) {
      const item = this.tree.file(vscode.Uri.file(record.file));
      if (pending.delete(item)) {
        tellUnread(run, item, record.problems, texts);
      }
    } else if (record.type === "started") {
      run.started(this.tree.item(record, texts));
    } else if (record.type === "result") {
      const item = this.tree.item(record, texts);
      pending.delete(item);
      showResult(run, item, record, texts);
    }
  }
}

function showResult(
  run: vscode.TestRun,
  item: vscode.TestItem,
  record: ResultRecord,
  texts: Texts,
): void {
  const duration = record.seconds === undefined ? undefined : record.seconds * 1000;
  if (record.outcome === "passed") {
    run.passed(item, duration);
    return;
  }
  if (record.outcome === "unread") {
    tellUnread(run, item, record.problems, texts);
    return;
  }
  // Warnings about guards and effects come first.
  const place = record.problems.find(({ severity, file }) => severity === "error" && file !== null);
  const message = placed(failure(record), item, place && locationOf(place, texts));
  run.failed(item, message, duration);
}

function tellUnread(
  run: vscode.TestRun,
  item: vscode.TestItem,
  problems: readonly Problem[],
  texts: Texts,
): void {
  const messages = problems.map((each) => placed(described(each), item, locationOf(each, texts)));
  // A model with errors reports them once.
  run.errored(item, messages.length ? messages : placed("The model has errors.", item));
}

function placed(text: string, item: vscode.TestItem, location?: vscode.Location): vscode.TestMessage {
  const message = new vscode.TestMessage(text);
  const start = item.uri && item.range ? new vscode.Location(item.uri, item.range) : undefined;
  const found = location ?? start;
  if (found) {
    message.location = found;
  }
  return message;
}

/** Tests of which there is no result: they are gone, or swarmc has failed. */
function tellPending(
  run: vscode.TestRun,
  pending: ReadonlySet<vscode.TestItem>,
  end: EndRecord | undefined,
  { errors }: Ended,
): void {
  const why = end
    ? ["There is no such test any more.", ...end.problems.map(described)].join("\n\n")
    : `swarmc ended before the tests did.\n${errors.slice(-LONGEST_TEXT)}`;
  pending.forEach((item) => run.errored(item, placed(why, item)));
}

/** Files and single tests that a request wants, and all tests among them. */
function wanted(
  request: vscode.TestRunRequest,
  tree: Tree,
): {
  files: string[];
  tests: { id: string; file: string }[];
  all: vscode.TestItem[];
} {
  const left = new Set(request.exclude);
  const files: string[] = [];
  const tests: { id: string; file: string }[] = [];
  const all = new Set<vscode.TestItem>();
  for (const item of request.include ?? tree.files) {
    const inside = [...item.children].map(([, each]) => each);
    const isTest = tree.testOf(item) !== undefined;
    const chosenTests = (isTest ? [item] : inside).filter((each) => !left.has(each));
    if (left.has(item)) {
      continue;
    }
    if (!isTest && chosenTests.length === inside.length && item.uri) {
      files.push(item.uri.fsPath);
    } else {
      tests.push(...chosenTests.flatMap((each) => tree.testOf(each) ?? []));
    }
    // A file that cannot be read may have no tests.
    (isTest || inside.length ? chosenTests : [item]).forEach((each) => all.add(each));
  }
  return { files, tests, all: [...all] };
}

function either(...tokens: vscode.CancellationToken[]): {
  onCancellationRequested(listener: () => void): vscode.Disposable;
  readonly isCancellationRequested: boolean;
} {
  return {
    onCancellationRequested: (listener) =>
      vscode.Disposable.from(...tokens.map((each) => each.onCancellationRequested(listener))),
    get isCancellationRequested() {
      return tokens.some((each) => each.isCancellationRequested);
    },
  };
}
