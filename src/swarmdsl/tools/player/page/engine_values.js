// Values of models: integers are BigInt, floats Number, messages objects without a prototype.
// Operators do what they do in the simulator, down to the last digit. An expression is a list, a
// word and its parts; it is compiled to closures, and text of a model is never code.

/** An operation without a result: the machine goes on with `error.execution`. */
export class Failure extends Error {}

const fail = (reason) => { throw new Failure(reason); };
const isWhole = (value) => typeof value === "bigint" || typeof value === "boolean";
const isMessage = (value) => value !== null && typeof value === "object" && !Array.isArray(value);

function mapped(value, change) {
  const made = Object.create(null);
  for (const key of Object.keys(value)) made[key] = change(value[key]);
  return made;
}

/** Values from marked JSON. */
export function decoded(value) {
  if (typeof value === "number") return BigInt(value);
  if (Array.isArray(value)) return value.map(decoded);
  if (!isMessage(value)) return value;
  if ("f" in value) return Number(value.f);
  return "i" in value ? BigInt(value.i) : mapped(value.m, decoded);
}

/** Values as marked JSON. */
export function encoded(value) {
  if (typeof value === "number") return { f: Number.isFinite(value) ? value : String(value) };
  if (typeof value === "bigint") {
    return value >= -(2n ** 53n) && value <= 2n ** 53n ? Number(value) : { i: String(value) };
  }
  if (Array.isArray(value)) return value.map(encoded);
  return isMessage(value) ? { m: mapped(value, encoded) } : value;
}

/** Values as in a trace: JSON with numbers of one kind. */
export function plain(value) {
  if (typeof value === "bigint") return Number(value);
  if (typeof value === "number" && !Number.isFinite(value)) return String(value);
  if (Array.isArray(value)) return value.map(plain);
  return isMessage(value) ? mapped(value, plain) : value;
}

export function copied(value) {
  if (Array.isArray(value)) return value.map(copied);
  return isMessage(value) ? mapped(value, copied) : value;
}

// ---- numbers

/** The float nearest to a fraction of integers; `rest` says that the numerator is a little more. */
function nearest(above, below, rest = false) {
  const sign = above < 0n !== below < 0n ? -1 : 1;
  let [up, down] = [above < 0n ? -above : above, below < 0n ? -below : below];
  const length = (n) => n.toString(16).length * 4;
  // About 70 binary digits of the quotient, and one that says that there are more.
  const shift = length(down) - length(up) + 72;
  up <<= BigInt(Math.max(shift, 0));
  down <<= BigInt(Math.max(-shift, 0));
  const quotient = up / down;
  const more = rest || quotient * down !== up;
  const found = Number((quotient << 1n) | (more ? 1n : 0n));
  return sign * scaled(found, -shift - 1);
}

function scaled(value, power) {
  // In two steps: a power of two alone may be too small for a float.
  const half = Math.trunc(power / 2);
  return value * 2 ** half * 2 ** (power - half);
}

/** A float as an integer and a power of two. */
function parts(value) {
  let power = 0;
  while (!Number.isInteger(value)) {
    value *= 2 ** 32;
    power -= 32;
  }
  return [BigInt(value), power];
}

function float(value) {
  if (typeof value === "number") return value;
  if (!isWhole(value)) throw new TypeError();
  const found = Number(value);
  return Number.isFinite(found) ? found : fail("the integer is too large for a float");
}

function root(value) {
  if (value < 2n) return value;
  let guess = 1n << BigInt(Math.ceil(value.toString(2).length / 2));
  for (;;) {
    const better = (guess + value / guess) >> 1n;
    if (better >= guess) return guess;
    guess = better;
  }
}

function hypot(...values) {
  const floats = values.map(float);
  if (floats.some((each) => Math.abs(each) === Infinity)) return Infinity;
  if (floats.some(Number.isNaN)) return NaN;
  const exact = floats.map(parts);
  const least = Math.min(0, ...exact.map(([, power]) => power));
  const sum = exact.reduce((found, [n, power]) => found + (n << BigInt(power - least)) ** 2n, 0n);
  if (sum === 0n) return 0;
  const wide = sum << 256n;
  const length = root(wide);
  return nearest(length, 1n << BigInt(128 - least), length * length !== wide);
}

/** A float as a whole number, by a way to round it. */
function whole(value, round) {
  if (isWhole(value)) return BigInt(value);
  if (typeof value !== "number") throw new TypeError();
  if (!Number.isFinite(value)) fail(`${value} is not a whole number`);
  return BigInt(round(value));
}

function halfToEven(value) {
  const low = Math.floor(value);
  const rest = value - low;
  return rest < 0.5 || (rest === 0.5 && low % 2 === 0) ? low : low + 1;
}

export const rounded = (value) => whole(value, halfToEven);
export const ceiled = (value) => whole(value, Math.ceil);

function arithmetic(integers, floats) {
  return (one, other) => {
    if (isWhole(one) && isWhole(other)) return integers(BigInt(one), BigInt(other));
    return floats(float(one), float(other));
  };
}

function remainder(one, other) {
  if (other === 0) fail("float modulo by zero");
  const rest = one % other;
  if (rest === 0) return other < 0 || Object.is(other, -0) ? -0 : 0;
  return rest < 0 !== other < 0 ? rest + other : rest;
}

function quotient(one, other) {
  if (other === 0) fail("float floor division by zero");
  const rest = one % other;
  let found = (one - rest) / other;
  if (rest !== 0 && rest < 0 !== other < 0) found -= 1;
  if (found === 0) return one / other < 0 || Object.is(one / other, -0) ? -0 : 0;
  const low = Math.floor(found);
  return found - low > 0.5 ? low + 1 : low;
}

function floored(one, other) {
  if (other === 0n) fail("integer division or modulo by zero");
  const rest = one % other;
  return rest !== 0n && rest < 0n !== other < 0n ? one / other - 1n : one / other;
}

function add(one, other) {
  if (typeof one === "string" && typeof other === "string") return one + other;
  if (Array.isArray(one) && Array.isArray(other)) return [...one, ...other];
  return sum(one, other);
}

const sum = arithmetic((a, b) => a + b, (a, b) => a + b);
const divided = arithmetic(
  (a, b) => {
    const found = b === 0n ? fail("division by zero") : nearest(a, b);
    return Number.isFinite(found) ? found : fail("the result is too large for a float");
  },
  (a, b) => (b === 0 ? fail("float division by zero") : a / b),
);

// ---- comparisons

function equal(one, other) {
  if (Array.isArray(one) && Array.isArray(other)) {
    return one.length === other.length && one.every((each, n) => equal(each, other[n]));
  }
  if (isMessage(one) && isMessage(other)) {
    const keys = Object.keys(one);
    if (keys.length !== Object.keys(other).length) return false;
    return keys.every((key) => key in other && equal(one[key], other[key]));
  }
  const numbers = ["bigint", "number", "boolean"];
  if (numbers.includes(typeof one) && numbers.includes(typeof other)) return one == other;
  return one === other;
}

function less(one, other) {
  if (typeof one === "string" && typeof other === "string") {
    const [mine, yours] = [[...one], [...other]];
    const at = mine.findIndex((each, n) => each !== yours[n]);
    if (at < 0 || at >= yours.length) return mine.length < yours.length && at < 0;
    return mine[at].codePointAt(0) < yours[at].codePointAt(0);
  }
  const numbers = ["bigint", "number", "boolean"];
  if (!numbers.includes(typeof one) || !numbers.includes(typeof other)) throw new TypeError();
  return one < other;
}

const least = (one, other) => (less(other, one) ? other : one);
const most = (one, other) => (less(one, other) ? other : one);

export function truth(value) {
  if (Array.isArray(value)) return value.length > 0;
  if (isMessage(value)) return Object.keys(value).length > 0;
  return Number.isNaN(value) || Boolean(value);
}

// ---- arrays

function checked(array, number) {
  if (number < 0n || number >= BigInt(array.length)) {
    fail(`there is no item ${number} in an array of ${array.length}`);
  }
  return Number(number);
}

const size = (value) => {
  if (typeof value === "string") return [...value].length;
  if (Array.isArray(value)) return value.length;
  if (isMessage(value)) return Object.keys(value).length;
  throw new TypeError();
};

const finite = (apply) => (value) => {
  const given = float(value);
  return Math.abs(given) === Infinity ? fail("math domain error") : apply(given);
};

const OPERATIONS = {
  "==": equal,
  "!=": (a, b) => !equal(a, b),
  "<": less,
  "<=": (a, b) => less(a, b) || equal(a, b),
  ">": (a, b) => less(b, a),
  ">=": (a, b) => less(b, a) || equal(a, b),
  "+": add,
  "-": arithmetic((a, b) => a - b, (a, b) => a - b),
  "*": arithmetic((a, b) => a * b, (a, b) => a * b),
  "/": divided,
  "%": arithmetic((a, b) => a - floored(a, b) * b, remainder),
  div: arithmetic(floored, quotient),
  negative: (a) => (isWhole(a) ? -BigInt(a) : -float(a)),
  min: (...values) => values.reduce(least),
  max: (...values) => values.reduce(most),
  abs: (a) => (isWhole(a) ? (a < 0n ? -a : BigInt(a)) : Math.abs(float(a))),
  sqrt: (a) => (float(a) < 0 ? fail("math domain error") : Math.sqrt(float(a))),
  len: (a) => BigInt(size(a)),
  contains: (a, b) => {
    if (typeof a === "string" && typeof b === "string") return a.includes(b);
    if (!Array.isArray(a)) throw new TypeError();
    return a.some((each) => equal(each, b));
  },
  int: (a) => whole(a, Math.trunc),
  float,
  round: rounded,
  floor: (a) => whole(a, Math.floor),
  ceil: ceiled,
  clamp: (a, low, high) => least(most(a, low), high),
  hypot,
  seconds: (a) => divided(a, 1000000000n),
  sin: finite(Math.sin),
  cos: finite(Math.cos),
  atan2: (a, b) => Math.atan2(float(a) + 0, float(b) + 0),
  distance: (...all) => {
    const half = all.length / 2;
    return hypot(...all.slice(0, half).map((each, n) => OPERATIONS["-"](each, all[half + n])));
  },
  item: (array, number) => array[checked(array, number)],
  append: (array, value, limit) => {
    if (BigInt(array.length) >= limit) fail(`the array is full: it has ${array.length} items`);
    return [...array, value];
  },
  remove: (array, number) => array.toSpliced(checked(array, number), 1),
  replace: (array, number, value) => array.with(checked(array, number), value),
};

/** An integer or string, if it is in the range of a type. */
export function bounded(value, type) {
  if (typeof value === "string") {
    const length = size(value);
    return length > 1000000 ? fail(`a string of ${length} characters is too long`) : value;
  }
  if (!isWhole(value)) return value;
  const bits = BigInt(type.replace(/\D/g, ""));
  const [low, end] = type.startsWith("u") ? [0n, 1n << bits] : [-(1n << (bits - 1n)), 1n << (bits - 1n)];
  return value < low || value >= end ? fail(`${value} is out of range of ${type}`) : value;
}

export function field(held, name) {
  if (!isMessage(held) || !(name in held)) fail(`there is no field \`${name}\``);
  return held[name];
}

// ---- expressions

/** Convert errors of types: fields of an unknown message type can have any value. */
function guarded(word, operation) {
  return (...given) => {
    try {
      return operation(...given);
    } catch (error) {
      if (!(error instanceof TypeError)) throw error;
      return fail(`\`${word}\` is not defined for a value in the message`);
    }
  };
}

/** Compile an expression to a function of an instance, an event and the items of queries. */
export function compiled(tree) {
  const [word, ...rest] = tree;
  switch (word) {
    case "value": {
      const value = decoded(rest[0]);
      return () => value;
    }
    case "variable": return (instance) => instance.data[rest[0]];
    case "self": return (instance) => instance.data.self[rest[0]];
    case "data": return (instance, event) => event.data;
    case "envelope": return (instance, event) => event.envelope[rest[0]];
    case "in": return (instance) => instance.isActive(rest[0]);
    case "elapsed": return (instance) => instance.elapsed(rest[0]);
    case "present": return (instance) => instance.world.present(instance, rest[0]);
    case "list": return () => [];
    case "item of": return (instance, event, items) => items.get(rest[0]);
    case "query": return query(...rest);
    case "field": {
      const base = compiled(rest[0]);
      return (...given) => field(base(...given), rest[1]);
    }
    case "message": {
      const [blank, fields] = [decoded(rest[0]), rest[1].map(([name, of]) => [name, compiled(of)])];
      return (...given) => {
        const made = copied(blank);
        for (const [name, value] of fields) made[name] = value(...given);
        return made;
      };
    }
    case "bounded": {
      const value = compiled(rest[0]);
      return (...given) => bounded(value(...given), rest[1]);
    }
  }
  const values = rest.map(compiled);
  const [left, right] = values;
  switch (word) {
    case "and": return (...given) => { const held = left(...given); return truth(held) ? right(...given) : held; };
    case "or": return (...given) => { const held = left(...given); return truth(held) ? held : right(...given); };
    case "not": return (...given) => !truth(left(...given));
    case "copy": return (...given) => copied(left(...given));
    case "neighbors": return (instance) => instance.world.neighbors(instance);
  }
  const operation = OPERATIONS[word];
  return guarded(word, (...given) => operation(...values.map((value) => value(...given))));
}

function query(word, name, arrayTree, conditionTree, keyTree) {
  const array = compiled(arrayTree);
  const holds = conditionTree ? compiled(conditionTree) : () => true;
  const key = keyTree ? compiled(keyTree) : null;
  const at = (of, item, [instance, event, items]) => of(instance, event, new Map(items).set(name, item));
  return guarded(word, (...given) => {
    const items = array(...given);
    const held = (item) => truth(at(holds, item, given));
    if (word === "any") return items.some(held);
    if (word === "all") return items.every(held);
    const found = items.filter(held);
    if (word === "count") return BigInt(found.length);
    if (!found.length) fail(`\`${word}\` of no items`);
    const keys = key ? found.map((item) => at(key, item, given)) : found;
    let best = 0;
    for (let n = 1; n < keys.length; n++) {
      if (word === "min" ? less(keys[n], keys[best]) : less(keys[best], keys[n])) best = n;
    }
    return found[best];
  });
}
