// Tests of following a trace.

import assert from "node:assert/strict";
import { appendFile, mkdtemp, rm, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";

import type { Active, Steps } from "../src/highlights.ts";
import { Trace } from "../src/trace.ts";

const DEADLINE = 20_000;

function step(member: string | null, ...configuration: string[]): string {
  return `${JSON.stringify({ t: 0, member, event: null, configuration })}\n`;
}

function taken(t: number, member: string, ...taken: string[]): string {
  const event = t > 9_500 ? "Go" : null;
  const configuration = ["End"];
  return `${JSON.stringify({ t, member, event, configuration, taken, entered: configuration })}\n`;
}

test("a trace is followed as it grows and when it restarts", async (test) => {
  const folder = await mkdtemp(join(tmpdir(), "trace-"));
  const path = join(folder, "trace.jsonl");
  const told: Active[] = [];
  const steps: Steps[] = [];
  const trace = new Trace(path, "Alone", (active, done) => {
    if (Object.keys(active).length) {
      told.push(active);
    }
    if (Object.keys(done).length) {
      steps.push(done);
    }
  });
  test.after(() => trace.dispose()); // else it polls forever
  const next = async (): Promise<Active | undefined> => {
    const end = Date.now() + DEADLINE;
    while (!told.length && Date.now() < end) {
      await new Promise((resolve) => setTimeout(resolve, 10));
    }
    return told.shift();
  };

  await writeFile(path, step("uav[0]", "Mission.Idle") + step("uav[1]", "Mission.Idle"));
  assert.deepEqual(await next(), { "uav[0]": ["Mission.Idle"], "uav[1]": ["Mission.Idle"] });
  const line = Buffer.from(step("ü", "Höhe", "Weite"));
  await appendFile(path, line.subarray(0, line.indexOf(0xbc))); // inside a UTF-8 character
  await new Promise((resolve) => setTimeout(resolve, 300));
  await appendFile(path, line.subarray(line.indexOf(0xbc)));
  assert.deepEqual(await next(), { ü: ["Höhe", "Weite"] });
  const odd = JSON.stringify({ t: "now", configuration: ["Idle"], taken: 5 });
  await appendFile(path, `no trace\n${odd}\n${step(null, "Busy")}`);
  assert.deepEqual(await next(), { Alone: ["Busy"] });

  await writeFile(path, step("uav[0]", "Start"));
  assert.deepEqual(await next(), { "uav[0]": null, "uav[1]": null, ü: null, Alone: null });
  assert.deepEqual(await next(), { "uav[0]": ["Start"] });

  assert.ok(steps.every(({ taken }) => Object.values(taken ?? {}).every((ids) => !ids.length)));
  const long = [taken(100, "uav[1]", "A->0"), taken(9_500, "uav[0]", "A->0", "B->1")];
  await appendFile(path, long.join("") + taken(10_000, "uav[0]", "C->0"));
  assert.deepEqual(await next(), { "uav[0]": ["End"], "uav[1]": ["End"] });
  assert.deepEqual(steps.at(-1), {
    taken: { "uav[0]": ["A->0", "B->1", "C->0"] },
    entered: { "uav[0]": ["", "End", "End"] },
  });
  await writeFile(path, step("uav[0]", "Start"));
  assert.deepEqual(await next(), { "uav[0]": null, "uav[1]": null });
  assert.deepEqual(await next(), { "uav[0]": ["Start"] });

  await appendFile(path, step("uav[0]", "End"));
  await trace.end();
  assert.deepEqual(told.shift(), { "uav[0]": ["End"] });
  assert.deepEqual(told, []);
  trace.dispose();
  assert.deepEqual(told, [{ "uav[0]": null }]);
  await trace.end(); // as when the writing task ends later
  assert.deepEqual(told, [{ "uav[0]": null }]);
  await rm(folder, { recursive: true });
});
