// Virtual time, and the random numbers of a run: those of the simulator, by their questions.

/** Alarms in the order of time, and of scheduling at the same time. */
export class Clock {
  constructor() {
    Object.assign(this, { now: 0n, count: 0, alarms: [] });
  }

  schedule(delay, action) {
    const alarm = { due: this.now + (delay > 0n ? delay : 0n), number: this.count++, action };
    this.insert(alarm);
    return alarm;
  }

  insert(alarm) {
    let [low, high] = [0, this.alarms.length];
    while (low < high) {
      const middle = (low + high) >> 1;
      const other = this.alarms[middle];
      if (other.due < alarm.due || (other.due === alarm.due && other.number < alarm.number)) low = middle + 1;
      else high = middle;
    }
    this.alarms.splice(low, 0, alarm);
  }

  unschedule(alarm) {
    alarm.action = null;
  }

  /** The time of the next action, or null. */
  get next() {
    while (this.alarms.length && !this.alarms[0].action) this.alarms.shift();
    return this.alarms.length ? this.alarms[0].due : null;
  }

  step() {
    if (this.next === null) return false;
    const alarm = this.alarms.shift();
    this.now = alarm.due;
    alarm.action();
    return true;
  }

  advance(end) {
    while (this.next !== null && this.next <= end) this.step();
    if (end > this.now) this.now = end;
  }
}
