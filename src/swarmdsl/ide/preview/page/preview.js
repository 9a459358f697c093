// Preview page, in a browser (`swarmc preview`) or in a view of an editor.
//
// Messages of the host: `{ titles: { ID: TITLE }, runs }`, `{ id, svg, names, foldable }` with a drawn
// diagram, `{ broken }` with the number of errors (the picture stays), `{ active }` with active states,
// `{ taken, entered }` with transitions just taken and states they entered,
// `{ redrawn: { id, svg } }` with a new picture of a diagram, for pages that show it,
// `{ breakpoints: { ID: [ELEMENT, ...] } }`,
// `{ debug }` with the controls of a simulation that the user drives or null for none; a browser starts
// one of what `{ subjects: { NAME: ID }, scenarios }` offer with the titles. `{ cursor: [{ diagram, element }], moved }`, `{ show: ID }`, and
// `{ unavailable: { text, actions: [{ title, command }] } }` if there are no diagrams.

import { Breakpoints } from "./breakpoints.js";
import { Cursor } from "./cursor.js";
import { Debugging } from "./debugging.js";
import { saveButtons } from "./export.js";
import { Folding } from "./folding.js";
import { Highlight } from "./highlight.js";
import * as host from "./host.js";
import { focused, makeReachable, neighbour } from "./keys.js";
import { Search } from "./search.js";
import { visible } from "./shapes.js";
import { Status } from "./status.js";
import { View } from "./view.js";

const element = (id) => document.getElementById(id);
const [which, canvas, picture] = ["which", "view", "picture"].map(element);
const before = host.remembered();
const folding = new Folding(before.folded);
const highlight = new Highlight(element("who"), () => update());
const view = new View(canvas, picture, click);
const cursor = new Cursor();
const status = new Status(element("state"), element("note"), element("explanation"));
const debugging = new Debugging(element("debug"), (command) => void host.debug(command, (why) => debugging.fail(why)), () => shown);
const breakpoints = new Breakpoints(element("menu"), (command) => void host.debug(command, (why) => debugging.fail(why)), open);
const search = new Search(element("find"), element("names"), find, () => canvas.focus());
let titles = {};
let drawn; // { id, svg, names, foldable }
// Diagram to show; while the model has errors, another one may be drawn.
let shown = (!host.isInEditor && decodeURIComponent(location.hash.slice(1))) || (before.shown ?? "");
let wants = 0; // number of requested pictures
let touched; // node folded or unfolded last, until its picture arrives
let sought; // element to show when its picture arrives
let isNew = false; // no element of the diagram has been shown

// ---- drawing

function draw() {
  const focus = document.hasFocus() ? focused(picture)?.dataset.id : undefined;
  // SVG from swarmc: names are escaped, and the page runs no scripts in it.
  picture.innerHTML = drawn ? host.coloured(drawn.svg) : "";
  makeReachable(picture);
  cursor.mark(picture, drawn?.id);
  search.learn(drawn?.names ?? {});
  element("folding").hidden = !drawn?.foldable?.length;
  if (drawn) {
    folding.mark(picture);
    update();
  }
  if (focus !== undefined) {
    visible(picture, focus)?.focus({ preventScroll: true });
  }
}

function update() {
  highlight.show(picture, drawn?.id);
  breakpoints.mark(picture, drawn?.id);
}

/** Request the picture to show; an editor may answer with another one. */
function want() {
  const number = ++wants;
  const answer = (message) => {
    // A slower answer to an earlier request must not win.
    if (number === wants) {
      receive(message);
    }
  };
  host.want(shown, folding.of(shown), answer).catch(() => status.end());
}

function remember() {
  host.remember({ shown, folded: folding.all });
}

function receive(message) {
  if (message.titles) {
    list(message.titles);
    highlight.learn(message.runs ?? {});
    if (message.subjects) {
      debugging.offer(message.subjects, message.scenarios ?? []);
    }
    if (!message.svg && Object.keys(titles).length) {
      want();
    }
  }
  if (message.svg) {
    receivePicture(message);
  }
  if (message.redrawn?.id === shown) {
    receivePicture({ ...drawn, ...message.redrawn });
  }
  which.value = drawn?.id ?? shown;
  if (message.broken !== undefined) {
    status.tellErrors(message.broken, drawn !== undefined);
  }
  if (message.unavailable) {
    status.explain(message.unavailable, drawn !== undefined, host.run);
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
    highlight.flash(picture, drawn?.id, message.taken ?? {}, message.entered ?? {});
  }
  if (message.breakpoints) {
    breakpoints.learn(message.breakpoints);
    update();
  }
  if (message.debug !== undefined) {
    debugging.show(message.debug);
  }
  if (message.show) {
    show(message.show);
  }
  if (message.cursor) {
    follow(message);
  }
}

function list(all) {
  titles = all;
  which.replaceChildren(...Object.entries(titles).map(([id, title]) => new Option(title, id)));
  status.clear();
  if (!Object.keys(titles).length) {
    status.explain({ text: "The model has nothing to draw." }, false);
    drawn = undefined;
    draw();
  }
}

function receivePicture({ id, svg, names, foldable }) {
  const isOther = id !== drawn?.id;
  drawn = { id, svg, names, foldable };
  shown = id;
  debugging.follow();
  remember();
  const stays = touched ?? cursor.in(shown);
  if (isOther) {
    draw();
    view.fit();
    const marked = cursor.mark(picture, drawn?.id);
    if (marked) {
      view.approach(marked);
    }
    isNew = !marked;
  } else {
    view.keeping(() => stays && visible(picture, stays), draw);
  }
  touched = undefined;
  if (sought !== undefined) {
    visit(sought);
  }
}

function show(id) {
  shown = id;
  remember();
  want();
}

/** Mark the element at the cursor, and show it in its diagram. */
function follow({ cursor: elements, moved }) {
  const before = cursor.in(drawn?.id);
  const next = cursor.move(elements, moved, shown, titles);
  if (next !== shown) {
    show(next);
    return;
  }
  const marked = cursor.mark(picture, drawn?.id);
  if (marked && before !== cursor.in(drawn?.id)) {
    if (isNew) {
      view.approach(marked);
    } else {
      view.reveal(marked);
    }
    isNew = false;
  }
}

/** The server has gone: what it told of a run is over; it tells all again when it is back. */
function ended() {
  status.end();
  debugging.show(null);
  highlight.forget();
  update();
}

// ---- user actions

function click(target) {
  const fold = target.closest(".fold");
  const place = target.closest("[data-place]")?.dataset.place;
  if (fold) {
    toggle(fold.dataset.of);
  } else if (place) {
    open(place);
  }
}

function open(place) {
  void host.reveal(place, (text) => status.note(text));
}

function toggle(id) {
  touched = id;
  folding.toggle(shown, id);
  remember();
  want();
}

function foldAll(ids) {
  touched = undefined;
  folding.fold(shown, ids);
  remember();
  want();
}

/** Unfold what hides an element, and show it. */
function reach(id) {
  status.note(id ? "" : "the cursor is at no element of this diagram");
  sought = id;
  if (folding.unfoldPath(shown, id)) {
    remember();
    want();
  } else {
    visit(id);
  }
}

function visit(id) {
  sought = undefined;
  const found = visible(picture, id);
  if (found) {
    view.approach(found);
    for (const each of picture.querySelectorAll(".found")) {
      each.classList.remove("found");
    }
    found.classList.add("found");
  }
}

function find(id, number, count) {
  if (id !== undefined) {
    reach(id);
  }
  status.note(id === undefined ? "no such name here" : `${number} of ${count}`);
}

picture.addEventListener("keydown", (event) => {
  const [fold, at] = [event.target.closest(".fold"), focused(picture)];
  if (event.key === "Enter" && at?.dataset.place) {
    open(at.dataset.place);
  } else if ([" ", "Enter"].includes(event.key) && (fold || at?.dataset.fold)) {
    toggle(fold?.dataset.of ?? at.dataset.id);
  } else {
    return;
  }
  event.preventDefault();
});
canvas.addEventListener("keydown", (event) => {
  const from = focused(picture) ?? picture.querySelector(".node.marked, .node.lit");
  const next = event.shiftKey ? undefined : neighbour(picture, from, event.key);
  if (next) {
    event.preventDefault();
    next.focus({ preventScroll: true });
  }
});
picture.addEventListener("focusin", ({ target }) => {
  // Not on a click, which would move what the pointer is on.
  if (target.matches(".node:focus-visible, .fold:focus-visible")) {
    view.reveal(target);
  }
});
if (!host.isInEditor) { // an editor has breakpoints of its own
  picture.addEventListener("contextmenu", (event) => breakpoints.offer(event, picture, drawn?.id));
  canvas.addEventListener("keydown", (event) => {
    if (event.key === "F9" && breakpoints.toggle(focused(picture), drawn?.id)) {
      event.preventDefault();
    }
  });
}
which.addEventListener("change", () => show(which.value));
for (const [id, act] of Object.entries({
  "zoom-out": () => view.zoom(0.8),
  "zoom-in": () => view.zoom(1.25),
  fit: () => view.fit(),
  "fold-all": () => foldAll(drawn.foldable),
  "unfold-all": () => foldAll([]),
  "unfold-path": () => reach(cursor.in(shown) ?? ""),
})) {
  element(id).addEventListener("click", act);
}
element("unfold-path").hidden = !host.isInEditor; // only an editor has a cursor
saveButtons(
  () => drawn,
  () => view.size,
);

// ---- messages of the host

host.listen(receive, ended, draw);
if (host.isInEditor) {
  want();
}
