// Shows the pictures of a model, in a browser beside `swarmc preview` or in a view of an editor.
//
// From outside come `{ titles: { ID: TITLE }, runs }`, `{ id, svg }` with one of them drawn,
// `{ broken }` with a number while the text has mistakes (the picture stays), `{ active }` with the
// states in which robots are, `{ taken, entered }` with transitions that they have just taken and
// states that they have entered with that, `{ cursor: { file, line } }`, and `{ show: ID }`.

import { Folding } from "./folding.js";
import * as host from "./host.js";
import { Lights } from "./lights.js";
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
const lights = new Lights(who, () => light());
const view = new View(canvas, picture, click);
let titles = {};
let drawn; // { id, svg }
let shown = (!host.isInEditor && decodeURIComponent(location.hash.slice(1))) || (before.shown ?? "");
let cursor;
let wants = 0; // how often a picture was asked for
let touched; // the node that was folded or unfolded, until there is a picture of it

// ---- what is shown

/** A picture in the colours of the page. */
function coloured(svg) {
  return svg.replaceAll("(prefers-color-scheme: dark)", host.isDark() ? "all" : "not all");
}

function draw() {
  // The text is that of swarmc, in which names are escaped, and the page runs no script in it.
  picture.innerHTML = drawn ? coloured(drawn.svg) : "";
  mark();
  if (drawn) {
    folding.mark(picture);
    light();
  }
}

function light() {
  lights.show(picture, shown);
}

/** Ask for the picture that is to be shown; what it may be instead is said by who draws it. */
function want() {
  const number = ++wants;
  void host.want(shown, folding.of(shown), (message) => {
    // The answer to an earlier one may take longer.
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
    lights.learn(message.runs ?? {});
    if (!message.svg && Object.keys(titles).length) {
      want();
    }
  }
  if (message.svg) {
    receivePicture(message);
  }
  which.value = shown;
  if (message.broken !== undefined) {
    const mistakes = `${message.broken} mistake${message.broken === 1 ? "" : "s"}`;
    state.textContent = drawn ? `${mistakes}: this is how it was before` : mistakes;
  }
  if (message.active) {
    lights.move(message.active);
  }
  // Where members are may be told before the diagrams are.
  const inhabited = lights.arrive() ? lights.inhabited(shown) : shown;
  if (inhabited !== shown) {
    show(inhabited);
  } else if (message.active) {
    light();
  }
  if (message.taken || message.entered) {
    lights.flash(picture, shown, message.taken ?? {}, message.entered ?? {});
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

// ---- what the user does

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

// ---- files of it

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
  [sheet.width, sheet.height] = view.size.map((each) => each * 2); // for screens and for print
  sheet.getContext("2d").drawImage(image, 0, 0, sheet.width, sheet.height);
  URL.revokeObjectURL(image.src);
  sheet.toBlob((blob) => blob && host.save(`${id}.png`, blob));
});

// ---- from outside

host.listen(receive, () => (state.textContent = "swarmc preview has ended"), draw);
if (host.isInEditor) {
  want();
}
