// Lanes of two runs: they show the same time, and are scrolled, zoomed and scrubbed together.
import { el } from "./dom.js";
import { Lanes } from "./lanes.js";
import { Player } from "./player.js";

const room = ({ scroller }) => scroller.scrollHeight - scroller.clientHeight;

/** The value to which another has to go, as far as it can; null if it is there, or has moved this one. */
function led(value, end, other, otherEnd) {
  const now = Math.min(value, otherEnd);
  return now !== other && value !== Math.min(other, end) ? now : null;
}

/** Add the lanes of the run to compare with below others. */
export function addOther(element, mine) {
  const box = el("div", { class: "of-lanes" });
  element.append(box);
  const theirs = new Lanes(box, new Player(mine.recording.other), "the other run");
  for (const each of [mine, theirs]) each.range = each.to = Math.max(mine.end, theirs.end);
  theirs.player.on("moment", () => theirs.show(theirs.player.moment));
  for (const [one, other] of [[mine, theirs], [theirs, mine]]) {
    one.player.on("moment", () => {
      const time = led(one.player.time, one.recording.end, other.player.time, other.recording.end);
      if (time !== null) other.player.goTime(time);
    });
    one.player.on("selection", () => {
      if (other.player.selected !== one.player.selected) other.player.select(one.player.selected);
    });
    one.changed = () => {
      if (one.from !== other.from || one.to !== other.to) {
        [other.from, other.to] = [one.from, one.to];
        other.draw();
        other.show(other.player.moment);
      }
      const top = led(one.scroller.scrollTop, room(one), other.scroller.scrollTop, room(other));
      if (top !== null) other.scroller.scrollTop = top;
    };
    one.draw();
  }
}
