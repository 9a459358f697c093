// Controls: the bar with time and speed, the keys, and the help that lists them.
import { clock, duration, el } from "./dom.js";
import { act } from "./lanes.js";
import { STEPS } from "./player.js";

const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 5, 10, 30, 60, 120];

/** The speed at which a run takes half a minute. */
const fitting = (end) => SPEEDS.findLast((each) => each <= Math.max(end / 30e9, 0.1));

/** Keys with what they do, in words and as a function. Capital letters go back. */
function keysOf(player, help) {
  const both = (key, words, kind) => [
    [key, `next ${words}`, () => player.step(kind, 1)],
    [key.toUpperCase(), `${words} before`, () => player.step(kind, -1)],
  ];
  return [
    [" ", "play or pause", () => player.play()],
    ["ArrowRight", "next macrostep", () => player.step("macrostep", 1)],
    ["ArrowLeft", "macrostep before", () => player.step("macrostep", -1)],
    ...both("e", "event of the chosen member", "member"),
    ...both("s", "line that sends", "send"),
    ...both("l", "lost event", "loss"),
    ...both("f", "fault", "fault"),
    ...both("v", "violation", "violation"),
    ["Home", "beginning", () => player.go(0)],
    ["End", "end", () => player.goTime(player.recording.end)],
    [",", "slower", () => player.faster(-1)],
    [".", "faster", () => player.faster(1)],
    ["b", "set or remove a bookmark", () => player.bookmark()],
    ["]", "next bookmark", () => player.goBookmark(1)],
    ["[", "bookmark before", () => player.goBookmark(-1)],
    ["+", "zoom in", () => act.zoom(2)],
    ["-", "zoom out", () => act.zoom(0.5)],
    ["0", "whole run", () => act.zoom(1e-9)],
    ["m", "next member", () => choose(player, 1)],
    ["M", "member before", () => choose(player, -1)],
    ["Escape", "choose no member", () => player.select(null)],
    ["/", "search", () => act.search()],
    ["?", "this help", () => help.showModal()],
  ];
}

const NAMES = { " ": "space", ArrowRight: "\u2192", ArrowLeft: "\u2190" };

function choose(player, direction) {
  const { members } = player.recording;
  const at = members.findIndex((each) => each.name === player.selected);
  const next = at < 0 ? (direction > 0 ? 0 : members.length - 1) : at + direction;
  player.select(members[(next + members.length) % members.length]?.name ?? null);
}

export function controls(element, player) {
  const { recording } = player;
  const help = el("dialog", { "aria-labelledby": "help-title" });
  const keys = keysOf(player, help);
  const rows = keys.map(([key, words]) => el("tr", {}, el("td", {}, el("kbd", {}, NAMES[key] ?? key)), el("td", {}, words)));
  help.append(
    el("h2", { id: "help-title" }, "Keys"),
    el("table", {}, ...rows),
    el("p", {}, "In the lanes: click or drag to go to a time, shift and drag to zoom, ctrl and wheel to zoom."),
    el("form", { method: "dialog" }, el("button", {}, "Close")),
  );
  const button = (text, title, onclick) => el("button", { type: "button", title, "aria-label": title, onclick }, text);
  const play = button("\u25b6", "play (space)", () => player.play());
  const time = el("input", {
    type: "range",
    min: 0,
    max: recording.end || 1,
    step: "any",
    value: 0,
    "aria-label": "time of the run",
    oninput: () => player.goTime(Number(time.value)),
  });
  const kind = el(
    "select",
    { "aria-label": "kind of step" },
    ...Object.keys(STEPS).map((value) => el("option", { value }, value === "member" ? "event of the chosen member" : value)),
  );
  const told = el("span", { class: "said" });
  const live = el("div", { class: "unseen", role: "status", "aria-live": "polite" });
  const step = (direction) => {
    if (!player.step(kind.value, direction)) live.textContent = `there is no ${kind.selectedOptions[0].text} ${direction > 0 ? "after" : "before"} this moment`;
  };
  const speed = el(
    "select",
    { "aria-label": "speed", onchange: () => (player.speed = Number(speed.value)) },
    ...SPEEDS.map((each) => el("option", { value: each }, `${each}\u00d7`)),
  );
  player.speed = recording.live ? 1 : fitting(recording.end);
  player.faster = (by) => {
    const at = SPEEDS.indexOf(player.speed) + by;
    player.speed = SPEEDS[Math.max(0, Math.min(at, SPEEDS.length - 1))];
    speed.value = String(player.speed);
  };
  speed.value = String(player.speed);
  const now = el("output", { class: "now" });
  element.append(
    play,
    button("\u2039", "step back (\u2190)", () => step(-1)),
    button("\u203a", "step on (\u2192)", () => step(1)),
    kind,
    time,
    now,
    speed,
    button("\u2605", "set or remove a bookmark (b)", () => player.bookmark()),
    button("?", "keys (?)", () => help.showModal()),
    told,
    live,
    help,
  );
  const show = () => {
    time.max = recording.end || 1;
    time.value = String(player.time);
    time.setAttribute("aria-valuetext", duration(player.time));
    now.textContent = `${clock(player.time)} of ${clock(recording.end)}`;
    told.textContent = player.said();
    if (!player.playing) live.textContent = `${duration(player.time)}: ${told.textContent}`;
  };
  player.on("playing", () => {
    play.textContent = player.playing ? "\u23f8" : "\u25b6";
    play.setAttribute("aria-label", player.playing ? "pause (space)" : "play (space)");
  });
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || help.open) return;
    const typed = event.target.closest("input:not([type=checkbox], [type=range]), select");
    if (typed) {
      if (event.key === "Escape") typed.blur();
      return;
    }
    if (event.key === " " && event.target.closest("button, summary, a, [type=checkbox]")) return;
    if (event.key.startsWith("Arrow") && event.target.closest("[type=range]")) return;
    if (event.key.startsWith("Arrow") && event.target.closest("[role=tab]")) return;
    const found = keys.find(([key]) => key === event.key);
    if (!found) return;
    event.preventDefault();
    found[2]();
  });
  return show;
}
