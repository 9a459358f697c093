// The page: recording, player, views and controls together.
import { addOther } from "./both_lanes.js";
import { differences } from "./compare.js";
import { controls } from "./controls.js";
import { el } from "./dom.js";
import { exports } from "./exports.js";
import { follow } from "./live.js";
import { Player } from "./player.js";
import { load } from "./recording.js";
import { BEGINNINGS, MAIN, VIEWS } from "./views.js";

const byId = (id) => document.getElementById(id);
const DURATION = /^(\d+(?:\.\d+)?)(ms|s|min|h)?$/;
const UNITS = { ms: 1e6, s: 1e9, min: 60e9, h: 3600e9 };

/** Read and write the address: `#t=12.5s&line=31&m=uav[1]&v=machine`. */
function address(player, panels) {
  const { recording } = player;
  let pending = 0;
  const read = (address = location.href) => {
    clearTimeout(pending);
    const given = new URLSearchParams(new URL(address).hash.slice(1));
    const time = DURATION.exec(given.get("t") ?? "");
    if (given.has("m")) player.select(given.get("m"));
    if (time) player.goTime(Number(time[1]) * UNITS[time[2] ?? "s"]);
    // Several lines may have one time.
    const line = Number(given.get("line")) - 1;
    const isLine = Number.isInteger(line) && line >= 0 && line < recording.count;
    if (isLine && recording.time(line) === player.time) player.go(line);
    panels.open((given.get("v") ?? "").split(","));
  };
  const write = () => {
    clearTimeout(pending);
    // Browsers refuse more than some changes a second.
    pending = setTimeout(() => {
      const member = player.selected === null ? "" : `&m=${encodeURIComponent(player.selected).replace(/%5B/g, "[").replace(/%5D/g, "]")}`;
      const line = player.index === recording.at(player.time) ? "" : `&line=${player.index + 1}`;
      const text = `#t=${Math.round(player.time / 1e3) / 1e6}s${line}${member}&v=${panels.opened().join(",")}`;
      if (text !== location.hash) history.replaceState(null, "", text);
    }, 250);
  };
  for (const name of ["moment", "selection"]) player.on(name, write);
  // The address may have been written again meanwhile.
  addEventListener("hashchange", (event) => read(event.newURL));
  panels.changed = write;
  return read;
}

/** The view, such that a fault of it is told in its place and leaves the others alone. */
function contained(view) {
  let place = null;
  const safely = (act) => (...given) => {
    try {
      return act(...given);
    } catch (error) {
      place?.replaceChildren(el("p", { class: "error" }, `this view cannot show the recording: ${error.message}`));
      return false;
    }
  };
  const mount = safely((element, player) => view.mount((place = element), player));
  return { ...view, available: safely((recording) => view.available(recording)), mount, show: safely((moment) => view.show(moment)) };
}

/** Two panels with tabs of views; the views that are seen are shown each moment. */
function panelsOf(element, player) {
  const { recording } = player;
  let views = [];
  const panels = [];
  const found = {
    changed: () => {},
    opened: () => panels.map((each) => each.view?.id).filter(Boolean),
    open: (ids) => ids.forEach((id, at) => panels[at]?.open(views.find((each) => each.id === id))),
    show: (moment) => panels.forEach((each) => each.view?.show(moment)),
  };
  const mounted = new Map();
  const add = (side) => {
    const body = el("div", { class: "view", role: "tabpanel", tabindex: 0, id: `panel-${side}` });
    const tabs = views.map((each) =>
      el("button", { type: "button", role: "tab", "aria-selected": "false", "aria-controls": body.id, tabindex: -1, onclick: () => panel.open(each) }, each.title),
    );
    const panel = {
      view: null,
      open(view) {
        if (!view || panel.view === view) return;
        const other = panels.find((each) => each.view === view);
        const before = panel.view;
        panel.put(view);
        if (other) other.put(before);
        found.changed();
      },
      put(view) {
        panel.view = view;
        tabs.forEach((tab, at) => {
          tab.setAttribute("aria-selected", String(views[at] === view));
          tab.tabIndex = views[at] === view ? 0 : -1;
        });
        if (!view) return body.replaceChildren();
        if (!mounted.has(view)) {
          mounted.set(view, el("div", { class: `of-${view.id}` }));
          body.replaceChildren(mounted.get(view));
          view.mount(mounted.get(view), player);
        }
        body.replaceChildren(mounted.get(view));
        view.show(player.moment);
      },
    };
    const list = el("div", { role: "tablist", "aria-label": side ? "second view" : "view" }, ...tabs);
    list.addEventListener("keydown", (event) => {
      const way = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
      if (!way) return;
      const at = (views.indexOf(panel.view) + way + views.length) % views.length;
      panel.open(views[at]);
      tabs[at].focus();
    });
    element.append(el("section", { class: "panel" }, list, body));
    panels.push(panel);
  };
  let members = 0;
  /** Make the panels again if there is more to see. */
  found.renew = () => {
    const now = VIEWS.filter((each) => contained(each).available(recording));
    if (now.length === views.length && members === recording.members.length) return;
    const before = found.opened();
    members = recording.members.length;
    views = now.map(contained);
    element.replaceChildren();
    panels.length = 0;
    mounted.clear();
    for (const side of views.length > 1 ? [0, 1] : views.length ? [0] : []) add(side);
    panels.forEach((each, side) => each.put(views[side]));
    found.open(before);
  };
  found.renew();
  return found;
}

/** Tell the diagnostics of the command. */
function notes(element, recording) {
  element.replaceChildren();
  const found = [...recording.notes, ...(recording.other?.notes ?? [])];
  if (!found.length) return;
  const errors = found.filter((each) => each.severity === "error").length;
  const items = found.map((each) =>
    el(
      "li",
      { class: each.severity },
      el("strong", {}, `${each.severity}${each.code && `[${each.code}]`}: `),
      each.message,
      ...(each.place ? [" ", el("code", {}, each.place)] : []),
      ...(each.help ? [el("br"), `help: ${each.help}`] : []),
    ),
  );
  const count = (number, word) => `${number} ${word}${number === 1 ? "" : "s"}`;
  const title = `${count(errors, "error")} and ${count(items.length - errors, "warning")} in this recording`;
  element.append(el("details", { class: "notes", open: errors > 0 }, el("summary", {}, title), el("ul", {}, ...items)));
}

function start(recording) {
  const player = new Player(recording);
  player.views = VIEWS;
  let told = -1;
  const tell = () => {
    const about = [
      recording.model,
      recording.scenario && `scenario ${recording.scenario}`,
      recording.seed !== null && `seed ${recording.seed}`,
      `${recording.members.length} member${recording.members.length === 1 ? "" : "s"}`,
      `${recording.count} lines`,
    ];
    byId("about").textContent = about.filter(Boolean).join(", ");
    if (told !== recording.notes.length) notes(byId("notes"), recording);
    told = recording.notes.length;
  };
  tell();
  const lanes = el("div", { class: "of-lanes" });
  byId("main").append(lanes);
  const main = contained(MAIN);
  const mounted = main.mount(lanes, player);
  if (recording.other && mounted) addOther(byId("main"), mounted);
  const panels = panelsOf(byId("panels"), player);
  const showControls = controls(byId("controls"), player);
  exports(byId("controls"), player);
  let waiting = false;
  const show = () => {
    waiting = false;
    if (hasGrown) {
      tell();
      panels.renew();
    }
    hasGrown = false;
    const { moment } = player;
    showControls();
    main.show(moment);
    panels.show(moment);
  };
  const soon = () => {
    if (!waiting) requestAnimationFrame(show);
    waiting = true;
  };
  player.on("moment", soon);
  player.on("selection", soon);
  let hasGrown = false;
  player.on("growth", () => soon((hasGrown = true)));
  const read = address(player, panels);
  player.go(0);
  if (recording.other) player.goTime(differences(recording).times[0] ?? 0);
  read();
  show();
  for (const each of BEGINNINGS) each(player);
  if (recording.live) follow(player, byId("live"));
  document.documentElement.dataset.ready = "true";
  return player;
}

const other = byId("other")?.textContent;
export const started = Promise.all([load(byId("recording").textContent), other ? load(other) : null])
  .then(([recording, compared]) => {
    recording.other = compared; // a run to compare with
    globalThis.player = start(recording);
  })
  .catch((error) => byId("notes").append(el("p", { class: "error", role: "alert" }, `this recording cannot be shown: ${error.message}`)));
