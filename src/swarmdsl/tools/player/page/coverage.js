// View of coverage: the states and transitions that have been reached until the moment.
import { el } from "./dom.js";
import { historyOf } from "./history.js";
import { write } from "./shapes.js";

export const view = {
  id: "coverage",
  title: "Coverage",

  available: (recording) => (recording.coverage?.elements.length ?? 0) > 0,

  mount(element, player) {
    this.player = player;
    this.all = el("p", { class: "said" });
    this.parts = new Map(); // by machine and kind
    element.append(this.all);
    const list = el("div", { class: "scrolled" });
    player.recording.coverage.elements.forEach(({ machine, kind, words }, number) => {
      const key = `${machine}\n${kind}`;
      if (!this.parts.has(key)) {
        const [head, bar, rows] = [el("summary"), el("progress", { "aria-label": `${kind}s of ${machine}` }), el("ul", { class: "reached" })];
        list.append(el("details", { open: true }, head, bar, rows));
        this.parts.set(key, { machine, kind, head, bar, rows, items: [] });
      }
      const part = this.parts.get(key);
      const item = el("button", { type: "button", onclick: () => this.go(number) }, words);
      part.rows.append(el("li", {}, item));
      part.items.push({ number, item });
    });
    element.append(list);
  },

  /** Go to the line that has reached an element. */
  go(number) {
    const at = historyOf(this.player.recording).reached.get(number);
    if (at !== undefined) this.player.go(at);
  },

  show(moment) {
    const { reached } = historyOf(this.player.recording);
    let [found, there] = [0, 0];
    for (const { machine, kind, head, bar, items } of this.parts.values()) {
      let count = 0;
      for (const each of items) {
        const at = reached.get(each.number) ?? Infinity;
        const state = at <= moment.index ? "reached" : at < Infinity ? "later" : "never";
        if (state === "reached") count += 1;
        if (each.state === state) continue;
        each.state = state;
        each.item.dataset.state = state;
        each.item.title = { reached: "reached: go there", later: "reached later: go there", never: "never reached in this run" }[state];
      }
      write(head, `${machine}: ${count} of ${items.length} ${kind}s`);
      bar.max = items.length;
      bar.value = count;
      found += count;
      there += items.length;
    }
    write(this.all, `${Math.floor((100 * found) / there)} % of all states and transitions until now`);
  },
};
