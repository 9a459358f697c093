// Runs `swarmc test` and reads its records while they come.

import { type ChildProcess, execFile, spawn } from "node:child_process";
import { isAbsolute, join } from "node:path";

import type { Launch } from "../launch.ts";
import { Lines, recordOf, type TestingRecord } from "./records.ts";

// Windows allows 32,767 characters.
const LONGEST = 24_000;
// Python would import modules from the folder of a model. Paths that swarmc tells are relative to it.
const FOLDER = __dirname;

export interface Ended {
  /** Exit code; undefined if the program did not start, or was ended. */
  readonly code: number | undefined;
  /** True if it wrote any record: a swarmc that is too old does not. */
  readonly told: boolean;
  /** Text that it wrote for people, and why it did not start. */
  readonly errors: string;
}

interface Listener {
  record(record: TestingRecord): void;
  /** Text for people. */
  text?(text: string): void;
}

export interface Cancelled {
  onCancellationRequested(listener: () => void): { dispose(): void };
  readonly isCancellationRequested: boolean;
}

/** Run `swarmc test` with arguments until it ends or is cancelled; paths in them are absolute. */
export function runTests(
  launch: Launch,
  args: readonly string[],
  listener: Listener,
  token: Cancelled,
): Promise<Ended> {
  return new Promise((resolve) => {
    if (token.isCancellationRequested) {
      resolve({ code: undefined, told: false, errors: "" });
      return;
    }
    const child = spawn(launch.command, [...launch.args, "test", ...args], {
      cwd: FOLDER,
      env: { ...process.env, PYTHONUTF8: "1", PYTHONUNBUFFERED: "1" },
      stdio: ["ignore", "pipe", "pipe"],
      windowsHide: true,
    });
    const cancelling = token.onCancellationRequested(() => end(child));
    const lines = new Lines();
    let told = false;
    let errors = "";
    child.stdout.setEncoding("utf8").on("data", (text: string) => {
      for (const line of lines.add(text)) {
        const record = recordOf(line);
        told ||= record !== undefined;
        if (record) {
          listener.record(record);
        } else {
          errors += `${line}\n`;
        }
      }
    });
    child.stderr.setEncoding("utf8").on("data", (text: string) => {
      errors += text;
      listener.text?.(text);
    });
    child.on("error", (error) => (errors += error.message));
    // Also after an error.
    child.on("close", (code) => {
      cancelling.dispose();
      resolve({ code: code ?? undefined, told, errors: errors.trim() });
    });
  });
}

/** Absolute path of a file that swarmc names. */
export function absolute(file: string): string {
  return isAbsolute(file) ? file : join(FOLDER, file);
}

/** End a process and those that it started: on Windows, swarmc starts a Python. */
function end(child: ChildProcess): void {
  if (process.platform === "win32" && child.pid !== undefined) {
    execFile("taskkill", ["/pid", String(child.pid), "/t", "/f"]);
  } else {
    child.kill();
  }
}

/**
 * Arguments that choose tests: their ids, or their files where a command line has no room for these.
 *
 * Then more tests run than are wanted.
 */
export function chosen(files: readonly string[], tests: readonly { id: string; file: string }[]): string[] {
  const ids = tests.map(({ id }) => id);
  const length = [...files, ...ids].reduce((sum, each) => sum + each.length + 3, 0);
  return length <= LONGEST
    ? [...files, ...ids]
    : [...new Set([...files, ...tests.map(({ file }) => file)])];
}
