// Inspects programs by running them.

import { execFile } from "node:child_process";
import { access, constants, readdir, realpath } from "node:fs/promises";
import { delimiter, dirname, join } from "node:path";

import type { Probe, Python } from "./launch.ts";

const WINDOWS = process.platform === "win32";
const TIMEOUT = 15_000;
const SCRIPT = `
import sys
try:
    try:
        import swarmdsl.ide.server
    except ModuleNotFoundError:
        import swarmdsl.server  # versions before 0.2
    found = 1
except ImportError:
    found = 0
print(*sys.version_info[:2], found)
`;

export const probe: Probe = {
  async python(interpreter): Promise<Python | undefined> {
    const answer = await output(interpreter, ["-c", SCRIPT]);
    const numbers = /^(\d+) (\d+) ([01])\s*$/.exec(answer ?? "");
    return numbers
      ? { version: [Number(numbers[1]), Number(numbers[2])], hasServer: numbers[3] === "1" }
      : undefined;
  },
  async swarmc(program) {
    return (await output(program, ["lsp", "--help"])) !== undefined;
  },
};

/** Output of a program; undefined if it fails. */
function output(program: string, args: string[]): Promise<string | undefined> {
  return new Promise((resolve) => {
    // Python imports modules from its working directory.
    execFile(program, args, { timeout: TIMEOUT, cwd: __dirname }, (error, stdout) => resolve(error ? undefined : stdout));
  });
}

/** Interpreter of a virtual environment; undefined if there is none. */
export async function interpreterIn(folder: string): Promise<string | undefined> {
  const path = WINDOWS ? join(folder, "Scripts", "python.exe") : join(folder, "bin", "python");
  return (await runs(path)) ? path : undefined;
}

/** Interpreters of the virtual environments in a folder, such as that of the user. */
export async function environmentsIn(folder: string): Promise<string[]> {
  const names = await readdir(folder).catch(() => []);
  const found = await Promise.all(
    names.sort().map(async (name) => {
      const environment = join(folder, name);
      return (await exists(join(environment, "pyvenv.cfg"))) ? interpreterIn(environment) : undefined;
    }),
  );
  return found.filter((each) => each !== undefined);
}

/** Programs without repetitions: links in the same environment, or outside of all, are one. */
export async function unique(programs: readonly (string | undefined)[]): Promise<string[]> {
  const found = new Map<string, string>();
  for (const program of programs) {
    if (program !== undefined) {
      const folder = dirname(program);
      const isEnvironment = await exists(join(dirname(folder), "pyvenv.cfg"));
      const real = await realpath(isEnvironment ? folder : program).catch(() => program);
      found.set(real, found.get(real) ?? program);
    }
  }
  return [...found.values()];
}

/** Paths of programs on the PATH. */
export async function onPath(...names: string[]): Promise<string[]> {
  const found: string[] = [];
  const folders = (process.env["PATH"] ?? "").split(delimiter).filter((each) => each !== "");
  for (const name of names) {
    for (const folder of folders) {
      const path = join(folder, WINDOWS ? `${name}.exe` : name);
      if (!found.includes(path) && (await runs(path))) {
        found.push(path);
      }
    }
  }
  return found;
}

function runs(path: string): Promise<boolean> {
  return exists(path, constants.X_OK);
}

async function exists(path: string, mode = constants.F_OK): Promise<boolean> {
  try {
    await access(path, mode);
    return true;
  } catch {
    return false;
  }
}
