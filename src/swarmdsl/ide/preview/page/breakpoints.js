// Breakpoints on states and transitions: a menu sets them, dots in the picture show them.

import { button } from "./elements.js";
import { made, sides } from "./shapes.js";

const STATECHART = ".statechart";
const STOPPABLE = ".node[data-place]:not(.frame, .initial), .edge.transition, text[data-id]";

export class Breakpoints {
  #menu;
  #act;
  #open;
  #places = {}; // { DIAGRAM: [ID of a state or transition, ...] }
  #origin; // element that had the focus before the menu

  /** `act` is called with `{ breakpoint, diagram }`, or null for all of them; `open` with a place. */
  constructor(menu, act, open) {
    this.#menu = menu;
    this.#act = act;
    this.#open = open;
    menu.addEventListener("keydown", (event) => this.#press(event));
    window.addEventListener("pointerdown", ({ target }) => menu.contains(target) || this.#close());
  }

  /** Take the breakpoints of all diagrams. */
  learn(places) {
    this.#places = places;
  }

  /** Draw a dot at each state and transition with a breakpoint. */
  mark(picture, diagram) {
    picture.querySelector(".stops")?.remove();
    const dots = (this.#places[diagram] ?? []).flatMap((id) => {
      const found = find(picture, id);
      return found ? [dot(found)] : [];
    });
    if (dots.length) {
      picture.querySelector("svg").append(made("g", { class: "stops" }, ...dots));
    }
  }

  /** Set or remove the breakpoint on an element; return false if there can be none. */
  toggle(element, diagram) {
    const found = element?.closest(STOPPABLE);
    if (!found || !diagram?.endsWith(STATECHART)) {
      return false;
    }
    this.#act({ breakpoint: found.dataset.id, diagram });
    return true;
  }

  /** Show the menu of an element: breakpoints on it and, for a state, on its transitions. */
  offer(event, picture, diagram) {
    const found = event.target.closest(STOPPABLE);
    if (!found || !diagram?.endsWith(STATECHART)) {
      return;
    }
    event.preventDefault();
    const id = found.dataset.id;
    const own = found.matches(".node") ? [...picture.querySelectorAll(STOPPABLE)].filter((each) => isOf(each, id)) : [];
    const set = this.#places[diagram] ?? [];
    const items = [found, ...own].map((each) => {
      const item = button(`Breakpoint on ${label(each)}`, "");
      item.setAttribute("role", "menuitemcheckbox");
      item.setAttribute("aria-checked", String(set.includes(each.dataset.id)));
      item.addEventListener("click", () => this.#act({ breakpoint: each.dataset.id, diagram }));
      return item;
    });
    const { place } = found.closest("[data-place]").dataset;
    items.push(command("Open the text", () => this.#open(place)));
    if (Object.keys(this.#places).length) {
      items.push(command("Remove all breakpoints", () => this.#act({ breakpoint: null })));
    }
    for (const item of items) {
      item.addEventListener("click", () => this.#close());
    }
    this.#show(items, event.clientX, event.clientY);
  }

  #show(items, x, y) {
    this.#origin = document.activeElement;
    this.#menu.replaceChildren(...items);
    this.#menu.hidden = false;
    const { width, height } = this.#menu.getBoundingClientRect();
    this.#menu.style.left = `${Math.max(0, Math.min(x, window.innerWidth - width))}px`;
    this.#menu.style.top = `${Math.max(0, Math.min(y, window.innerHeight - height))}px`;
    items[0].focus();
  }

  #close() {
    if (!this.#menu.hidden) {
      this.#menu.hidden = true;
      this.#origin?.focus({ preventScroll: true });
    }
  }

  #press(event) {
    const items = [...this.#menu.children];
    const step = { ArrowDown: 1, ArrowUp: -1 }[event.key];
    if (step) {
      const next = items.indexOf(document.activeElement) + step;
      items.at(next % items.length).focus();
    } else if (["Escape", "Tab"].includes(event.key)) {
      this.#close();
    } else {
      event.stopPropagation(); // no key of the simulation
      return;
    }
    event.stopPropagation();
    event.preventDefault();
  }
}

function command(text, act) {
  const item = button(text, "");
  item.setAttribute("role", "menuitem");
  item.addEventListener("click", act);
  return item;
}

function find(picture, id) {
  const found = [...picture.querySelectorAll(STOPPABLE)];
  return found.find((each) => each.dataset.id === id);
}

/** True for a transition of a state. */
function isOf(element, state) {
  return element.dataset.id.startsWith(`${state}->`);
}

/** Name of a state, or the text of a transition with its target. */
function label(element) {
  if (element.matches(".node")) {
    return element.getAttribute("aria-label");
  }
  const texts = element.matches("text") ? [element] : [...element.querySelectorAll("text")];
  const words = texts.map((each) => each.textContent.trim());
  const { to } = element.dataset;
  return [...words, ...(to ? ["\u2192", to] : [])].join(" ");
}

function dot(element) {
  const { x, y } = spot(element);
  return made("circle", { class: "stop", cx: x, cy: y, r: 5 }, made("title", {}, "breakpoint"));
}

/** Place of the dot: on the left border of a state, at the start of an edge, before a line of text. */
function spot(element) {
  if (element.matches("text")) {
    const { x, y, height } = element.getBBox();
    return { x: x - 8, y: y + height / 2 };
  }
  if (element.matches(".edge")) {
    const path = element.querySelector("path");
    return path.getPointAtLength(Math.min(14, path.getTotalLength() / 2));
  }
  const { left, top } = sides(element);
  return { x: left, y: top + 14 };
}
