// Player: the moment that all views show, and the ways to another one.
import { printable } from "./dom.js";

/** Kinds of steps by name: what a line must be, given the recording, its number and the selected members. */
export const STEPS = {
  macrostep: (recording, at) => recording.step(at).configuration !== undefined,
  member: (recording, at, chosen) =>
    recording.step(at).configuration !== undefined && (!chosen.length || chosen.includes(recording.memberAt(at))),
  send: (recording, at) => recording.step(at).sent?.length > 0,
  loss: (recording, at) => recording.step(at).lost !== undefined,
  fault: (recording, at) => recording.step(at).event?.startsWith("fault.") === true,
  violation: (recording, at) => recording.step(at).verdict === "false",
};

export class Player {
  #heard = { moment: [], selection: [], playing: [], bookmarks: [] };
  #last = 0;
  #frame = 0;
  #shown = null;

  constructor(recording) {
    this.recording = recording;
    this.index = -1;
    this.time = 0; // between two lines, too
    this.selected = null; // name of a member or of a role
    this.bookmarks = []; // times in nanoseconds
    this.speed = 1;
    this.playing = false;
  }

  /** Call a function with the player at each `moment`, `selection`, `playing` or `bookmarks`. */
  on(name, heard) {
    this.#heard[name].push(heard);
  }

  get moment() {
    if (this.#shown?.index !== this.index) this.#shown = this.recording.moment(this.index);
    return this.#shown;
  }

  /** Go to the moment after a line. */
  go(index) {
    const at = Math.max(0, Math.min(index, this.recording.count - 1));
    this.#move(at, this.recording.time(at));
  }

  /** Go to a time. */
  goTime(time) {
    const within = Math.max(0, Math.min(time, this.recording.end));
    this.#move(this.recording.at(within), within);
  }

  /** Go to the next line of a kind, or to the one before; return false if there is none. */
  step(kind, direction = 1) {
    const { recording } = this;
    const chosen = this.selected === null ? [] : recording.selected(this.selected);
    for (let at = this.index + direction; at >= 0 && at < recording.count; at += direction)
      if (STEPS[kind](recording, at, chosen)) {
        this.go(at);
        return true;
      }
    return false;
  }

  select(name) {
    this.selected = name;
    this.#tell("selection");
  }

  /** Set a bookmark at this moment, or remove the one that is there. */
  bookmark() {
    const others = this.bookmarks.filter((each) => each !== this.time);
    this.bookmarks = others.length < this.bookmarks.length ? others : [...others, this.time].sort((a, b) => a - b);
    this.#tell("bookmarks");
  }

  /** Go to the next bookmark, or to the one before; return false if there is none. */
  goBookmark(direction) {
    const ahead = this.bookmarks.filter((each) => (each - this.time) * direction > 0);
    const to = direction > 0 ? ahead[0] : ahead.at(-1);
    if (to !== undefined) this.goTime(to);
    return to !== undefined;
  }

  play(playing = !this.playing) {
    this.playing = playing && this.recording.count > 0;
    if (this.playing && this.time >= this.recording.end) this.goTime(0);
    cancelAnimationFrame(this.#frame);
    this.#last = performance.now();
    if (this.playing) this.#frame = requestAnimationFrame((now) => this.#run(now));
    this.#tell("playing");
  }

  /** The last step in words: member, event and its states; or a lost event, or a verdict. */
  said() {
    let at = this.index;
    const tells = ({ configuration, lost, property }) => configuration ?? lost ?? property;
    while (at >= 0 && tells(this.recording.step(at)) === undefined) at--;
    if (at < 0) return "nothing has happened yet";
    const line = this.recording.line(at);
    if (line.lost) return printable(`${line.lost.event} from ${line.lost.sender} to ${line.lost.member} is lost`);
    if (line.property !== undefined) return printable(`property ${line.property}: ${line.verdict}`);
    const fate = line.ignored ? " (ignored)" : line.deferred ? " (deferred)" : line.recalled ? " (recalled)" : "";
    const moved = line.entered?.length || line.exited?.length ? ` \u2192 ${line.configuration.join(", ")}` : "";
    const sent = line.sent?.length ? `; sends ${line.sent.join(", ")}` : "";
    return printable(`${line.member}: ${line.event ?? "start"}${fate}${moved}${sent}`);
  }

  #run(now) {
    const time = this.time + (now - this.#last) * 1e6 * this.speed;
    this.#last = now;
    this.goTime(time);
    if (time >= this.recording.end) this.play(false);
    else if (this.playing) this.#frame = requestAnimationFrame((next) => this.#run(next));
  }

  #move(index, time) {
    if (index === this.index && time === this.time) return;
    this.index = index;
    this.time = time;
    this.#tell("moment");
  }

  #tell(name) {
    for (const each of this.#heard[name]) each(this);
  }
}
