// Connection to the host: an editor that embeds the page, or swarmc over HTTP. An editor receives
// `{ want: { id, folded } }`, `{ reveal: "FILE:LINE:COLUMN" }`, `{ save: { name, base64 } }` and
// `{ run: COMMAND }` and `{ debug }` with a wish for the simulation, see `Debugging`.

const editor = typeof acquireVsCodeApi === "function" ? acquireVsCodeApi() : undefined;
const DARK = window.matchMedia("(prefers-color-scheme: dark)");
const KEY = "swarm-preview";

export const isInEditor = editor !== undefined;

/** True if the page is dark; an editor has its own theme. */
function isDark() {
  if (!editor) {
    return DARK.matches;
  }
  // Light themes of high contrast have the class of all of high contrast, too.
  const theme = document.body.classList;
  const isContrast = theme.contains("vscode-high-contrast") && !theme.contains("vscode-high-contrast-light");
  return theme.contains("vscode-dark") || isContrast;
}

/** A picture in the colours of the theme. */
export function coloured(svg) {
  return svg.replaceAll("(prefers-color-scheme: dark)", isDark() ? "all" : "not all");
}

/** State stored for the lifetime of the view or tab. */
export function remembered() {
  return editor?.getState() ?? JSON.parse(sessionStorage.getItem(KEY) ?? "{}");
}

export function remember(state) {
  if (editor) {
    editor.setState(state);
  } else {
    sessionStorage.setItem(KEY, JSON.stringify(state));
    history.replaceState(undefined, "", `#${encodeURIComponent(state.shown)}`);
  }
}

/** Request a diagram with folded nodes; an editor sends it later. */
export async function want(id, folded, receive) {
  if (editor) {
    editor.postMessage({ want: { id, folded } });
    return;
  }
  const query = new URLSearchParams([["id", id], ...folded.map((each) => ["fold", each])]);
  receive(await (await fetch(`picture?${query}`)).json());
}

/** Open a place in the text. */
export async function reveal(place, say) {
  if (editor) {
    editor.postMessage({ reveal: place });
    return;
  }
  const { address, failed, none } = await post("open", place);
  if (none) {
    const copied = await navigator.clipboard?.writeText(place).then(() => true, () => false);
    say(copied ? `${place}, copied` : place);
  } else {
    say(failed ? `${place}: ${failed}` : place);
  }
  if (address) {
    location.href = address;
  }
}

async function post(path, value) {
  const headers = { "Content-Type": "application/json" };
  return await (await fetch(path, { method: "POST", headers, body: JSON.stringify(value) })).json();
}

/** Run a command of the editor that it has offered. */
export function run(command) {
  editor?.postMessage({ run: command });
}

/** Ask something of the simulation that the user drives; an editor tells itself what failed. */
export async function debug(command, failed) {
  if (editor) {
    editor.postMessage({ debug: command });
    return;
  }
  try {
    const answer = await post("simulate", command);
    if (answer.failed) {
      failed(answer.failed);
    }
  } catch {
    failed("swarmc preview does not answer");
  }
}

/** Save a file where the user chooses. */
export async function save(name, blob) {
  if (editor) {
    const bytes = new Uint8Array(await blob.arrayBuffer());
    const base64 = btoa(Array.from(bytes, (each) => String.fromCharCode(each)).join(""));
    editor.postMessage({ save: { name, base64 } });
    return;
  }
  const link = document.createElement("a");
  link.download = name;
  link.href = URL.createObjectURL(blob);
  link.click();
  URL.revokeObjectURL(link.href);
}

/** Listen for messages, for the end of the connection and for changes of the theme. */
export function listen(receive, ended, recoloured) {
  if (editor) {
    window.addEventListener("message", ({ data }) => receive(data));
    new MutationObserver(recoloured).observe(document.body, { attributeFilter: ["class"] });
  } else {
    const events = new EventSource("events");
    events.addEventListener("message", ({ data }) => receive(JSON.parse(data)));
    events.addEventListener("error", ended);
    DARK.addEventListener("change", recoloured);
  }
}
