// Tests of running tests: records while they come, failures, cancellation, long command lines, places.

import assert from "node:assert/strict";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";

import { Texts, unitsBefore } from "../src/testing/columns.ts";
import { chosen, runTests } from "../src/testing/process.ts";
import { described, failure, Lines, recordOf, type ResultRecord, type TestingRecord } from "../src/testing/records.ts";
import { isHidden, isRead, mayHold } from "../src/testing/watched.ts";

const NEVER = { isCancellationRequested: false, onCancellationRequested: () => ({ dispose() {} }) };
const PROBLEM = {
  ...{ file: "a.swarmtest.toml", line: 8, column: 31, end_line: 8, end_column: 40 },
  ...{ severity: "error", code: "SW1101", message: "expected `robot` to send `Saw`" },
  ...{ label: "after 1 min: `robot` sends nothing", help: null, notes: ["in the test `it`"] },
};

function node(script: string): Parameters<typeof runTests>[0] {
  return { command: process.execPath, args: ["-e", script], origin: "this test", bundled: false };
}

test("whole lines are read of chunks", () => {
  const lines = new Lines();
  assert.deepEqual(lines.add('{"ty'), []);
  assert.deepEqual(lines.add('pe":1}\nnext\nre'), ['{"type":1}', "next"]);
  assert.deepEqual(lines.add("st\n"), ["rest"]);
  assert.equal(recordOf('{"code":"SW1102"}'), undefined);
  assert.equal(recordOf("Traceback"), undefined);
});

test("a failure begins with what was expected and what there was, and ends with the trace", () => {
  const result: ResultRecord = {
    ...{ type: "result", id: "a::it", name: "it", file: "a", line: 2, column: 8, outcome: "failed" },
    ...{ problems: [PROBLEM], expected: "`robot` to send `Saw`", actual: PROBLEM.label },
    trace: ["  0.000  robot  (start) -> Off"],
  };
  const [first, ...rest] = failure(result).split("\n");
  assert.equal(first, "expected `robot` to send `Saw`, after 1 min: `robot` sends nothing");
  assert.deepEqual(rest.slice(-2), ["the last trace lines:", "  0.000  robot  (start) -> Off"]);
  const loop = { ...PROBLEM, code: "SW1404", message: "it never settles", help: "mend it" };
  const looped = failure({ ...result, problems: [loop], expected: null, actual: null });
  assert.ok(looped.startsWith(`${described(loop)}\n`));
  assert.match(looped, /^it never settles \(SW1404\)\nafter 1 min.*\nnote: .*\nhelp: mend it\n/);
});

test("records come while the program runs, and its errors are kept", async () => {
  const records: TestingRecord[] = [];
  const ended = await runTests(
    node(`console.log(JSON.stringify({ type: "end", args: process.argv.slice(1) }));
      console.error("1 passed"); process.exitCode = 3;`),
    ["--results", "-", "a b::ü"],
    { record: (each) => records.push(each) },
    NEVER,
  );
  assert.deepEqual(records, [{ type: "end", args: ["test", "--results", "-", "a b::ü"] }]);
  assert.deepEqual(ended, { code: 3, told: true, errors: "1 passed" });
});

test("a program that does not start says why", async () => {
  const missing = { ...node(""), command: "/nowhere/swarmc" };
  const ended = await runTests(missing, [], { record() {} }, NEVER);
  assert.equal(ended.code === 0, false);
  assert.match(ended.errors, /ENOENT/);
  assert.equal(ended.told, false);
});

test("cancelling ends the program", async () => {
  let cancel = (): void => undefined;
  const token = {
    isCancellationRequested: false,
    onCancellationRequested(listener: () => void) {
      cancel = listener;
      return { dispose() {} };
    },
  };
  const ended = await runTests(
    node(`console.log(JSON.stringify({ type: "end" })); setInterval(() => {}, 1000);`),
    [],
    { record: () => cancel() },
    token,
  );
  assert.equal(ended.code, undefined);
});

test("files are run instead of more ids than a command line takes", () => {
  const tests = Array.from({ length: 2000 }, (_, each) => ({ id: `/m/a.toml::test ${each}`, file: "/m/a.toml" }));
  assert.deepEqual(chosen(["/m/b.toml"], tests.slice(0, 1)), ["/m/b.toml", "/m/a.toml::test 0"]);
  assert.deepEqual(chosen(["/m/b.toml"], tests), ["/m/b.toml", "/m/a.toml"]);
});

test("columns count characters, and those of the editor UTF-16 units", () => {
  assert.equal(unitsBefore("name = 'lamp'", 9), 8);
  assert.equal(unitsBefore("'\u{1f916}\u{1f916}é' x", 6), 7);
  assert.equal(unitsBefore("\u{1f916}", 4), 4); // after the end of the line
  const folder = mkdtempSync(join(tmpdir(), "swarm-"));
  try {
    const file = join(folder, "a.swarmtest.toml");
    writeFileSync(file, "[[test]]\nname = '\u{1f916} lands'\n");
    const texts = new Texts();
    assert.deepEqual(texts.position(file, 2, 11), { line: 1, character: 11 });
    assert.deepEqual(texts.position(file, 1, 3), { line: 0, character: 2 });
    assert.deepEqual(texts.position(join(folder, "gone"), 3, 4), { line: 2, character: 3 });
  } finally {
    rmSync(folder, { recursive: true });
  }
});

test("the list follows what swarmc reads, and folders", () => {
  for (const path of ["a.swarm", "swarm.toml", ".lib/a.swarm", "msg/A.msg"]) {
    assert.ok(isRead(path) && mayHold(path), path);
  }
  assert.ok(mayHold("missions") && !isRead("missions"));
  for (const path of [".git/index", ".venv/bin/python", "notes.txt", ".cache"]) {
    assert.ok(!isRead(path) && !mayHold(path), path);
  }
  assert.ok(isHidden(".venv/lib/a.swarmtest.toml") && isHidden("a/.b/c"));
  assert.ok(!isHidden("a/b.swarmtest.toml") && !isHidden(".hidden.swarmtest.toml"));
});
