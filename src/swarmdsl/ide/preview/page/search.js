// Search for an element by its name, also in folded nodes.

export class Search {
  #entry;
  #options;
  #names = {}; // { ID: NAME }
  #text = "";
  #next = 0;

  /**
   * `found` is called with the id of a match, its number and the number of matches; without an id if
   * there are none. `left` is called on Escape.
   */
  constructor(entry, options, found, left) {
    this.#entry = entry;
    this.#options = options;
    entry.addEventListener("keydown", (event) => {
      if (event.key === "Enter") {
        this.#find(event.shiftKey ? -1 : 1, found);
      } else if (event.key === "Escape") {
        entry.value = "";
        left();
      }
    });
    document.addEventListener("keydown", (event) => {
      const isSearch = (event.ctrlKey || event.metaKey) && event.key === "f";
      if (isSearch || (event.key === "/" && event.target !== entry)) {
        event.preventDefault();
        entry.focus();
        entry.select();
      }
    });
  }

  /** Store the names of the elements of a diagram by id. */
  learn(names) {
    this.#names = names;
    const all = [...new Set(Object.values(names))].sort();
    this.#options.replaceChildren(...all.map((name) => new Option(name, name)));
  }

  #find(step, found) {
    const text = this.#entry.value.trim().toLowerCase();
    if (!text) {
      return;
    }
    const matches = this.#matches(text);
    this.#next = text === this.#text ? this.#next + step : 0;
    this.#text = text;
    const number = ((this.#next % matches.length) + matches.length) % matches.length;
    found(matches[number], number + 1, matches.length);
  }

  /** Ids of elements with a name or path that contains a text, the best ones first. */
  #matches(text) {
    const rank = (id, name) => {
      const [path, word] = [id.toLowerCase(), name.toLowerCase()];
      const inPath = text.includes(".") && path.includes(text);
      return [word === text || path === text, word.startsWith(text), word.includes(text), inPath].indexOf(true);
    };
    return Object.entries(this.#names)
      .map(([id, name], order) => ({ id, order, rank: rank(id, name) }))
      .filter(({ rank }) => rank >= 0)
      .sort((one, other) => one.rank - other.rank || one.order - other.order)
      .map(({ id }) => id);
  }
}
