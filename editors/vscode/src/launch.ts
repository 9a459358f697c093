// Search for swarmc: all locations in order of preference.

/** Command line of swarmc, up to the subcommand. */
export interface Launch {
  readonly command: string;
  readonly args: readonly string[];
  /** Origin as part of a sentence: "the setting ...". */
  readonly origin: string;
  /** True for the copy in the extension, which only serves editors. */
  readonly bundled: boolean;
}

/** Properties of a Python interpreter. */
export interface Python {
  readonly version: readonly [number, number];
  readonly hasServer: boolean;
}

/** Runs programs to inspect them; undefined if they fail. */
export interface Probe {
  python(interpreter: string): Promise<Python | undefined>;
  /** True if a program is a swarmc with a language server. */
  swarmc(program: string): Promise<boolean>;
}

export interface Places {
  /** Settings; empty if not set. */
  readonly path: string;
  readonly interpreter: string;
  /** Interpreter selected in the Python extension. */
  readonly selected: string | undefined;
  /** Existing interpreters in `.venv` of the open folders. */
  readonly environments: readonly string[];
  /** Existing programs on the PATH. */
  readonly swarmc: readonly string[];
  readonly pythons: readonly string[];
  /** Folder of the bundled server. */
  readonly bundle: string;
}

export type Found =
  | { readonly launch: Launch }
  /** Reason that nothing can be started, and the setting that causes it. */
  | { readonly missing: string; readonly setting?: string };

export const OLDEST = [3, 10] as const;
export const PATH_SETTING = "swarmdsl.server.path";
export const INTERPRETER_SETTING = "swarmdsl.server.interpreter";

/** Find the swarmc to use. An invalid setting is reported, never skipped. */
export async function find(
  places: Places,
  probe: Probe,
  log: (line: string) => void,
): Promise<Found> {
  if (places.path) {
    return (await probe.swarmc(places.path))
      ? { launch: installed(places.path, [], `the setting ${PATH_SETTING}`) }
      : {
          missing: `${places.path} is not a swarmc with a language server.`,
          setting: PATH_SETTING,
        };
  }
  const interpreters: [string, string][] = places.interpreter
    ? [[places.interpreter, `the setting ${INTERPRETER_SETTING}`]]
    : [
        ...(places.selected ? [place(places.selected, "the selected interpreter")] : []),
        ...places.environments.map((each) => place(each, "the environment of the workspace")),
      ];
  const usable: [string, string][] = [];
  for (const [interpreter, origin] of interpreters) {
    const python = await probe.python(interpreter);
    log(`${interpreter}, ${origin}: ${described(python)}`);
    if (python?.hasServer && isRecent(python)) {
      return { launch: installed(interpreter, ["-m", "swarmdsl"], origin) };
    }
    if (python && isRecent(python)) {
      usable.push([interpreter, origin]);
    }
  }
  if (places.interpreter) {
    const [only] = usable;
    return only
      ? { launch: bundled(places.bundle, ...only) }
      : {
          missing: `${places.interpreter} is not Python ${OLDEST.join(".")} or later.`,
          setting: INTERPRETER_SETTING,
        };
  }
  for (const program of places.swarmc) {
    const serves = await probe.swarmc(program);
    log(`${program}, on the PATH: ${serves ? "serves editors" : "does not serve editors"}`);
    if (serves) {
      return { launch: installed(program, [], "the PATH") };
    }
  }
  for (const interpreter of places.pythons) {
    const python = await probe.python(interpreter);
    log(`${interpreter}, on the PATH: ${described(python)}`);
    if (python?.hasServer && isRecent(python)) {
      return { launch: installed(interpreter, ["-m", "swarmdsl"], "the PATH") };
    }
    if (python && isRecent(python)) {
      usable.push([interpreter, "the PATH"]);
    }
  }
  const [first] = usable;
  return first
    ? { launch: bundled(places.bundle, ...first) }
    : { missing: `No swarmc found, and no Python ${OLDEST.join(".")} or later to run the bundled one.` };
}

function place(interpreter: string, origin: string): [string, string] {
  return [interpreter, origin];
}

function installed(command: string, args: readonly string[], origin: string): Launch {
  return { command, args, origin, bundled: false };
}

// Isolated mode: PYTHONPATH and user site packages have no effect.
function bundled(bundle: string, interpreter: string, origin: string): Launch {
  const whole = `the extension, run by the Python of ${origin}`;
  return { command: interpreter, args: ["-I", bundle], origin: whole, bundled: true };
}

export function isRecent({ version: [major, minor] }: Python): boolean {
  return major > OLDEST[0] || (major === OLDEST[0] && minor >= OLDEST[1]);
}

function described(python: Python | undefined): string {
  if (!python) {
    return "does not run";
  }
  return `Python ${python.version.join(".")}, ${python.hasServer ? "with" : "without"} swarmdsl`;
}
