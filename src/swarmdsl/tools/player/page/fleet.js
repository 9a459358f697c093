// The fleet: who is there, and buttons for the events that a person may send.
import { clock, el, printable } from "./dom.js";

const WORDS = { there: "there", lost: "lost", ended: "ended", expected: "not seen yet" };

export const view = {
  id: "fleet",
  title: "Fleet",

  available: (recording) => Boolean(recording.fleet),

  mount(element, player) {
    this.player = player;
    this.alarms = el("ul", { class: "alarms", role: "alert", "aria-label": "Alarms" });
    this.verdicts = el("p", { class: "said" });
    const heads = ["robot", "", "battery", "states", "last event", "model"].map((each) => el("th", { scope: "col" }, each));
    this.rows = el("tbody", {});
    element.append(this.alarms, el("table", {}, el("thead", {}, el("tr", {}, ...heads)), this.rows), this.verdicts);
  },

  show() {
    const { now } = this.player.recording.fleet;
    if (this.shown === now) return;
    this.shown = now;
    this.alarms.replaceChildren(...now.alarms.map((each) => el("li", {}, each)));
    this.rows.replaceChildren(...now.robots.map((each) => this.row(each)));
    const verdicts = Object.entries(now.verdicts).map(([name, verdict]) => `${name}: ${verdict}`);
    const sent = now.sent.map(({ event, heard }) => `${event} (${heard})`);
    const told = [["verdicts", verdicts], ["sent by persons", sent]].filter(([, each]) => each.length);
    this.verdicts.textContent = printable(told.map(([word, each]) => `${word}: ${each.join(", ")}`).join("; "));
  },

  row({ robot, status, machines, battery, models }) {
    const states = machines.map(({ member, states }) => el("div", { title: member }, states.join(", ")));
    const events = machines.map((each) => el("div", {}, `${clock(each.t * 1e6)} ${each.event} `, ...this.link(each.member)));
    return el(
      "tr",
      { class: status, "data-robot": robot },
      el("th", { scope: "row" }, robot),
      el("td", { class: "status" }, WORDS[status] ?? status),
      el("td", {}, battery === null ? "" : `${Math.round(battery * 100)} %`),
      el("td", {}, ...states),
      el("td", {}, ...events),
      el("td", {}, models.join(", ")),
    );
  },

  /** A button to the line of the model that the member has taken last. */
  link(member) {
    const { recording } = this.player;
    const number = recording.number(member);
    const { line } = number < 0 ? { line: -1 } : recording.moment(recording.count - 1).members[number];
    const places = recording.machines[recording.members[number]?.machine]?.places ?? {};
    const place = (recording.step(line)?.taken ?? []).map((each) => places[each]).find(Boolean);
    if (!place) return [];
    const open = () => {
      this.player.select(member);
      this.player.go(line);
      location.hash = `#m=${encodeURIComponent(member)}&v=fleet,text`;
    };
    return [el("button", { type: "button", title: "show it in the model", onclick: open }, `${place[0].split(/[\\/]/).at(-1)}:${place[1]}`)];
  },
};

/** Add the buttons, those that abort first; what becomes of an event is told beside them. */
export function operate({ recording }) {
  const { events, refused } = recording.fleet;
  const said = el("span", { role: "status" });
  const send = async ({ name }, fields) => {
    said.textContent = `${name} ...`;
    try {
      const data = fields ? JSON.parse(fields.value) : {};
      const body = JSON.stringify({ event: name, data });
      const answer = await fetch("send", { method: "POST", headers: { "Content-Type": "application/json" }, body });
      const { heard, lost, failed } = await answer.json();
      const but = lost?.length ? `; lost: ${lost.join(", ")}` : "";
      const words = failed ?? `sent to ${heard} node${heard === 1 ? "" : "s"}${but}`;
      said.textContent = printable(`${name}: ${words}`);
    } catch (error) {
      said.textContent = printable(`${name} is not sent: ${error.message}`);
    }
  };
  const buttons = events.flatMap((each) => {
    const has = Object.keys(each.blank).length;
    const fields = has ? el("input", { value: JSON.stringify(each.blank), "aria-label": `message of ${each.name}` }) : null;
    const button = el("button", { type: "button", class: each.urgent ? "urgent" : null, title: each.doc || each.name, disabled: Boolean(refused), onclick: () => send(each, fields) }, each.name);
    return fields ? [button, fields] : [button];
  });
  if (refused) said.textContent = printable(refused);
  else if (!buttons.length) said.textContent = "The model declares no swarm operator event.";
  const element = el("div", { id: "operate", role: "group", "aria-label": "events to send" }, ...buttons, said);
  document.getElementById("main").before(element);
}
