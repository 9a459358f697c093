"use strict";
// Scroll to links, search, highlight the current entry in the contents, switch the theme, zoom and
// fold diagrams. The page works without this script.
(() => {
  const MOST = 40;
  const byId = (id) => document.getElementById(id);
  const root = document.documentElement;
  const [field, list, told] = ["page-search", "page-found", "page-told"].map(byId);
  const [menu, contents, theme] = ["page-menu", "page-contents", "page-theme"].map(byId);

  root.classList.add("scripted");
  field.parentElement.hidden = menu.hidden = theme.hidden = false;

  // ---- links: elements get their real height when they come into view, which moves those below
  const settle = (id) => {
    const target = byId(id);
    const again = (left) => {
      target.scrollIntoView();
      if (left > 0) requestAnimationFrame(() => again(left - 1));
    };
    if (target) requestAnimationFrame(() => again(4));
  };
  const goal = (hash) => decodeURIComponent(hash.slice(1));
  document.addEventListener("click", (event) => {
    const link = event.target.closest("a[href^='#']");
    if (link) settle(goal(link.getAttribute("href")));
  });
  // On back and forward, the browser restores the position itself.
  const comes = performance.getEntriesByType("navigation")[0]?.type === "navigate";
  if (comes) addEventListener("load", () => settle(goal(location.hash)));

  // ---- search
  let index;
  const all = () => {
    index ??= [...document.querySelectorAll("[data-kind]")].map((element) => ({
      id: element.id,
      kind: element.dataset.kind,
      name: element.dataset.name,
      lower: element.dataset.name.toLowerCase(),
      path: element.id.toLowerCase(),
      doc: (element.querySelector(":scope > .doc, :scope > td:last-child > .doc")?.textContent ?? "").trim(),
    }));
    return index;
  };
  // Rank of a match, 0 is best; undefined if the element does not match.
  const rank = (item, word) => {
    if (item.lower === word) return 0;
    if (item.lower.startsWith(word)) return 1;
    if (item.lower.includes(word)) return 2;
    if (item.path.includes(word)) return 3;
    if (item.kind.startsWith(word)) return 4;
    return item.doc.toLowerCase().includes(word) ? 5 : undefined;
  };
  const search = (text) => {
    const words = text.toLowerCase().split(/\s+/).filter(Boolean);
    if (words.length === 0) return [];
    const found = [];
    for (const item of all()) {
      let sum = 0;
      for (const word of words) sum += rank(item, word) ?? NaN;
      if (!Number.isNaN(sum)) found.push([sum, item.path.split(".").length, found.length, item]);
    }
    found.sort((a, b) => a[0] - b[0] || a[1] - b[1] || a[2] - b[2]);
    return found.map((each) => each[3]);
  };

  let chosen = -1;
  const choose = (at) => {
    const options = list.children;
    options[chosen]?.setAttribute("aria-selected", "false");
    chosen = options.length ? (at + options.length) % options.length : -1;
    options[chosen]?.setAttribute("aria-selected", "true");
    options[chosen]?.scrollIntoView({ block: "nearest" });
    if (chosen < 0) field.removeAttribute("aria-activedescendant");
    else field.setAttribute("aria-activedescendant", options[chosen].id);
  };
  const close = () => {
    list.hidden = true;
    field.setAttribute("aria-expanded", "false");
    choose(-1);
  };
  const follow = (option) => {
    field.blur();
    close();
    const id = option.dataset.to;
    location.hash = encodeURIComponent(id).replaceAll("%2F", "/");
    const target = byId(id);
    target.tabIndex = -1;
    target.focus({ preventScroll: true });
    target.scrollIntoView();
    settle(id);
  };
  const option = (item, at) => {
    const made = document.createElement("li");
    made.id = `page-found-${at}`;
    made.role = "option";
    made.dataset.to = item.id;
    made.setAttribute("aria-selected", "false");
    const kind = document.createElement("span");
    kind.className = "kind";
    kind.textContent = item.kind;
    const around = document.createElement("span");
    around.className = "in";
    around.textContent = item.doc.length > 110 ? `${item.doc.slice(0, 110)}…` : item.doc;
    made.append(item.id, " ", kind, around);
    return made;
  };
  const show = () => {
    const found = search(field.value);
    list.replaceChildren(...found.slice(0, MOST).map(option));
    const any = field.value.trim() !== "";
    list.hidden = !any || found.length === 0;
    field.setAttribute("aria-expanded", String(!list.hidden));
    const more = found.length > MOST ? `, showing the first ${MOST}` : "";
    told.textContent = any ? `${found.length || "no"} results${more}` : "";
    told.classList.toggle("hidden", found.length > 0 || !any);
    chosen = -1;
    choose(0);
  };
  field.addEventListener("input", show);
  field.addEventListener("focus", () => field.value && show());
  field.addEventListener("keydown", (event) => {
    if (event.key === "ArrowDown") choose(chosen + 1);
    else if (event.key === "ArrowUp") choose(chosen - 1);
    else if (event.key === "Enter" && list.children[chosen]) follow(list.children[chosen]);
    else if (event.key === "Escape") {
      field.value = "";
      show();
      field.blur();
    } else return;
    event.preventDefault();
  });
  list.addEventListener("mousedown", (event) => event.preventDefault());
  list.addEventListener("click", (event) => {
    const option = event.target.closest("li");
    if (option) follow(option);
  });
  document.addEventListener("click", (event) => {
    if (!event.target.closest(".search")) close();
  });
  document.addEventListener("keydown", (event) => {
    const writes = event.target.closest?.("input, textarea");
    if ((event.key === "/" && !writes && !event.ctrlKey && !event.metaKey) || (event.key === "k" && (event.ctrlKey || event.metaKey))) {
      event.preventDefault();
      field.focus();
      field.select();
    }
  });

  // ---- contents
  const open = (is) => {
    contents.classList.toggle("open", is);
    menu.setAttribute("aria-expanded", String(is));
  };
  menu.addEventListener("click", () => open(!contents.classList.contains("open")));
  contents.addEventListener("click", (event) => event.target.closest("a") && open(false));
  const links = new Map([...contents.querySelectorAll("li a")].map((a) => [goal(a.hash), a]));
  let current;
  const inView = new Set();
  const watcher = new IntersectionObserver(
    (changes) => {
      for (const each of changes) inView[each.isIntersecting ? "add" : "delete"](each.target.id);
      const first = [...links.keys()].find((id) => inView.has(id));
      if (first === undefined || links.get(first) === current) return;
      current?.removeAttribute("aria-current");
      current = links.get(first);
      current.setAttribute("aria-current", "true");
    },
    { rootMargin: "-20% 0px -60% 0px" },
  );
  for (const id of links.keys()) watcher.observe(byId(id));

  // ---- colours
  const THEMES = ["system", "light", "dark"];
  const kept = {
    get: () => {
      try {
        return localStorage.getItem("swarmc-doc-theme");
      } catch {
        return null; // some browsers have no storage for local files
      }
    },
    set: (value) => {
      try {
        localStorage.setItem("swarmc-doc-theme", value);
      } catch {
        /* no storage */
      }
    },
  };
  const paint = (name) => {
    if (name === "system") delete root.dataset.theme;
    else root.dataset.theme = name;
    theme.querySelector("span").textContent = `: ${name}`;
  };
  let painted = THEMES.includes(kept.get()) ? kept.get() : "system";
  paint(painted);
  theme.addEventListener("click", () => {
    painted = THEMES[(THEMES.indexOf(painted) + 1) % THEMES.length];
    kept.set(painted);
    paint(painted);
  });

  // ---- diagrams, when they come into view: zoom, pan and fold
  const [SMALLEST, LARGEST, STEP, CLICK] = [0.1, 4, 1.25, 4]; // the last in pixels
  const zoomable = (picture) => {
    const whole = picture.querySelector("svg");
    const views = [whole, ...[...picture.querySelectorAll("template")].map((each) => each.content.firstElementChild)];
    let level = 0;
    const natural = () => views[level].viewBox.baseVal.width;
    const scale = () => views[level].clientWidth / natural();
    const buttons = {};
    const tell = () => {
      const percent = Math.round(scale() * 100);
      buttons.fit.textContent = `Fit (${percent} %)`;
      buttons.smaller.disabled = scale() <= SMALLEST;
      buttons.larger.disabled = scale() >= LARGEST;
      if (buttons.fold) {
        buttons.fold.disabled = level === views.length - 1;
        buttons.unfold.disabled = level === 0;
      }
    };
    // Zoom so that what is at a place of the frame stays there.
    const zoom = (factor, x = picture.clientWidth / 2, y = picture.clientHeight / 2) => {
      const svg = views[level];
      const before = svg.getBoundingClientRect();
      const frame = picture.getBoundingClientRect();
      const [left, top] = [(frame.left + x - before.left) / before.width, (frame.top + y - before.top) / before.height];
      const height = picture.clientHeight;
      const next = Math.min(LARGEST, Math.max(SMALLEST, scale() * factor));
      picture.style.height ||= `${height}px`;
      picture.classList.add("zoomed");
      svg.style.width = `${natural() * next}px`;
      const after = svg.getBoundingClientRect();
      picture.scrollLeft += after.left + left * after.width - frame.left - x;
      picture.scrollTop += after.top + top * after.height - frame.top - y;
      tell();
    };
    const fit = () => {
      picture.classList.remove("zoomed");
      picture.style.height = "";
      for (const each of views) each.style.width = "";
      tell();
    };
    const fold = (by) => {
      const next = Math.min(views.length - 1, Math.max(0, level + by));
      views[level].replaceWith(views[next]);
      level = next;
      fit();
    };

    const row = document.createElement("span");
    row.className = "zoom";
    const add = (key, name, word, act, keys) => {
      const button = document.createElement("button");
      Object.assign(button, { type: "button", textContent: name, title: `${word} (${keys})` });
      button.setAttribute("aria-label", word);
      button.addEventListener("click", act);
      buttons[key] = button;
      row.append(button);
    };
    add("smaller", "−", "Zoom out", () => zoom(1 / STEP), "key -");
    add("larger", "+", "Zoom in", () => zoom(STEP), "key +");
    add("fit", "Fit", "Fit the page", fit, "key 0");
    if (views.length > 1) {
      add("fold", "Fold", "Fold states and parts", () => fold(1), "key f");
      add("unfold", "Unfold", "Unfold states and parts", () => fold(-1), "key u");
    }
    picture.parentElement.querySelector("figcaption").append(row);

    picture.tabIndex = 0;
    picture.addEventListener("keydown", ({ key, ctrlKey, metaKey, altKey }) => {
      if (ctrlKey || metaKey || altKey) return;
      if (key === "+" || key === "=") zoom(STEP);
      else if (key === "-") zoom(1 / STEP);
      else if (key === "0") fit();
      else if (key === "f") fold(1);
      else if (key === "u") fold(-1);
    });
    // With Ctrl, or by pinching on a touchpad; the wheel alone scrolls the page.
    const at = ({ clientX, clientY }) => {
      const frame = picture.getBoundingClientRect();
      return [clientX - frame.left, clientY - frame.top];
    };
    picture.addEventListener(
      "wheel",
      (event) => {
        if (!event.ctrlKey) return;
        event.preventDefault();
        zoom(Math.exp(-event.deltaY / 300), ...at(event));
      },
      { passive: false },
    );
    // One mouse pointer pans and two fingers zoom; one finger scrolls, as on the rest of the page.
    const held = new Map();
    let moved = 0;
    const span = () => {
      const [a, b] = [...held.values()];
      return [Math.hypot(a.clientX - b.clientX, a.clientY - b.clientY), ...at({ clientX: (a.clientX + b.clientX) / 2, clientY: (a.clientY + b.clientY) / 2 })];
    };
    picture.addEventListener("pointerdown", (event) => {
      if (event.button === 0) held.set(event.pointerId, event);
      moved = 0;
    });
    picture.addEventListener("pointermove", (event) => {
      const last = held.get(event.pointerId);
      if (!last) return;
      if (held.size === 2) {
        const [before] = span();
        held.set(event.pointerId, event);
        const [after, x, y] = span();
        if (before > 0) zoom(after / before, x, y);
        return;
      }
      held.set(event.pointerId, event);
      if (event.pointerType === "touch") return;
      moved += Math.hypot(event.clientX - last.clientX, event.clientY - last.clientY);
      picture.scrollLeft -= event.clientX - last.clientX;
      picture.scrollTop -= event.clientY - last.clientY;
    });
    for (const name of ["pointerup", "pointercancel", "pointerleave"])
      picture.addEventListener(name, ({ pointerId }) => held.delete(pointerId));
    picture.addEventListener("dragstart", (event) => event.preventDefault());
    picture.addEventListener("click", (event) => moved > CLICK && (event.preventDefault(), event.stopPropagation()), true);
    tell();
  };
  const seen = new IntersectionObserver((changes) => {
    for (const { isIntersecting, target } of changes) {
      if (!isIntersecting) continue;
      seen.unobserve(target);
      if (target.matches(".picture")) zoomable(target);
      else if (target.scrollWidth > target.clientWidth) target.tabIndex = 0;
    }
  });
  for (const each of document.querySelectorAll(".scroll, .picture")) seen.observe(each);
})();
