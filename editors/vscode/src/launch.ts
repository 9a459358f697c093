// Which swarmc is used: the places where one may be, in the order in which they are tried.

/** How a swarmc is started: a program, and its arguments before the name of a command. */
export interface Launch {
  readonly command: string;
  readonly args: readonly string[];
  /** Where it was found, in the words of a sentence: "the setting ...". */
  readonly origin: string;
  /** Whether it is the copy that comes with the extension, which serves editors and no more. */
  readonly bundled: boolean;
}

/** What an interpreter of Python says of itself. */
export interface Python {
  readonly version: readonly [number, number];
  readonly hasServer: boolean;
}

/** Runs programs to learn what they are; undefined for what does not run. */
export interface Probe {
  python(interpreter: string): Promise<Python | undefined>;
  /** Whether a program is a swarmc that can serve editors. */
  swarmc(program: string): Promise<boolean>;
}

export interface Places {
  /** The settings; empty where the user has set nothing. */
  readonly path: string;
  readonly interpreter: string;
  /** The interpreter that is selected in the Python extension. */
  readonly selected: string | undefined;
  /** The interpreters in `.venv` of the folders that are open, as far as they exist. */
  readonly environments: readonly string[];
  /** The programs that stand on the PATH, as far as they are there. */
  readonly swarmc: readonly string[];
  readonly pythons: readonly string[];
  /** The folder of the server that comes with the extension. */
  readonly bundle: string;
}

export type Found =
  | { readonly launch: Launch }
  /** Why nothing can be started, and whether it is due to a setting. */
  | { readonly missing: string; readonly setting?: string };

const OLDEST = [3, 10] as const;
export const PATH_SETTING = "swarmdsl.server.path";
export const INTERPRETER_SETTING = "swarmdsl.server.interpreter";

/** Find the swarmc to use. What a setting names is used or reported, never passed over. */
export async function find(
  places: Places,
  probe: Probe,
  log: (line: string) => void,
): Promise<Found> {
  if (places.path) {
    return (await probe.swarmc(places.path))
      ? { launch: installed(places.path, [], `the setting ${PATH_SETTING}`) }
      : {
          missing: `${places.path} is not a swarmc that serves editors.`,
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
    if (python?.hasServer && recent(python)) {
      return { launch: installed(interpreter, ["-m", "swarmdsl"], origin) };
    }
    if (python && recent(python)) {
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
    if (python?.hasServer && recent(python)) {
      return { launch: installed(interpreter, ["-m", "swarmdsl"], "the PATH") };
    }
    if (python && recent(python)) {
      usable.push([interpreter, "the PATH"]);
    }
  }
  const [first] = usable;
  return first
    ? { launch: bundled(places.bundle, ...first) }
    : { missing: `There is no swarmc, and no Python ${OLDEST.join(".")} or later to run one.` };
}

function place(interpreter: string, origin: string): [string, string] {
  return [interpreter, origin];
}

function installed(command: string, args: readonly string[], origin: string): Launch {
  return { command, args, origin, bundled: false };
}

// Isolated: neither PYTHONPATH nor packages of the user change what it imports.
function bundled(bundle: string, interpreter: string, origin: string): Launch {
  const whole = `the extension, run by the Python of ${origin}`;
  return { command: interpreter, args: ["-I", bundle], origin: whole, bundled: true };
}

function recent({ version: [major, minor] }: Python): boolean {
  return major > OLDEST[0] || (major === OLDEST[0] && minor >= OLDEST[1]);
}

function described(python: Python | undefined): string {
  if (!python) {
    return "does not run";
  }
  return `Python ${python.version.join(".")}, ${python.hasServer ? "with" : "without"} swarmdsl`;
}
