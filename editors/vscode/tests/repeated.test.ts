// Tests of diagnostics that a checker of schemas has too.

import assert from "node:assert/strict";
import { test } from "node:test";

import { withoutRepeated } from "../src/repeated.ts";

const at = (line: number, code: unknown, source = "swarmc") => ({ source, code, range: { start: { line } } });

test("what another extension reports at a line is not repeated", () => {
  const key = at(1, { value: "SW0012" });
  const name = at(1, "SW0202");
  const value = at(3, "SW1003");
  const schema = at(1, undefined, "Even Better TOML");
  assert.deepEqual(withoutRepeated([key, name, value], [key, name, value]), [key, name, value]);
  assert.deepEqual(withoutRepeated([key, name, value], [key, schema]), [name, value]);
});
