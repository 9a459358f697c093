"""Operators of the page have the values that they have in Python, to the last digit."""

from __future__ import annotations

import json
import math
import random
from itertools import product
from pathlib import Path
from typing import Any

from swarmdsl.execution.engine import ExecutionError, bounded
from swarmdsl.execution.simulate.machines.expressions import _ARRAYS
from swarmdsl.ir.operations import OPERATIONS
from swarmdsl.tools.player.engine_values import encoded

from .engine_in_page import needs_node, node

INTEGERS = [0, 1, -1, 2, 7, -7, 255, -128, 2**31, 2**53 + 1, -(2**63), 2**64 - 1, 10**9, 2**1030]
FLOATS = [0.0, -0.0, 0.5, 1.5, 2.5, -2.5, 0.1, 1e300, -1e-300, 5e-324, 1e16, 9007199254740993.0]
FLOATS += [math.inf, -math.inf, math.nan]
TEXTS = ["", "a", "ab", "\U0001f681b", "\uffffb", "é"]
LISTS: list[Any] = [[], [1, 2], [2, 1.0], ["a", "b"], [{"x": 1}, {"x": 1.0}]]
LAST_DIGIT = {"sin", "cos", "atan2"}
"""Functions of the platform: their last digit is not the same everywhere."""
UNARY = ("abs", "sqrt", "len", "int", "float", "round", "floor", "ceil", "seconds", "sin", "cos")


def cases() -> list[list[Any]]:
    """Operators with their values."""
    numbers: list[Any] = [*INTEGERS, *FLOATS]
    dice = random.Random(1)
    numbers += [dice.uniform(-1e3, 1e3) for _ in range(6)]
    found = [[word, value] for word in UNARY for value in [*numbers, "ab", [1]]]
    pairs = [*product(numbers, numbers), *product(TEXTS, TEXTS), *product(LISTS, LISTS), ("a", 1)]
    words = ("==", "!=", "<", "<=", ">", ">=", "+", "-", "*", "/", "%", "div", "min", "max")
    for word in (*words, "hypot", "atan2", "contains"):
        found += [[word, *pair] for pair in pairs if fits(word, *pair)]
    for _ in range(300):
        word = dice.choice(("distance", "clamp"))
        found.append([word, *(dice.choice(numbers) for _ in range(4 if word == "distance" else 3))])
        found.append(["distance", *(dice.uniform(-100, 100) for _ in range(6))])
    for array, number in product(LISTS, (-1, 0, 1, 2)):
        found += [["item", array, number], ["remove", array, number]]
        found += [["append", array, 3, number], ["replace", array, number, 3]]
    return found


def fits(word: str, left: Any, right: Any) -> bool:
    """Leave out what types rule out, or what takes long in Python too."""
    if isinstance(left, list) or isinstance(right, list):
        return word in ("==", "!=", "contains")
    if isinstance(left, str) != isinstance(right, str):
        return word not in ("contains", "%", "*")
    return word not in ("%", "*") if isinstance(left, str) else word != "contains"


def value_in_python(word: str, values: list[Any]) -> Any:
    operation = _ARRAYS.get(word) or OPERATIONS[word]
    try:
        return encoded(operation(*values))
    except (ArithmeticError, ValueError, ExecutionError, TypeError):
        return "failure"


def same(word: str, here: Any, there: Any) -> bool:
    if not isinstance(there, dict) or not isinstance(here, dict) or here.keys() != there.keys():
        return bool(here == there)
    if "f" not in there:
        return bool(here == there)
    mine, yours = float(here["f"]), float(there["f"])
    if word in LAST_DIGIT:
        return repr(mine) == repr(yours) or math.isclose(mine, yours, rel_tol=1e-15, abs_tol=1e-300)
    return repr(mine) == repr(yours)


@needs_node
def test_operators(tmp_path: Path) -> None:
    made = cases()
    trees = [[word, *(["value", encoded(value)] for value in values)] for word, *values in made]
    limits = [
        ("uint8", 255),
        ("uint8", 256),
        ("int8", -129),
        ("int64", 2**63),
        ("uint64", 2**64 - 1),
    ]
    trees += [["bounded", ["value", encoded(value)], type_] for type_, value in limits]
    (found,) = node("expressions.js", [json.dumps(trees)], tmp_path)
    wrong = [
        (word, values, here, there)
        for (word, *values), here in zip(made, found[: len(made)], strict=True)
        if not same(word, here, there := value_in_python(word, values))
    ]
    assert not wrong, "\n".join(map(str, wrong[:40]))
    assert found[len(made) :] == [255, "failure", "failure", "failure", {"i": str(2**64 - 1)}]
    assert bounded(255, "uint8") == 255
    kinds = {"failure" if each == "failure" else type(each).__name__ for each in found}
    assert kinds == {"failure", "int", "dict", "bool", "str", "list"}
