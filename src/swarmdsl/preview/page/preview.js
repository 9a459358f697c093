// Shows the pictures of a model, in a browser beside `swarmc preview` or in a view of an editor.
//
// From outside come `{ titles: { ID: TITLE } }`, `{ id, svg }` with one of them drawn, `{ broken }`
// with a number while the text has mistakes (the picture stays), and `{ cursor: { file, line } }`.
// An editor is told `{ want: ID }`, `{ reveal: "FILE:LINE:COLUMN" }` and `{ save: { name, base64 } }`;
// a browser asks swarmc.
"use strict";

const editor = typeof acquireVsCodeApi === "function" ? acquireVsCodeApi() : undefined;
const [which, state, view, picture] = ["which", "state", "view", "picture"].map((id) =>
  document.getElementById(id),
);
const DARK = window.matchMedia("(prefers-color-scheme: dark)");
let titles = {};
let drawn; // { id, svg }
let shown = editor?.getState()?.shown ?? decodeURIComponent(location.hash.slice(1));
let cursor;
let scale = 1;
let left = 0;
let top_ = 0;

// ---- what is shown

function isDark() {
  const theme = document.body.classList;
  return editor ? theme.contains("vscode-dark") || theme.contains("vscode-high-contrast") : DARK.matches;
}

/** A picture in the colours of the page: an editor has others than the system. */
function coloured(svg) {
  return svg.replaceAll("(prefers-color-scheme: dark)", isDark() ? "all" : "not all");
}

function draw() {
  // The text is that of swarmc, in which names are escaped, and the page runs no script in it.
  picture.innerHTML = drawn ? coloured(drawn.svg) : "";
  mark();
}

/** Ask for the picture that is to be shown; what it may be instead is said by who draws it. */
async function want() {
  if (editor) {
    editor.postMessage({ want: shown });
  } else {
    const answer = await fetch(`picture?${encodeURIComponent(shown)}`);
    receive(await answer.json());
  }
}

function remember(id) {
  shown = id;
  if (editor) {
    editor.setState({ shown });
  } else {
    history.replaceState(undefined, "", `#${encodeURIComponent(id)}`);
  }
}

function receive(message) {
  if (message.titles) {
    titles = message.titles;
    which.replaceChildren(...Object.entries(titles).map(([id, title]) => new Option(title, id)));
    state.textContent = "";
    if (!Object.keys(titles).length) {
      state.textContent = "the model has nothing to draw";
      drawn = undefined;
      draw();
    } else if (!message.svg) {
      void want();
    }
  }
  if (message.svg) {
    const other = message.id !== drawn?.id;
    drawn = { id: message.id, svg: message.svg };
    remember(drawn.id);
    draw();
    if (other) {
      fit();
    }
  }
  which.value = shown;
  if (message.broken !== undefined) {
    const mistakes = `${message.broken} mistake${message.broken === 1 ? "" : "s"}`;
    state.textContent = drawn ? `${mistakes}: this is how it was before` : mistakes;
  }
  if (message.cursor) {
    cursor = message.cursor;
    mark();
  }
}

/** Mark what stands at the cursor: what begins last in front of it. */
function mark() {
  let best;
  let line = 0;
  for (const each of picture.querySelectorAll("[data-place]")) {
    each.classList.remove("marked");
    const place = parsed(each.dataset.place);
    if (cursor && place?.file === cursor.file && place.line <= cursor.line && place.line >= line) {
      best = each;
      line = place.line;
    }
  }
  best?.classList.add("marked");
}

function parsed(place) {
  const found = /^(.*):(\d+):(\d+)$/.exec(place);
  return found && { file: found[1], line: Number(found[2]), column: Number(found[3]) };
}

// ---- where it is shown

function move() {
  picture.style.transform = `translate(${left}px, ${top_}px) scale(${scale})`;
}

function size() {
  const svg = picture.querySelector("svg");
  return svg ? [Number(svg.getAttribute("width")), Number(svg.getAttribute("height"))] : [1, 1];
}

function fit() {
  const [width, height] = size();
  scale = Math.min(1.5, view.clientWidth / width, view.clientHeight / height);
  left = (view.clientWidth - width * scale) / 2;
  top_ = (view.clientHeight - height * scale) / 2;
  move();
}

function zoom(factor, x, y) {
  const next = Math.min(8, Math.max(0.05, scale * factor));
  left = x - ((x - left) * next) / scale;
  top_ = y - ((y - top_) * next) / scale;
  scale = next;
  move();
}

view.addEventListener(
  "wheel",
  (event) => {
    event.preventDefault();
    const { left: x, top: y } = view.getBoundingClientRect();
    zoom(Math.exp(-event.deltaY / 400), event.clientX - x, event.clientY - y);
  },
  { passive: false },
);

let grabbed;
view.addEventListener("pointerdown", (event) => {
  grabbed = { x: event.clientX - left, y: event.clientY - top_, from: [event.clientX, event.clientY] };
});
window.addEventListener("pointermove", (event) => {
  if (grabbed) {
    view.classList.add("moving");
    left = event.clientX - grabbed.x;
    top_ = event.clientY - grabbed.y;
    move();
  }
});
window.addEventListener("pointerup", (event) => {
  const moved = grabbed && Math.hypot(event.clientX - grabbed.from[0], event.clientY - grabbed.from[1]);
  const on = event.target instanceof Element ? event.target.closest("[data-place]") : null;
  grabbed = undefined;
  view.classList.remove("moving");
  if (moved !== undefined && moved < 4 && on) {
    reveal(on.dataset.place);
  }
});
view.addEventListener("keydown", ({ key }) => {
  const middle = [view.clientWidth / 2, view.clientHeight / 2];
  if (key === "0") fit();
  if (key === "+" || key === "=") zoom(1.25, ...middle);
  if (key === "-") zoom(0.8, ...middle);
});

/** Lead to a place in the text: in the editor, or in VS Code if it is installed. */
function reveal(place) {
  if (editor) {
    editor.postMessage({ reveal: place });
  } else {
    state.textContent = place;
    location.href = `vscode://file${encodeURI(place)}`;
  }
}

// ---- files of it

async function save(name, blob) {
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

function asBlob(svg) {
  return new Blob([svg], { type: "image/svg+xml" });
}

document.getElementById("svg").addEventListener("click", () => {
  if (drawn) {
    void save(`${drawn.id}.svg`, asBlob(drawn.svg));
  }
});

document.getElementById("png").addEventListener("click", async () => {
  if (!drawn) {
    return;
  }
  const { id, svg } = drawn;
  const image = new Image();
  image.src = URL.createObjectURL(asBlob(coloured(svg)));
  await image.decode();
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = size().map((each) => each * 2); // for screens and for print
  canvas.getContext("2d").drawImage(image, 0, 0, canvas.width, canvas.height);
  URL.revokeObjectURL(image.src);
  canvas.toBlob((blob) => blob && save(`${id}.png`, blob));
});

// ---- from outside

which.addEventListener("change", () => {
  remember(which.value);
  void want();
});
document.getElementById("fit").addEventListener("click", fit);
if (editor) {
  window.addEventListener("message", ({ data }) => receive(data));
  new MutationObserver(draw).observe(document.body, { attributeFilter: ["class"] });
  void want();
} else {
  const events = new EventSource("events");
  events.addEventListener("message", ({ data }) => receive(JSON.parse(data)));
  events.addEventListener("error", () => {
    state.textContent = "swarmc preview has ended";
  });
  DARK.addEventListener("change", draw);
}
