// Follows running ROS 2 nodes through `swarmc preview`, whose page events it reads.

import { type ChildProcess, spawn } from "node:child_process";
import { get } from "node:http";
import { homedir } from "node:os";

import type { Launch } from "./launch.ts";
import type { Active, Highlights, Moved } from "./highlights.ts";

export const ADDRESS = /http:\/\/127\.0\.0\.1:\d+\//;
const EVENT = "data: ";
export const MAX_OUTPUT = 10_000; // characters of output

export class Nodes implements Highlights {
  private readonly child: ChildProcess;
  private readonly moved: Moved;
  private active: Active = {};
  private output = "";
  private disposed = false;

  /**
   * `name` selects a node or a namespace; empty, all nodes. `ended` is called with the last output
   * if swarmc ends by itself.
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
      // Python would import modules from the folder of the model.
      { cwd: homedir(), stdio: ["ignore", "pipe", "pipe"] },
    );
    let address: string | undefined;
    const collect = (chunk: string): void => {
      this.output = (this.output + chunk).slice(-MAX_OUTPUT);
      if (address === undefined && (address = ADDRESS.exec(this.output)?.[0]) !== undefined) {
        this.listen(`${address}events`);
      }
    };
    this.child.stdout?.setEncoding("utf8").on("data", collect);
    this.child.stderr?.setEncoding("utf8").on("data", collect);
    const end = (why: string): void => {
      if (!this.disposed) {
        this.dispose();
        ended(why);
      }
    };
    this.child.on("error", (error) => end(error.message));
    this.child.on("close", () => end(this.output.trim()));
  }

  resend(): void {
    this.moved(this.active, {});
  }

  dispose(): void {
    this.disposed = true;
    this.child.kill("SIGINT");
    this.moved(Object.fromEntries(Object.keys(this.active).map((each) => [each, null])), {});
    this.active = {};
  }

  /** Read server-sent events. Source: https://html.spec.whatwg.org (section 9.2). */
  private listen(address: string): void {
    let rest = "";
    get(address, (answer) => {
      answer.setEncoding("utf8").on("data", (chunk: string) => {
        const lines = (rest + chunk).split("\n");
        rest = lines.pop() ?? "";
        lines.filter((line) => line.startsWith(EVENT)).forEach((line) => this.receive(line));
      });
      answer.on("error", () => undefined); // the end is handled by the process events
    }).on("error", () => undefined);
  }

  private receive(line: string): void {
    const { active, taken, entered } = JSON.parse(line.slice(EVENT.length));
    // Diagrams come from the language server.
    if ((active || taken || entered) && !this.disposed) {
      const now = Object.entries({ ...this.active, ...active }).filter(([, states]) => states);
      this.active = Object.fromEntries(now) as Active;
      this.moved(active ?? {}, { taken, entered });
    }
  }
}
