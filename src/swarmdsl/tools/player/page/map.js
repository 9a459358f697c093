// Map: where robots are, the ways that they went, what they have seen, and who reaches whom by radio.
import { clock, el, own, picture, printable } from "./dom.js";
import { historyOf } from "./history.js";
import { robotOf } from "./recording.js";
import { press, shape, upTo, write } from "./shapes.js";

const SIZE = 5;
const MOST_LINKS = 60;

export const view = {
  id: "map",
  title: "Map",

  available: (recording) => Boolean(recording.map),

  mount(element, player) {
    this.player = player;
    const { recording } = player;
    this.said = el("p", { class: "said" });
    this.svg = picture(recording.map.svg);
    this.svg.setAttribute("class", "map");
    this.svg.setAttribute("role", "group");
    this.svg.setAttribute("aria-label", "Map of the robots");
    const layer = (name) => this.svg.appendChild(shape("g", { class: name }));
    [this.links, this.trails, this.targets, this.seen, this.robots] = ["links", "trails", "targets", "sightings", "robots"].map(layer);
    this.marks = new Map();
    for (const { name, role } of recording.members) this.robot(robotOf(name), role);
    this.shown = {};
    const roles = Object.entries(recording.map.colours).map(([role, fill]) => {
      const dot = shape("svg", { width: 12, height: 12, "aria-hidden": "true" }, shape("circle", { cx: 6, cy: 6, r: SIZE, fill }));
      return el("span", {}, dot, ` ${role} `);
    });
    element.append(el("p", { class: "legend" }, ...roles), this.said, this.svg);
  },

  robot(name, role) {
    if (this.marks.has(name)) return;
    const colour = own(this.player.recording.map.colours, role.split(".")[0]) ?? "#98a2b3";
    const trail = this.trails.appendChild(shape("path", { class: "trail", stroke: colour }));
    const dot = shape("circle", { r: SIZE, fill: colour, stroke: colour });
    const title = shape("title");
    const mark = shape("g", { class: "robot", role: "button", ...press(() => this.player.select(name)) }, title, dot, shape("text", { x: SIZE + 2, y: 4 }, name));
    this.marks.set(name, { name, trail, mark, title, numbers: this.player.recording.ofRobot(name), points: 0 });
    this.robots.append(mark);
  },

  x(x) {
    return this.player.recording.map.left + x * this.player.recording.map.scale;
  },

  y(y) {
    return this.player.recording.map.bottom - y * this.player.recording.map.scale;
  },

  show(moment) {
    const past = historyOf(this.player.recording);
    const selected = this.player.selected === null ? [] : this.player.recording.selected(this.player.selected);
    let there = 0;
    for (const each of this.marks.values()) {
      const here = moment.members[each.numbers[0]];
      each.mark.classList.toggle("selected", each.numbers.some((number) => selected.includes(number)));
      if (!here?.place) {
        each.mark.setAttribute("visibility", "hidden");
        continue;
      }
      there += 1;
      const [x, y, z = 0] = here.place;
      each.mark.setAttribute("visibility", "visible");
      each.mark.setAttribute("transform", `translate(${this.x(x).toFixed(1)},${this.y(y).toFixed(1)})`);
      each.mark.classList.toggle("lost", !here.alive);
      const words = `${each.name}: (${x.toFixed(1)} m, ${y.toFixed(1)} m), ${z.toFixed(1)} m above ground${here.alive ? "" : ", lost"}`;
      write(each.title, words);
      this.trail(each, past.trails.get(each.name), moment.index);
    }
    const scene = this.targetsAt(past, moment.index);
    this.linksAt(past, moment, selected);
    this.seenAt(past, moment.index);
    write(this.said, `${there} robots${scene}`);
  },

  /** Show a trail until a line: the dash of its path is as long as the way until there. */
  trail(mark, trail, index) {
    if (!trail) return;
    if (mark.points !== trail.at.length) {
      mark.points = trail.at.length;
      mark.trail.setAttribute("d", `M${trail.x.map((x, at) => `${this.x(x).toFixed(1)},${this.y(trail.y[at]).toFixed(1)}`).join("L")}`);
    }
    const way = (trail.length[upTo(trail.at, index) - 1] ?? 0) * this.player.recording.map.scale;
    if (mark.way === way) return;
    mark.way = way;
    mark.trail.setAttribute("stroke-dasharray", `${way.toFixed(1)} 1000000`);
  },

  targetsAt({ targets }, index) {
    const at = upTo(targets.map((each) => each.at), index) - 1;
    const now = targets[at]?.targets ?? {};
    const found = Object.values(now).filter((each) => each[3]).length;
    const said = Object.keys(now).length ? `, ${found} of ${Object.keys(now).length} targets found` : "";
    if (this.shown.targets === now) return said;
    this.shown.targets = now;
    const marks = Object.entries(now).map(([name, [x, y, , isFound]]) => {
      const title = shape("title", {}, `${printable(name)}: ${isFound ? "found" : "not found"}`);
      return shape("path", { class: isFound ? "found" : "target", d: `M${this.x(x)},${this.y(y) - SIZE}l5,5l-5,5l-5,-5z` }, title);
    });
    this.targets.replaceChildren(...marks);
    return said;
  },

  linksAt({ links }, moment, selected) {
    const at = upTo(links.map((each) => each.at), moment.index) - 1;
    const place = (name) => moment.members[this.marks.get(name)?.numbers[0]]?.place;
    const pairs = links[at]?.pairs ?? [];
    // Those of all are too many to be seen apart.
    const shown = pairs.length > MOST_LINKS || selected.length ? pairs.filter((pair) => pair.some((name) => selected.includes(this.marks.get(name)?.numbers[0]))) : pairs;
    const lines = shown.flatMap(([one, other]) => {
      const ends = [place(one), place(other)];
      return ends.every(Boolean) ? [ends.map(([x, y]) => `${this.x(x).toFixed(1)},${this.y(y).toFixed(1)}`).join("L")] : [];
    });
    this.links.replaceChildren(shape("path", { class: "link", d: lines.map((each) => `M${each}`).join("") }));
  },

  seenAt({ seen }, index) {
    const count = upTo(seen.map((each) => each.at), index);
    if (this.shown.seen === count) return;
    this.shown.seen = count;
    const crosses = seen.slice(0, count).map(({ at, member, target, place: [x, y] }) => {
      const title = shape("title", {}, `${printable(member)} sees ${printable(target)} at ${clock(this.player.recording.time(at))}`);
      return shape("path", { class: "seen", d: `M${this.x(x) - 3.5},${this.y(y) - 3.5}l7,7m0,-7l-7,7` }, title);
    });
    this.seen.replaceChildren(...crosses);
  },
};
