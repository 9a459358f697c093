// Where robots are: the states that are active light up, and for a moment the transitions taken.

import { made, sides } from "./shapes.js";

const EVERYONE = "*";
const NOBODY = "-";
const MOST_NAMED = 12;
const MOMENT = 1500; // milliseconds
const INITIAL = "#initial->"; // how the ids of arrows to what is entered first end

export class Lights {
  #who; // the list of members
  #runs = {}; // by diagrams: [[ROLE, PREFIX OF ITS STATES], ...]
  #roles = new Set();
  #active = new Map(); // by members: their innermost active states
  #isDeserted = true;
  #timers = new WeakMap(); // by transitions that are lit

  /** `changed` is called when the user has chosen somebody else. */
  constructor(who, changed) {
    this.#who = who;
    who.addEventListener("change", changed);
  }

  /** Learn who runs which state machine. */
  learn(runs) {
    this.#runs = runs;
    this.#roles = new Set(Object.values(runs).flatMap((each) => each.map(([role]) => role)));
  }

  /** Move members. */
  move(active) {
    for (const [member, states] of Object.entries(active)) {
      if (states) {
        this.#active.set(member, states);
      } else {
        this.#active.delete(member);
      }
    }
    this.#isDeserted ||= !this.#active.size;
  }

  /** Whether members are there for the first time since there were none, and what they run is known. */
  arrive() {
    const isFirst = this.#isDeserted && this.#active.size > 0 && Object.keys(this.#runs).length > 0;
    this.#isDeserted &&= !isFirst;
    return isFirst;
  }

  /** A diagram in which somebody is; `diagram` itself if there is one in it. */
  inhabited(diagram) {
    const members = [...this.#active.keys()];
    const isIn = (id) => members.some((each) => this.#prefixes(id, each).length);
    return isIn(diagram) ? diagram : (Object.keys(this.#runs).find(isIn) ?? diagram);
  }

  /** Light up the states of the diagram in a picture. */
  show(picture, diagram) {
    for (const each of picture.querySelectorAll(".lit, .around")) {
      each.classList.remove("lit", "around");
    }
    picture.querySelector(".counts")?.remove();
    const nodes = new Map(
      Array.from(picture.querySelectorAll(".node"), (each) => [each.dataset.id, each]),
    );
    const crew = [...this.#active.keys()].filter((each) => this.#prefixes(diagram, each).length);
    const chosen = this.#offer(crew);
    const found = new Map(); // by nodes: who is there
    for (const member of crew.filter((each) => chosen === EVERYONE || chosen === each)) {
      for (const id of this.#places(diagram, member, nodes)) {
        found.set(id, (found.get(id) ?? new Set()).add(member));
      }
    }
    for (const id of found.keys()) {
      nodes.get(id).classList.add("lit");
      for (let outer = above(id); outer; outer = above(outer)) {
        nodes.get(outer)?.classList.add("around");
      }
    }
    if (chosen === EVERYONE && crew.length > 1) {
      const counts = Array.from(found, ([id, members]) => count(nodes.get(id), [...members]));
      picture.querySelector("svg")?.append(made("g", { class: "counts" }, ...counts));
    }
  }

  /**
   * Light up for a moment the transitions that members have just taken, by their ids, and the
   * arrows to what they have `entered` first in a state or a machine.
   */
  flash(picture, diagram, taken, entered) {
    const edges = new Map(
      Array.from(picture.querySelectorAll(".edge"), (each) => [each.dataset.id, each]),
    );
    const lines = Array.from(picture.querySelectorAll("text[data-id]")); // in the boxes of states
    const chosen = this.#who.value;
    for (const member of new Set([...Object.keys(taken), ...Object.keys(entered)])) {
      const prefixes = [EVERYONE, member].includes(chosen) ? this.#prefixes(diagram, member) : [];
      for (const prefix of prefixes) {
        const ids = here(taken[member] ?? [], prefix);
        const states = here(entered[member] ?? [], prefix);
        [
          ...ids.flatMap((id) => edges.get(id) ?? []),
          ...lines.filter((each) => ids.includes(each.dataset.id)),
          ...Array.from(edges.values()).filter((each) => begins(each, states, ids, edges)),
        ].forEach((each) => this.#flash(each));
      }
    }
  }

  #flash(edge) {
    edge.classList.add("taken");
    clearTimeout(this.#timers.get(edge));
    this.#timers.set(edge, setTimeout(() => edge.classList.remove("taken"), MOMENT));
  }

  /** What the ids of a member's states begin with where they are in a diagram. */
  #prefixes(diagram, member) {
    const role = member.replace(/\[\d+\]| \(.*\)$/, ""); // dog[1], Guarding (dog.jsonl)
    if (this.#roles.has(role)) {
      return (this.#runs[diagram] ?? []).filter(([each]) => each === role).map((each) => each[1]);
    }
    return this.#runs[diagram] ? [""] : []; // of somebody else nothing is known but the states
  }

  /** The nodes in which a member is; where a state is not drawn, what is drawn around it. */
  *#places(diagram, member, nodes) {
    for (const prefix of this.#prefixes(diagram, member)) {
      for (const state of this.#active.get(member)) {
        let id = state.startsWith(prefix) ? state.slice(prefix.length) : "";
        while (id && !nodes.has(id)) {
          id = above(id);
        }
        if (id) {
          yield id;
        }
      }
    }
  }

  /** Offer those who are in a diagram; returns who is chosen. */
  #offer(crew) {
    const who = this.#who;
    const wanted = [EVERYONE, NOBODY, ...crew];
    if (wanted.join("\n") !== Array.from(who.options, ({ value }) => value).join("\n")) {
      const chosen = who.value;
      who.replaceChildren(
        new Option(crew.length > 1 ? `all ${crew.length}` : crew[0] || "the machine", EVERYONE),
        new Option("no lights", NOBODY),
        ...(crew.length > 1 ? crew : []).map((each) => new Option(each || "a machine", each)),
      );
      who.value = wanted.includes(chosen) ? chosen : EVERYONE;
      who.selectedIndex = Math.max(who.selectedIndex, 0);
    }
    who.hidden = !crew.length;
    return who.value;
  }
}

/** The state around a state; empty for one at the top. */
function above(id) {
  return id.slice(0, Math.max(id.lastIndexOf("."), 0));
}

/** Of some ids those in a diagram, where all have a prefix elsewhere; empty, that of its machine. */
function here(ids, prefix) {
  const machine = prefix.slice(0, -1);
  return ids.flatMap((id) => {
    const isInside = id.startsWith(prefix) && id !== machine;
    return isInside ? id.slice(prefix.length) : id === machine ? "" : [];
  });
}

/**
 * Whether an edge leads to what is entered first in a state, and was taken: of the transitions
 * that were, none leads from outside of the state to one in it.
 */
function begins(edge, entered, taken, edges) {
  const { id, to } = edge.dataset;
  if (!id.endsWith(INITIAL)) {
    return false;
  }
  const around = id.slice(0, -INITIAL.length);
  const isInside = (state) => !around || state.startsWith(`${around}.`);
  const entersElsewhere = taken.some(
    (each) => isInside(edges.get(each)?.dataset.to ?? "") && !isInside(each),
  );
  return entered.includes(around) && entered.includes(to) && !entersElsewhere;
}

/** How many are in a node, and who they are. */
function count(node, members) {
  const { left, top } = sides(node);
  const named = members.slice(0, MOST_NAMED).join("\n");
  const others = members.length - MOST_NAMED;
  const text = String(members.length);
  const width = 10 + 7 * text.length;
  const x = left + 4 - width; // where no line ends
  return made(
    "g",
    { class: "count" },
    made("title", {}, others > 0 ? `${named}\nand ${others} more` : named),
    made("rect", { x, y: top - 10, width, height: 16, rx: 8 }),
    made("text", { x: x + width / 2, y: top + 2, "text-anchor": "middle" }, text),
  );
}
