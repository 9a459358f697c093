// Stays in states: what the lanes draw, found once for all zooms.

/** For each member its stays: lines at which its states change, their times, and when it was heard last; or those found before with more lines. */
export function staysOf(recording, found = [], from = 0) {
  while (found.length < recording.members.length) found.push({ times: [], states: [], lines: [], rows: 1, heard: 0 });
  for (let at = from; at < recording.count; at++) {
    const step = recording.step(at);
    const member = recording.memberAt(at);
    if (!step.configuration || member < 0) continue;
    const stays = found[member];
    stays.heard = recording.time(at);
    const states = step.event === recording.lost ? null : step.configuration;
    const before = stays.states.at(-1);
    if (stays.times.length && (before === states || before?.join() === states?.join())) continue;
    stays.times.push(recording.time(at));
    stays.states.push(states);
    stays.lines.push(at);
    stays.rows = Math.max(stays.rows, states?.length ?? 1);
  }
  return found;
}

const FATES = ["taken", "ignored", "deferred", "lost", "nobody"];

/**
 * Swarm events that are on their way between two times, those of one sender at nearly one time together:
 * [{event, from, sent, count, to: [{member, received, fate}]}]. `near` is that distance in nanoseconds.
 */
export function bundles(messages, from, to, near) {
  const found = new Map();
  const events = new Map();
  for (const each of messages) {
    if (each.received < from || each.sent > to) continue;
    if (!events.has(each.event)) events.set(each.event, events.size);
    // One number, because there may be a million of them.
    const key = (Math.floor((each.sent - from) / near) * 65536 + each.from + 1) * 1024 + events.get(each.event);
    let bundle = found.get(key);
    if (!bundle) found.set(key, (bundle = { event: each.event, from: each.from, sent: each.sent, to: new Map(), count: 0 }));
    bundle.count += 1;
    const target = (each.to + 1) * FATES.length + FATES.indexOf(each.fate);
    if (!bundle.to.has(target)) bundle.to.set(target, { member: each.to, received: each.received, fate: each.fate });
  }
  return [...found.values()].map((each) => ({ ...each, to: [...each.to.values()] }));
}
