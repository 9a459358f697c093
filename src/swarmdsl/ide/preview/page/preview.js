// Preview page, in a browser (`swarmc preview`) or in a view of an editor.
//
// Messages of the host: `{ titles: { ID: TITLE }, runs }`, `{ id, svg }` with a drawn diagram,
// `{ broken }` with the number of errors (the picture stays), `{ active }` with active states,
// `{ taken, entered }` with transitions just taken and states they entered,
// `{ redrawn: { id, svg } }` with a new picture of a diagram, for pages that show it,
// `{ cursor: { file, line } }` and `{ show: ID }`.

import { Folding } from "./folding.js";
import * as host from "./host.js";
import { Highlight } from "./highlight.js";
import { node } from "./shapes.js";
import { View } from "./view.js";

const [which, who, state, note, canvas, picture] = [
  "which",
  "who",
  "state",
  "note",
  "view",
  "picture",
].map((id) => document.getElementById(id));
const before = host.remembered();
const folding = new Folding(before.folded);
const highlight = new Highlight(who, () => update());
const view = new View(canvas, picture, click);
let titles = {};
let drawn; // { id, svg }
let shown = (!host.isInEditor && decodeURIComponent(location.hash.slice(1))) || (before.shown ?? "");
let cursor;
let wants = 0; // number of requested pictures
let touched; // node folded or unfolded last, until its picture arrives

// ---- drawing

/** A picture in the colours of the theme. */
function coloured(svg) {
  return svg.replaceAll("(prefers-color-scheme: dark)", host.isDark() ? "all" : "not all");
}

function draw() {
  // SVG from swarmc: names are escaped, and the page runs no scripts in it.
  picture.innerHTML = drawn ? coloured(drawn.svg) : "";
  mark();
  if (drawn) {
    folding.mark(picture);
    update();
  }
}

function update() {
  highlight.show(picture, shown);
}

/** Request the picture to show; an editor may answer with another one. */
function want() {
  const number = ++wants;
  void host.want(shown, folding.of(shown), (message) => {
    // A slower answer to an earlier request must not win.
    if (number === wants) {
      receive(message);
    }
  });
}

function remember() {
  host.remember({ shown, folded: folding.all });
}

function receive(message) {
  if (message.titles) {
    list(message.titles);
    highlight.learn(message.runs ?? {});
    if (!message.svg && Object.keys(titles).length) {
      want();
    }
  }
  if (message.svg) {
    receivePicture(message);
  }
  if (message.redrawn?.id === shown) {
    receivePicture(message.redrawn);
  }
  which.value = shown;
  if (message.broken !== undefined) {
    const errors = `${message.broken} error${message.broken === 1 ? "" : "s"}`;
    state.textContent = drawn ? `${errors}: showing the last valid version` : errors;
  }
  if (message.active) {
    highlight.move(message.active);
  }
  // Active states may arrive before the diagrams.
  const inhabited = highlight.arrive() ? highlight.inhabited(shown) : shown;
  if (inhabited !== shown) {
    show(inhabited);
  } else if (message.active) {
    update();
  }
  if (message.taken || message.entered) {
    highlight.flash(picture, shown, message.taken ?? {}, message.entered ?? {});
  }
  if (message.show) {
    show(message.show);
  }
  if (message.cursor) {
    cursor = message.cursor;
    mark();
  }
}

function list(all) {
  titles = all;
  which.replaceChildren(...Object.entries(titles).map(([id, title]) => new Option(title, id)));
  state.textContent = "";
  if (!Object.keys(titles).length) {
    state.textContent = "the model has nothing to draw";
    drawn = undefined;
    draw();
  }
}

function receivePicture({ id, svg }) {
  const isOther = id !== drawn?.id;
  drawn = { id, svg };
  shown = id;
  remember();
  if (isOther) {
    draw();
    view.fit();
  } else {
    view.keeping(() => touched && node(picture, touched), draw);
  }
  touched = undefined;
}

function show(id) {
  shown = id;
  remember();
  want();
}

/** Mark the node at the cursor: the last one that starts before it. */
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

// ---- user actions

function click(target) {
  const fold = target.closest(".fold");
  const place = target.closest("[data-place]")?.dataset.place;
  if (fold) {
    toggle(fold);
  } else if (place) {
    void host.reveal(place, (text) => (note.textContent = text));
  }
}

function toggle(fold) {
  touched = fold.dataset.of;
  folding.toggle(shown, touched);
  remember();
  want();
}

picture.addEventListener("keydown", (event) => {
  const fold = event.target.closest(".fold");
  if (fold && (event.key === "Enter" || event.key === " ")) {
    event.preventDefault();
    toggle(fold);
  }
});
which.addEventListener("change", () => show(which.value));
document.getElementById("fit").addEventListener("click", () => view.fit());

// ---- export

function asBlob(svg) {
  return new Blob([svg], { type: "image/svg+xml" });
}

document.getElementById("svg").addEventListener("click", () => {
  if (drawn) {
    void host.save(`${drawn.id}.svg`, asBlob(drawn.svg));
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
  const sheet = document.createElement("canvas");
  [sheet.width, sheet.height] = view.size.map((each) => each * 2); // for print
  sheet.getContext("2d").drawImage(image, 0, 0, sheet.width, sheet.height);
  URL.revokeObjectURL(image.src);
  sheet.toBlob((blob) => blob && host.save(`${id}.png`, blob));
});

// ---- messages of the host

host.listen(receive, () => (state.textContent = "swarmc preview has ended"), draw);
if (host.isInEditor) {
  want();
}
