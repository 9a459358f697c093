// Virtual time, and the random numbers of a run: those of the simulator, by their questions.
import { rounded } from "./engine_values.js";

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
    if (alarm.due > this.now) this.now = alarm.due;
    alarm.action();
    return true;
  }
}

// ---- random numbers: SHA-256 of the question seeds a Mersenne Twister

const PRIMES = [];
for (let n = 2; PRIMES.length < 64; n++) if (PRIMES.every((prime) => n % prime)) PRIMES.push(n);
const fraction = (x) => Math.floor((x % 1) * 2 ** 32) >>> 0;
const K = PRIMES.map((prime) => fraction(Math.cbrt(prime)));
const turned = (x, by) => (x >>> by) | (x << (32 - by));

/** The words of a hash of a text, the first one first. */
export function sha256(text) {
  const bytes = new TextEncoder().encode(text);
  const blocks = new Uint8Array(((bytes.length + 72) >> 6) << 6);
  blocks.set(bytes);
  blocks[bytes.length] = 0x80;
  const view = new DataView(blocks.buffer);
  view.setUint32(blocks.length - 4, bytes.length * 8);
  const hash = PRIMES.slice(0, 8).map((prime) => fraction(Math.sqrt(prime)));
  const w = new Uint32Array(64);
  for (let at = 0; at < blocks.length; at += 64) {
    for (let n = 0; n < 64; n++) {
      if (n < 16) {
        w[n] = view.getUint32(at + 4 * n);
        continue;
      }
      const [x, y] = [w[n - 15], w[n - 2]];
      const one = turned(x, 7) ^ turned(x, 18) ^ (x >>> 3);
      w[n] = w[n - 16] + one + w[n - 7] + (turned(y, 17) ^ turned(y, 19) ^ (y >>> 10));
    }
    let [a, b, c, d, e, f, g, h] = hash;
    for (let n = 0; n < 64; n++) {
      const one = (h + (turned(e, 6) ^ turned(e, 11) ^ turned(e, 25)) + ((e & f) ^ (~e & g)) + K[n] + w[n]) | 0;
      const two = ((turned(a, 2) ^ turned(a, 13) ^ turned(a, 22)) + ((a & b) ^ (a & c) ^ (b & c))) | 0;
      [a, b, c, d, e, f, g, h] = [(one + two) | 0, a, b, c, (d + one) | 0, e, f, g];
    }
    [a, b, c, d, e, f, g, h].forEach((each, n) => { hash[n] = (hash[n] + each) >>> 0; });
  }
  return hash;
}

/** The random numbers of a question: the same as in Python. */
export class Stream {
  constructor(seed, ...words) {
    const key = sha256([seed, ...words].join("\0")).reverse();
    while (key.length > 1 && key.at(-1) === 0) key.pop();
    const state = new Uint32Array(624);
    state[0] = 19650218;
    const mixed = (n, by) => Math.imul(state[n - 1] ^ (state[n - 1] >>> 30), by);
    for (let n = 1; n < 624; n++) state[n] = mixed(n, 1812433253) + n;
    let [n, at] = [1, 0];
    const next = () => {
      if (++n >= 624) {
        state[0] = state[623];
        n = 1;
      }
    };
    for (let left = 624; left; left--) {
      state[n] = (state[n] ^ mixed(n, 1664525)) + key[at] + at;
      at = (at + 1) % key.length;
      next();
    }
    for (let left = 623; left; left--) {
      state[n] = (state[n] ^ mixed(n, 1566083941)) - n;
      next();
    }
    state[0] = 0x80000000;
    Object.assign(this, { state, at: 624 });
  }

  word() {
    const { state } = this;
    if (this.at === 624) {
      for (let n = 0; n < 624; n++) {
        const y = (state[n] & 0x80000000) | (state[(n + 1) % 624] & 0x7fffffff);
        state[n] = state[(n + 397) % 624] ^ (y >>> 1) ^ (y & 1 ? 0x9908b0df : 0);
      }
      this.at = 0;
    }
    let y = state[this.at++];
    y ^= y >>> 11;
    y ^= (y << 7) & 0x9d2c5680;
    y ^= (y << 15) & 0xefc60000;
    return (y ^ (y >>> 18)) >>> 0;
  }

  random() {
    const [high, low] = [this.word() >>> 5, this.word() >>> 6];
    return (high * 67108864 + low) / 9007199254740992;
  }
}

const MILLISECOND = 1000000n;

/** Draw a length of time. */
export function drawn([kind, one, other], stream) {
  if (kind === "fixed") return BigInt(one);
  let length = one + (other - one) * (kind === "uniform" ? stream.random() : 0);
  if (kind === "normal") {
    // The sum of numbers with 53 digits after the point, rounded once.
    let sum = 0n;
    for (let n = 0; n < 12; n++) sum += BigInt(stream.random() * 2 ** 53);
    length = one + other * (Number(sum) / 2 ** 53 - 6);
  }
  const found = rounded(length / 1e6);
  return found > 0n ? found * MILLISECOND : 0n;
}
