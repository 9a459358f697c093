// Highlighting of active states, and briefly of transitions just taken.

import { made, sides } from "./shapes.js";

const EVERYONE = "*";
const NOBODY = "-";
const MOST_NAMED = 12;
const MOMENT = 1500; // milliseconds
const INITIAL = "#initial->"; // suffix of the ids of arrows from initial states

export class Highlight {
  #who; // select element of members
  #runs = {}; // { DIAGRAM: [[ROLE, PREFIX OF ITS STATES], ...] }
  #roles = new Set();
  #active = new Map(); // innermost active states by member
  #isDeserted = true;
  #timers = new WeakMap(); // timers of highlighted transitions

  /** `changed` is called when the user selects another member. */
  constructor(who, changed) {
    this.#who = who;
    who.addEventListener("change", changed);
  }

  /** Store who runs which state machine. */
  learn(runs) {
    this.#runs = runs;
    this.#roles = new Set(Object.values(runs).flatMap((each) => each.map(([role]) => role)));
  }

  /** Update the active states of members. */
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

  /** Forget all members. */
  forget() {
    this.#active.clear();
    this.#isDeserted = true;
  }

  /** True once when the first members appear and their machines are known. */
  arrive() {
    const isFirst = this.#isDeserted && this.#active.size > 0 && Object.keys(this.#runs).length > 0;
    this.#isDeserted &&= !isFirst;
    return isFirst;
  }

  /** A diagram with an active member; `diagram` itself if it has one. */
  inhabited(diagram) {
    const members = [...this.#active.keys()];
    const isIn = (id) => members.some((each) => this.#prefixes(id, each).length);
    return isIn(diagram) ? diagram : (Object.keys(this.#runs).find(isIn) ?? diagram);
  }

  /** Highlight the active states in a picture of the diagram. */
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
    const found = new Map(); // members by node
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
   * Highlight briefly the transitions that members have just taken, by their ids, and the arrows
   * from initial states to states in `entered`.
   */
  flash(picture, diagram, taken, entered) {
    const edges = new Map(
      Array.from(picture.querySelectorAll(".edge"), (each) => [each.dataset.id, each]),
    );
    const lines = Array.from(picture.querySelectorAll("text[data-id]")); // inside the boxes of states
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

  /** Prefixes of a member's state ids in a diagram. */
  #prefixes(diagram, member) {
    const role = member.replace(/\[\d+\]| \(.*\)$/, ""); // dog[1], Guarding (dog.jsonl)
    if (this.#roles.has(role)) {
      return (this.#runs[diagram] ?? []).filter(([each]) => each === role).map((each) => each[1]);
    }
    return this.#runs[diagram] ? [""] : []; // of an unknown member, only the states are known
  }

  /** Nodes in which a member is; a hidden state maps to the node around it. */
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

  /** List the members of a diagram; returns the selection. */
  #offer(crew) {
    const who = this.#who;
    const wanted = [EVERYONE, NOBODY, ...crew];
    if (wanted.join("\n") !== Array.from(who.options, ({ value }) => value).join("\n")) {
      const chosen = who.value;
      who.replaceChildren(
        new Option(crew.length > 1 ? `all ${crew.length}` : crew[0] || "the machine", EVERYONE),
        new Option("no highlighting", NOBODY),
        ...(crew.length > 1 ? crew : []).map((each) => new Option(each || "a machine", each)),
      );
      who.value = wanted.includes(chosen) ? chosen : EVERYONE;
      who.selectedIndex = Math.max(who.selectedIndex, 0);
    }
    who.hidden = !crew.length;
    return who.value;
  }
}

/** Parent id of a state; empty at the top level. */
function above(id) {
  return id.slice(0, Math.max(id.lastIndexOf("."), 0));
}

/** Ids without their prefix, if they are in the diagram; empty for the machine itself. */
function here(ids, prefix) {
  const machine = prefix.slice(0, -1);
  return ids.flatMap((id) => {
    const isInside = id.startsWith(prefix) && id !== machine;
    return isInside ? id.slice(prefix.length) : id === machine ? "" : [];
  });
}

/**
 * True if an edge leads from an initial state to an entered state, and no transition that was taken
 * enters that region from outside.
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

/** Draw the number of members in a node, with their names. */
function count(node, members) {
  const { left, top } = sides(node);
  const named = members.slice(0, MOST_NAMED).join("\n");
  const others = members.length - MOST_NAMED;
  const text = String(members.length);
  const width = 10 + 7 * text.length;
  const x = left + 4 - width; // outside of the lines
  return made(
    "g",
    { class: "count" },
    made("title", {}, others > 0 ? `${named}\nand ${others} more` : named),
    made("rect", { x, y: top - 10, width, height: 16, rx: 8 }),
    made("text", { x: x + width / 2, y: top + 2, "text-anchor": "middle" }, text),
  );
}
