// Tests of the search for swarmc.

import assert from "node:assert/strict";
import { test } from "node:test";

import { find, type Places, type Probe, type Python } from "../src/launch.ts";

const NOWHERE: Places = {
  path: "",
  interpreter: "",
  selected: undefined,
  environments: [],
  swarmc: [],
  pythons: [],
  bundle: "/extension/server",
};

// Interpreters by name; programs with a language server are called `swarmc`.
const PYTHONS: Record<string, Python> = {
  full: { version: [3, 11], hasServer: true },
  plain: { version: [3, 10], hasServer: false },
  other: { version: [3, 13], hasServer: false },
  old: { version: [3, 9], hasServer: false },
  two: { version: [2, 7], hasServer: true },
};
const probe: Probe = {
  python: async (interpreter) => PYTHONS[interpreter],
  swarmc: async (program) => program.endsWith("swarmc"),
};

/** Command line, or the reason that there is none. */
async function line(places: Partial<Places>): Promise<string> {
  const found = await find({ ...NOWHERE, ...places }, probe, () => undefined);
  return "launch" in found
    ? [found.launch.command, ...found.launch.args].join(" ")
    : `${found.setting ?? ""}: ${found.missing}`;
}

const EVERYWHERE: Partial<Places> = {
  selected: "full",
  environments: ["full"],
  swarmc: ["/bin/swarmc"],
  pythons: ["other"],
};
const BUNDLED = "-I /extension/server";

test("settings come first", async () => {
  assert.equal(await line({ ...EVERYWHERE, path: "my/swarmc", interpreter: "plain" }), "my/swarmc");
  assert.equal(await line({ ...EVERYWHERE, interpreter: "plain" }), `plain ${BUNDLED}`);
});

test("an invalid setting is reported", async () => {
  for (const path of ["nothing", "full"]) {
    const setting = "swarmdsl.server.path";
    assert.equal(
      await line({ ...EVERYWHERE, path }),
      `${setting}: ${path} is not a swarmc with a language server.`,
    );
  }
  for (const interpreter of ["nothing", "old", "two"]) {
    const setting = "swarmdsl.server.interpreter";
    assert.equal(
      await line({ ...EVERYWHERE, interpreter }),
      `${setting}: ${interpreter} is not Python 3.10 or later.`,
    );
  }
});

test("the selected interpreter comes before the environment of the workspace", async () => {
  assert.equal(await line(EVERYWHERE), "full -m swarmdsl");
  assert.equal(
    await line({ ...EVERYWHERE, selected: "plain" }),
    "full -m swarmdsl",
    "one without swarmdsl is passed over",
  );
});

test("the PATH comes after environments without swarmdsl", async () => {
  const places = { ...EVERYWHERE, selected: "plain", environments: ["other"] };
  assert.equal(await line(places), "/bin/swarmc");
  assert.equal(await line({ ...places, swarmc: ["/bin/old", "/usr/swarmc"] }), "/usr/swarmc");
  assert.equal(await line({ ...places, swarmc: [], pythons: ["full"] }), "full -m swarmdsl");
});

test("without an installed swarmc, the first recent Python runs the bundled one", async () => {
  const places = { selected: "old", environments: ["other"], pythons: ["plain"] };
  assert.equal(await line(places), `other ${BUNDLED}`);
  assert.equal(await line({ ...places, environments: [] }), `plain ${BUNDLED}`);
});

test("without a recent Python, there is none", async () => {
  const missing = ": No swarmc found, and no Python 3.10 or later to run the bundled one.";
  assert.equal(await line({}), missing);
  assert.equal(await line({ selected: "two", swarmc: ["old"], pythons: ["old", "gone"] }), missing);
});

test("only the copy in the extension counts as bundled", async () => {
  for (const [pythons, bundled] of [["plain", true], ["full", false]] as const) {
    const found = await find({ ...NOWHERE, environments: [pythons] }, probe, () => undefined);
    assert.equal("launch" in found && found.launch.bundled, bundled);
  }
});
