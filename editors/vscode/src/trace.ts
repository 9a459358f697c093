// Follows a growing trace: one JSON line for each step of a member.

import { type FileHandle, open, stat } from "node:fs/promises";

import type { Active, Highlights, Moved, Steps } from "./highlights.ts";

const POLL_INTERVAL = 100; // milliseconds between polls of the file
const CHUNK = 1 << 20;
const RECENT = 1000; // milliseconds for which a step counts as just taken

interface Step {
  readonly time: number;
  readonly member: string;
  readonly configuration: readonly string[];
  readonly taken: readonly string[];
  readonly entered: readonly string[];
}

export class Trace implements Highlights {
  private readonly path: string;
  private readonly alone: string;
  private readonly moved: Moved;
  private readonly timer: NodeJS.Timeout;
  private active: Active = {};
  private file: FileHandle | undefined;
  private inode = 0;
  private at = 0;
  private rest = "";
  private reading: Promise<void> | undefined;
  private disposed = false;

  /** `alone` is the name of a member without a name. The file may be created later. */
  constructor(path: string, alone: string, moved: Moved) {
    this.path = path;
    this.alone = alone;
    this.moved = moved;
    this.timer = setInterval(() => void this.look(), POLL_INTERVAL);
  }

  resend(): void {
    this.moved(this.active, {});
  }

  /** The trace is complete: read the rest, and keep the last states. */
  async end(): Promise<void> {
    clearInterval(this.timer);
    await this.reading;
    await this.look();
    await this.close();
  }

  dispose(): void {
    clearInterval(this.timer);
    this.disposed = true;
    void this.close();
    this.forget();
  }

  private async close(): Promise<void> {
    const file = this.file;
    this.file = undefined;
    await file?.close();
  }

  private look(): Promise<void> {
    if (this.disposed) {
      return Promise.resolve();
    }
    this.reading ??= this.read()
      .catch(() => undefined) // the file does not exist yet, or no longer
      .then(() => (this.reading = undefined));
    return this.reading;
  }

  private async read(): Promise<void> {
    const { size, ino } = await stat(this.path);
    if (!this.file || size < this.at || ino !== this.inode) {
      await this.close();
      this.file = await open(this.path);
      [this.inode, this.at, this.rest] = [ino, 0, ""];
      this.forget();
    }
    const steps: Step[] = [];
    const buffer = Buffer.alloc(CHUNK);
    for (;;) {
      const { bytesRead } = await this.file.read(buffer, 0, CHUNK, this.at);
      if (!bytesRead) {
        break;
      }
      this.at += bytesRead;
      // Latin-1 keeps bytes: a chunk may end inside a UTF-8 character.
      const lines = (this.rest + buffer.toString("latin1", 0, bytesRead)).split("\n");
      this.rest = lines.pop() ?? "";
      steps.push(...lines.flatMap((line) => this.step(line) ?? []));
    }
    if (steps.length) {
      const found = Object.fromEntries(steps.map((each) => [each.member, each.configuration]));
      this.active = { ...this.active, ...found };
      this.moved(found, latest(steps));
    }
  }

  private step(line: string): Step | undefined {
    try {
      const { t, member, event, configuration, taken, entered } = JSON.parse(
        Buffer.from(line, "latin1").toString("utf8"),
      );
      const states = Array.isArray(entered) ? entered : [];
      return Array.isArray(configuration)
        ? {
            time: typeof t === "number" ? t : 0,
            member: member ?? this.alone,
            configuration,
            taken: Array.isArray(taken) ? taken : [],
            // The machine itself is entered at its start.
            entered: event === null && states.length ? ["", ...states] : states,
          }
        : undefined;
    } catch {
      return undefined; // not a trace line
    }
  }

  private forget(): void {
    this.moved(Object.fromEntries(Object.keys(this.active).map((each) => [each, null])), {});
    this.active = {};
  }
}

/** Recent steps of members; older ones are dropped. */
function latest(steps: readonly Step[]): Steps {
  const last = steps.reduce((most, { time }) => Math.max(most, time), 0);
  const taken: Record<string, string[]> = {};
  const entered: Record<string, string[]> = {};
  for (const each of steps.filter(({ time }) => time > last - RECENT)) {
    (taken[each.member] ??= []).push(...each.taken);
    (entered[each.member] ??= []).push(...each.entered);
  }
  return { taken, entered };
}
