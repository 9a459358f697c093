// Follows a trace while it is written: a line of JSON for each step of a member.

import { type FileHandle, open, stat } from "node:fs/promises";

import type { Active, Lights, Moved, Steps } from "./lights.ts";

const PAUSE = 100; // milliseconds between two looks at the file
const CHUNK = 1 << 20;
const MOMENT = 1000; // milliseconds for which a step counts as just done

interface Step {
  readonly time: number;
  readonly member: string;
  readonly configuration: readonly string[];
  readonly taken: readonly string[];
  readonly entered: readonly string[];
}

export class Trace implements Lights {
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

  /** `alone` is what a member without a name is called. The file may come later. */
  constructor(path: string, alone: string, moved: Moved) {
    this.path = path;
    this.alone = alone;
    this.moved = moved;
    this.timer = setInterval(() => void this.look(), PAUSE);
  }

  again(): void {
    this.moved(this.active, {});
  }

  /** What is written is all there will be: read the rest, and leave all where they are. */
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
      .catch(() => undefined) // it is not there yet, or not any more
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
      // As one byte a character, since a chunk may end within one of several.
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
            // The machine itself is entered when it begins.
            entered: event === null && states.length ? ["", ...states] : states,
          }
        : undefined;
    } catch {
      return undefined; // no line of a trace
    }
  }

  private forget(): void {
    this.moved(Object.fromEntries(Object.keys(this.active).map((each) => [each, null])), {});
    this.active = {};
  }
}

/** What members have done at the end of some steps: others are long past. */
function latest(steps: readonly Step[]): Steps {
  const last = steps.reduce((most, { time }) => Math.max(most, time), 0);
  const taken: Record<string, string[]> = {};
  const entered: Record<string, string[]> = {};
  for (const each of steps.filter(({ time }) => time > last - MOMENT)) {
    (taken[each.member] ??= []).push(...each.taken);
    (entered[each.member] ??= []).push(...each.entered);
  }
  return { taken, entered };
}
