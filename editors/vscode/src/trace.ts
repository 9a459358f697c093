// Follows a trace while it is written: a line of JSON for each step of a member.

import { type FileHandle, open, stat } from "node:fs/promises";

const PAUSE = 100; // milliseconds between two looks at the file
const CHUNK = 1 << 20;

/** The innermost active states of members; null of those that are gone. */
export type Active = Record<string, readonly string[] | null>;

export class Trace {
  private readonly path: string;
  private readonly alone: string;
  private readonly moved: (active: Active) => void;
  private readonly timer: NodeJS.Timeout;
  private active: Active = {};
  private file: FileHandle | undefined;
  private inode = 0;
  private at = 0;
  private rest = "";
  private reading: Promise<void> | undefined;
  private disposed = false;

  /** `alone` is what a member without a name is called. The file may come later. */
  constructor(path: string, alone: string, moved: (active: Active) => void) {
    this.path = path;
    this.alone = alone;
    this.moved = moved;
    this.timer = setInterval(() => void this.look(), PAUSE);
  }

  /** Say again where all are. */
  again(): void {
    this.moved(this.active);
  }

  /** What is written is all there will be: read the rest, and leave all where they are. */
  async end(): Promise<void> {
    clearInterval(this.timer);
    await this.reading;
    await this.look();
    await this.close();
  }

  /** End it: nobody is anywhere any more. */
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
    const found: Active = {};
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
      lines.forEach((line) => Object.assign(found, this.step(line)));
    }
    if (Object.keys(found).length) {
      this.active = { ...this.active, ...found };
      this.moved(found);
    }
  }

  private step(line: string): Active {
    try {
      const { member, configuration } = JSON.parse(Buffer.from(line, "latin1").toString("utf8"));
      return Array.isArray(configuration) ? { [member ?? this.alone]: configuration } : {};
    } catch {
      return {}; // no line of a trace
    }
  }

  private forget(): void {
    this.moved(Object.fromEntries(Object.keys(this.active).map((each) => [each, null])));
    this.active = {};
  }
}
