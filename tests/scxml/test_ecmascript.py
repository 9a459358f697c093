"""Expressions of documents have the values that they have in ECMAScript."""

from __future__ import annotations

import json
import math
import shutil
import subprocess
from typing import Any

import pytest
from hypothesis import assume, given, settings

from swarmdsl.execution.engine import Event, ExecutionError, Instance, Machine, State
from swarmdsl.execution.scxml.ecmascript import Unreadable, read
from swarmdsl.execution.scxml.values import text as text_of
from swarmdsl.ir.expression_printer import translate

from ..engine.world import StillWorld
from ..exchange.test_expressions import ECMASCRIPT, EXPRESSIONS, defined_value

QUICK = settings(max_examples=200)
DATA: dict[str, Any] = {
    "n": 3,
    "x": -2.5,
    "s": "ab",
    "t": True,
    "l": [1, "two", [3]],
    "o": {"a": {"b": 4}, "list": [5, 6]},
    "nothing": None,
}
WRITTEN = """
1 + 2 * 3 - 4 / 8  (1 + 2) * 3  7 % 3  -7 % 3  7 % -3  5.5 % 2  1 / 0  -1 / 0  0 / 0  1 / 3
Infinity % 2
0x1F  .5 + 1.  1e3  1e21  2 - -1  - - 1  +"12"  +"x"  "a" + 1  1 + "a"  1 + 1 + "a"  "a" + 1 + 1
"a" + 1.0  "a" + 0.5  "a" + true  "a" + l  1 + true  true + true  "3" * "4"  "3" - 1  1 < 2
"a" < "b"  "10" < "9"  10 < "9"  "b" > 1  2 >= 2  1 == "1"  1 === "1"  1 == true  "" == 0
null == 0  null == undefined  null === null  NaN == NaN  NaN != NaN  "a" == "a"  "a" !== "b"
l == l  !0  !""  !"a"  !l  !NaN  !o  0 || "a"  1 || "a"  0 && "a"  1 && "a"  "" || 0
1 && 2 && 3  0 || 1 && 0  !1 == 2  1 < 2 == true  n > 2 ? "y" : "n"  t ? x : n  n ? t ? 1 : 2 : 3
l[1]  l[2][0]  l.length  s.length  s[1]  o.a.b  o["a"]["b"]  o.list[1]  o.nothing  l[9]  s[9]
{a: 1, "b": [2]}.b[0]  [1, 2, 3].length  [].length  typeof n  typeof "a"  typeof t  typeof o
typeof undefined  typeof unknown  nothing  Math.max(1, n)  Math.min()  Math.max(n, "7")  Math.abs(x)
Math.ceil(x)  Math.floor(x)  Math.round(x)  Math.round(2.5)  Math.trunc(x)  Math.sqrt(16)
5 & 3  5 | 3  5 ^ 3  ~5  1 << 3  1 << 31  -8 >> 1  -8 >>> 28  1 | 2 == 2  6 & 3 ^ 1 | 8  1 + 1 << 2
-1 >>> 0  1e10 | 0  "7" & 3  NaN | 0  l & 1  1 << 33  2.9 | 0  -2.9 | 0  1 < 2 << 1
"a" in o  "b" in o  0 in l  3 in l  "length" in l  "x" in {x: undefined}  !("a" in o)
[].concat(l, [4], 5)  l.concat()  "a".concat(1, true)  l.indexOf("two")  l.indexOf(2)
s.indexOf("b")  s.indexOf("x")  l.join()  l.join("-")  [[1, 2], [3]].join(";")
"\U0001f916a".length  "".length
[1, 2].concat([3]).length  1 /* one */ + 2  1 + 2 // three
[1] == 1  [1, 2] == "1,2"  [2] > 1  [1] + 1  o + ""  [1, [2]] * 1
[7] * 2  "10" < [9]  -[3]  "" + [1, [2, "x"], []]  o == "[object Object]"  [1] == [1]
Math.floor(Infinity)  Math.ceil(-Infinity)  Math.sqrt(-Infinity)  Math.abs(-Infinity)
Math.round("x")  Math.pow(1, NaN)  Math.pow(NaN, 0)  Math.pow(0, -2.5)  Math.pow(-8, 1 / 3)
Math.pow(-1, Infinity)  Math.pow(4294967295, 4294967295)  Math.pow(-10, 401)  Math.pow(-10, 402)
Math.pow(0, -1)
Math.sqrt(-1)  Math.pow(2, 10)  Math.pow(2, 0.5)  Math.max(n, NaN)
JSON.parse(JSON.stringify(o)).a.b  (function (a, b) { return a - b; })(n, 1)
(function (a) { return (function (b) { return a + b; })(2); })(1)  "\\u0041\\x42\\n\\t\\\\'"
'it\\'s "so"'  "a" + [1, [2, 3]]  9007199254740993  9007199254740992 + 1  1e308 * 10
+"0x1F"  +"-0x1F"  +"1_0"  +"inf"  +"nan"  +"-Infinity"  +" +1.5e3 "
+"1e"  +".5"  +"5."  +"."  +"\u0661"
100000 * 1000000000000000000  2 * 2 * 2.5  1 / 3e6  0.000001  1 / 3e7  1.5e300  "" + -0  1 - 1 + ""
"""
TEXTS = [
    text.strip()
    for line in WRITTEN.strip().splitlines()
    for text in line.split("  ")
    if text.strip()
]


def value(text: str, data: dict[str, Any] | None = None) -> Any:
    instance = Instance(
        Machine("m", [State("a")]), StillWorld(), data=DATA if data is None else data
    )
    return read(text)(instance, Event("e", {"level": 3}), {})


def told(found: Any) -> str:
    """A value as JSON, as JavaScript writes it; numbers that JSON does not have by name."""
    if isinstance(found, float):
        return text_of(found)
    return json.dumps(found, separators=(",", ":"))


def test_values_are_those_of_node() -> None:
    node = shutil.which("node")
    if node is None:
        pytest.skip("no Node: apt-get install nodejs")
    script = """
        const [data, texts] = JSON.parse(require("fs").readFileSync(0, "utf8"));
        Object.assign(globalThis, data);
        const told = (v) => typeof v === "number" && !isFinite(v) ? String(v)
                          : JSON.stringify(v === undefined ? null : v);
        console.log(JSON.stringify(texts.map((text) => told((0, eval)("(" + text + "\\n)")))));
    """
    run = subprocess.run(
        [node, "-e", script],
        input=json.dumps([DATA, TEXTS]),
        capture_output=True,
        text=True,
        check=True,
    )
    expected = dict(zip(TEXTS, json.loads(run.stdout), strict=True))

    assert {text: told(value(text)) for text in TEXTS} == expected


@QUICK
@given(EXPRESSIONS)
def test_what_is_written_for_a_model_has_the_value_of_the_language(expression: Any) -> None:
    expected = defined_value(expression)
    assume(not isinstance(expected, float) or math.isfinite(expected))
    assume(abs(expected) < 2**53)

    assert value(translate(expression, ECMASCRIPT), {}) == expected


@pytest.mark.parametrize(
    "text",
    [
        *("", "1 +", "a b", "a = 1", "f(1)", "new Date()", "Math.random()", "JSON.stringify(1)"),
        *("_event.raw", "function (a) { return a; }", "(function (a) { return a; })()"),
        *("1 ? 2", "a.constructor()", "`a`", "1++", "-" * 200 + "1", "'a", "import('x')"),
        *("o.__proto__.x()", "a = b", "a, b", "l.push(1)", "Math.PI", "this", "Date", "2--1"),
        *("a /* b", "1 in", "++1", "a instanceof Array", "Math.abs(1, 2)", "Math.pow(1)"),
        *("l.join(1, 2)", "l.indexOf(1, 2)"),
    ],
)
def test_what_is_not_understood(text: str) -> None:
    with pytest.raises(Unreadable):
        read(text)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("unknown", "`unknown` is not defined"),
        ("nothing.x", "undefined has no `x`"),
        ("o.x.y", "undefined has no `y`"),
        ("'a' in s", "`in` needs an object or list, not `ab`"),
        ("n.concat(1)", "`3` has no function `concat`"),
        ("o.join()", "`.object Object.` has no function `join`"),
        ("s.join()", "`ab` has no function `join`"),
        ("++unknown", "`unknown` is not defined"),
    ],
)
def test_what_throws(text: str, message: str) -> None:
    with pytest.raises(ExecutionError, match=message):
        value(text)


def test_members_are_those_of_the_data_alone() -> None:
    """Nothing of Python shines through."""
    assert value("s.__class__") is None
    assert value("o.keys") is None
    assert value("l.append") is None
    assert value("_event.data.level") == 3
    assert value("_event.name") == "e"


def test_texts_do_not_grow_beyond_all_bounds() -> None:
    with pytest.raises(ExecutionError, match="too long"):
        value("s + s", {"s": "x" * 600_000})


def test_lists_do_not_grow_beyond_all_bounds() -> None:
    deep: Any = []
    for _ in range(60):
        deep = [deep, deep]
    endless: list[Any] = []
    endless.append(endless)
    data = {"many": [0] * 600_000, "deep": deep, "endless": endless}
    for text in ("many.concat(many)", "'' + deep", "'' + endless", "deep.join('')"):
        with pytest.raises(ExecutionError, match=r"too long|too deeply"):
            value(text, data)
    with pytest.raises(ExecutionError, match="too large"):
        value("JSON.parse(JSON.stringify(endless))", data)


@pytest.mark.parametrize(
    ("text", "result", "left"),
    [("++n", 4, 4), ("n++", 3, 4), ("--n", 2, 2), ("n--", 3, 2), ("++o.x + n", 5, 3)],
)
def test_steps(text: str, result: int, left: int) -> None:
    data = {"n": 3, "o": {"x": 1}}

    assert (value(text, data), data["n"]) == (result, left)


def test_what_no_state_or_number_is() -> None:
    assert value("In([1])") is False
    assert value("In({})") is False
    assert value("0x" + "f" * 50_000) == math.inf
    assert value("-'0x" + "f" * 50_000 + "'") == -math.inf


def test_a_copy_is_a_copy() -> None:
    assert value("JSON.parse(JSON.stringify(o))") is not DATA["o"]
    assert value("o") is DATA["o"]
