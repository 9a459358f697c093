// Records that `swarmc test` writes, a JSON object a line.

/** A diagnostic; lines and columns count from 1. */
export interface Problem {
  readonly file: string | null;
  readonly line: number | null;
  readonly column: number | null;
  readonly end_line: number | null;
  readonly end_column: number | null;
  readonly severity: string;
  readonly code: string;
  readonly message: string;
  readonly label: string;
  readonly help: string | null;
  readonly notes: readonly string[];
}

interface Identity {
  readonly id: string;
  readonly name: string;
  readonly file: string;
  readonly line: number;
  readonly column: number;
}

export interface FileRecord {
  readonly type: "file";
  readonly file: string;
  readonly read: boolean;
  readonly problems: readonly Problem[];
}

export interface TestRecord extends Identity {
  readonly type: "test";
  readonly subject: { readonly kind: string; readonly name: string } | null;
  readonly problems: readonly Problem[];
}

export interface StartedRecord extends Identity {
  readonly type: "started";
}

export interface ResultRecord extends Identity {
  readonly type: "result";
  readonly outcome: "passed" | "failed" | "unread";
  readonly problems: readonly Problem[];
  readonly seconds?: number;
  readonly actual?: string | null;
  readonly expected?: string | null;
  readonly trace?: readonly string[];
}

/** A state or transition; without a file, it is in no text. */
export interface Element {
  readonly file: string | null;
  readonly line: number;
  readonly column: number;
  readonly end_line: number;
  readonly end_column: number;
  readonly name: string;
  readonly reached: boolean;
}

export interface CoverageRecord {
  readonly type: "coverage";
  readonly machine: string;
  readonly states: readonly Element[];
  readonly transitions: readonly Element[];
}

export interface EndRecord {
  readonly type: "end";
  readonly passed: boolean;
  readonly problems: readonly Problem[];
}

export type TestingRecord =
  | FileRecord
  | TestRecord
  | StartedRecord
  | ResultRecord
  | CoverageRecord
  | EndRecord;

/** Parts of a line that a chunk of output ends in; gives whole lines. */
export class Lines {
  private rest = "";

  /** Whole lines that end in `text`. */
  add(text: string): string[] {
    const lines = (this.rest + text).split("\n");
    this.rest = lines.pop() ?? "";
    return lines;
  }
}

/** Record of a line; undefined if it is none, such as a diagnostic of the command itself. */
export function recordOf(line: string): TestingRecord | undefined {
  try {
    const found: unknown = JSON.parse(line);
    return typeof found === "object" && found !== null && "type" in found
      ? (found as TestingRecord)
      : undefined;
  } catch {
    return undefined;
  }
}

/** Text of a diagnostic: what it says, what is special about its place, and the way out. */
export function described(problem: Problem): string {
  const { code, message, label, help, notes } = problem;
  return [
    `${message} (${code})`,
    ...(label ? [label] : []),
    ...notes.map((each) => `note: ${each}`),
    ...(help ? [`help: ${help}`] : []),
  ].join("\n");
}

/** Text of a failure: its first line is what the editor shows beside the test. */
export function failure({ problems, expected, actual, trace = [] }: ResultRecord): string {
  const [first, ...others] = problems.map(described);
  const told =
    expected && actual ? `expected ${expected}, ${actual}\n\nexpected: ${expected}\nactual: ${actual}` : first;
  const last = trace.length ? ["the last trace lines:", ...trace].join("\n") : "";
  return [told ?? "the test failed", ...others, last].filter((each) => each !== "").join("\n\n");
}
