// Tests of following ROS 2 nodes.

import assert from "node:assert/strict";
import { mkdtemp, rm, writeFile } from "node:fs/promises";
import { homedir, tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";

import type { Active, Steps } from "../src/highlights.ts";
import { Nodes } from "../src/nodes.ts";

// Fake swarmc: prints its arguments and serves events of a page.
const SERVES = `
const { createServer } = require("node:http");
const news = [
  { titles: {} },
  { active: { "uav[0]": ["Höhe"], [process.argv.slice(2).join(" ") + " in " + process.cwd()]: ["Idle"] } },
  { active: { "uav[0]": null } },
  { taken: { "uav[1]": ["Höhe->0"] }, entered: { "uav[1]": ["Tal"] } },
];
const server = createServer((asked, answer) => {
  if (asked.url !== "/events") throw new Error(asked.url);
  const bytes = Buffer.from(": here\\n\\n" + news.map((each) => "data: " + JSON.stringify(each) + "\\n\\n").join(""));
  const within = bytes.indexOf(0xc3) + 1; // inside a UTF-8 character
  answer.write(bytes.subarray(0, within), () => setTimeout(() => answer.write(bytes.subarray(within)), 50));
});
server.listen(0, "127.0.0.1", () =>
  console.log("1 file is right; http://127.0.0.1:" + server.address().port + "/"));
process.on("SIGINT", () => process.exit(0));
`;
const FAILS = `console.error("error[SW1012]: cannot follow ROS 2 nodes\\n  = help: source it"); process.exit(1);`;

interface Told {
  readonly nodes: Nodes;
  readonly model: string;
  /** Next change, or the reason of the end. */
  next(): Promise<[Active, Steps] | string>;
}

async function followed(script: string, run: (told: Told) => Promise<void>): Promise<void> {
  const folder = await mkdtemp(join(tmpdir(), "nodes-"));
  const program = join(folder, "swarmc.cjs");
  await writeFile(program, script);
  const launch = { command: process.execPath, args: [program], origin: "", bundled: false };
  const told: ([Active, Steps] | string)[] = [];
  let wake = (): void => undefined;
  const tell = (news: [Active, Steps] | string): void => {
    told.push(news);
    wake();
  };
  const model = join(folder, "a.swarm");
  const nodes = new Nodes(launch, model, "/sar", (...each) => tell(each), tell);
  const next = async (): Promise<[Active, Steps] | string> => {
    while (!told.length) {
      await new Promise<void>((resolve) => (wake = resolve));
    }
    return told.shift() ?? "";
  };
  try {
    await run({ nodes, model, next });
  } finally {
    nodes.dispose();
    await rm(folder, { recursive: true });
  }
}

test("nodes are followed until disposal", () =>
  followed(SERVES, async ({ nodes, model, next }) => {
    const line = `preview ${model} --follow ros2:/sar in ${homedir()}`;
    const nothing = { taken: undefined, entered: undefined };
    assert.deepEqual(await next(), [{ "uav[0]": ["Höhe"], [line]: ["Idle"] }, nothing]);
    assert.deepEqual(await next(), [{ "uav[0]": null }, nothing]);
    const steps = { taken: { "uav[1]": ["Höhe->0"] }, entered: { "uav[1]": ["Tal"] } };
    assert.deepEqual(await next(), [{}, steps]);
    nodes.resend();
    assert.deepEqual(await next(), [{ [line]: ["Idle"] }, {}]);
    nodes.dispose();
    assert.deepEqual(await next(), [{ [line]: null }, {}]);
  }));

test("errors of swarmc are reported", () =>
  followed(FAILS, async ({ next }) => {
    assert.deepEqual(await next(), [{}, {}]);
    assert.match(String(await next()), /^error\[SW1012\].*\n.*source it$/);
  }));
