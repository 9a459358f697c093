// Tests of what is offered: interpreters, folders for projects, subjects of simulations.

import assert from "node:assert/strict";
import { mkdir, mkdtemp, rm, symlink, writeFile } from "node:fs/promises";
import { tmpdir } from "node:os";
import { dirname, join } from "node:path";
import { test } from "node:test";

import { isHidden, scenarioFolders } from "../src/entries.ts";
import { swarmsFirst } from "../src/subject.ts";
import { environmentsIn, unique } from "../src/probe.ts";

async function program(path: string): Promise<string> {
  await mkdir(dirname(path), { recursive: true });
  await writeFile(path, "", { mode: 0o755 });
  return path;
}

test("environments of the home folder are found, and links are one interpreter", async () => {
  const home = await mkdtemp(join(tmpdir(), "home"));
  try {
    const system = await program(join(home, "usr", "bin", "python3"));
    await symlink(join(home, "usr", "bin"), join(home, "bin"));
    const environments = [];
    for (const name of ["robots", "swarm"]) {
      const python = join(home, name, "bin", "python");
      await mkdir(dirname(python), { recursive: true });
      await writeFile(join(home, name, "pyvenv.cfg"), "");
      await symlink(system, python);
      await symlink(system, join(home, name, "bin", "python3"));
      environments.push(python);
    }
    assert.deepEqual(await environmentsIn(home), environments);
    assert.deepEqual(await environmentsIn(join(home, "none")), []);
    const again = environments.map((each) => `${each}3`);
    const linked = join(home, "bin", "python3");
    assert.deepEqual(await unique([...environments, undefined, system, linked, ...again]), [
      ...environments,
      system,
    ]);
  } finally {
    await rm(home, { recursive: true });
  }
});

test("settings of tools leave a folder free for a project", () => {
  assert.deepEqual([".vscode", ".venv", ".git", ".gitignore", "models"].filter(isHidden), [
    ".vscode",
    ".venv",
    ".git",
  ]);
});

test("a swarm is offered before its state machines", () => {
  const machines = ["Idle", "Busy"].map((name) => ({ kind: "machine", name }) as const);
  const swarm = { kind: "swarm", name: "All" } as const;
  assert.deepEqual(swarmsFirst([...machines, swarm]), [swarm, ...machines]);
});

test("scenarios are those beside a model and those of its project", () => {
  assert.deepEqual(scenarioFolders(join("rescue", "models", "rescue.swarm")), [
    join("rescue", "models"),
    join("rescue", "models", "scenarios"),
    join("rescue", "scenarios"),
  ]);
});
