// Follows nodes of ROS 2 while they run: a swarmc listens to them, and says what it tells its page.

import { type ChildProcess, spawn } from "node:child_process";
import { get } from "node:http";
import { dirname } from "node:path";

import type { Launch } from "./launch.ts";
import type { Active, Lights, Moved } from "./lights.ts";

const ADDRESS = /http:\/\/127\.0\.0\.1:\d+\//;
const EVENT = "data: ";
const MOST_KEPT = 10_000; // characters of what it says

export class Nodes implements Lights {
  private readonly child: ChildProcess;
  private readonly moved: Moved;
  private active: Active = {};
  private said = "";
  private disposed = false;

  /**
   * `name` is that of a node or of a namespace; empty, it stands for all. `ended` is called with
   * what swarmc has said last if it ends by itself.
   */
  constructor(
    launch: Launch,
    model: string,
    name: string,
    moved: Moved,
    ended: (why: string) => void,
  ) {
    this.moved = moved;
    this.child = spawn(
      launch.command,
      [...launch.args, "preview", model, "--follow", `ros2:${name}`],
      { cwd: dirname(model), stdio: ["ignore", "pipe", "pipe"] },
    );
    let address: string | undefined;
    const hear = (chunk: string): void => {
      this.said = (this.said + chunk).slice(-MOST_KEPT);
      if (address === undefined && (address = ADDRESS.exec(this.said)?.[0]) !== undefined) {
        this.listen(`${address}events`);
      }
    };
    this.child.stdout?.setEncoding("utf8").on("data", hear);
    this.child.stderr?.setEncoding("utf8").on("data", hear);
    const end = (why: string): void => {
      if (!this.disposed) {
        this.dispose();
        ended(why);
      }
    };
    this.child.on("error", (error) => end(error.message));
    this.child.on("close", () => end(this.said.trim()));
  }

  again(): void {
    this.moved(this.active, {});
  }

  dispose(): void {
    this.disposed = true;
    this.child.kill("SIGINT");
    this.moved(Object.fromEntries(Object.keys(this.active).map((each) => [each, null])), {});
    this.active = {};
  }

  /** Server-sent events, as HTML has them: https://html.spec.whatwg.org (section 9.2). */
  private listen(address: string): void {
    let rest = "";
    get(address, (answer) => {
      answer.setEncoding("utf8").on("data", (chunk: string) => {
        const lines = (rest + chunk).split("\n");
        rest = lines.pop() ?? "";
        lines.filter((line) => line.startsWith(EVENT)).forEach((line) => this.hear(line));
      });
      answer.on("error", () => undefined); // it has ended, which is noticed elsewhere
    }).on("error", () => undefined);
  }

  private hear(line: string): void {
    const { active, taken, entered } = JSON.parse(line.slice(EVENT.length));
    // Of the diagrams another one tells.
    if ((active || taken || entered) && !this.disposed) {
      const now = Object.entries({ ...this.active, ...active }).filter(([, states]) => states);
      this.active = Object.fromEntries(now) as Active;
      this.moved(active ?? {}, { taken, entered });
    }
  }
}
