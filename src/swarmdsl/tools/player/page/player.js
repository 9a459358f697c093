// Player: the moment that all views show, and the ways to another one.
import { isTold, words } from "./words.js";

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
  #heard = { moment: [], selection: [], playing: [], bookmarks: [], growth: [] };
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

  /** Call a function with the player at each `moment`, `selection`, `playing`, `bookmarks` or `growth`. */
  on(name, heard) {
    this.#heard[name].push(heard);
  }

  get moment() {
    if (this.#shown?.index !== this.index) this.#shown = this.recording.moment(this.index);
    return this.#shown;
  }

  /** Numbers of the chosen members; all if none is chosen. */
  get numbers() {
    const { members } = this.recording;
    return this.selected === null ? [...members.keys()] : this.recording.selected(this.selected);
  }

  /** The last line of the chosen members, or -1. */
  get last() {
    return this.numbers.reduce((last, each) => Math.max(last, this.moment.members[each]?.line ?? -1), -1);
  }

  /** Go to the moment after a line. */
  go(index) {
    const at = Math.min(Math.max(0, index), this.recording.count - 1); // -1 without lines
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

  /** Take in what `add` adds to the recording; the moment stays at the end, if it is there. */
  grow(add) {
    const isLast = this.time >= this.recording.end;
    add(this.recording);
    this.#shown = null; // there may be more members
    if (isLast) this.goTime(this.recording.end);
    this.#tell("growth");
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

  /** The last line in words that says something. */
  said() {
    let at = this.index;
    while (at >= 0 && !isTold(this.recording.step(at))) at--;
    return at < 0 ? "nothing has happened yet" : words(this.recording, at);
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
