"""Arrays, queries of them and new messages in ECMAScript."""

from __future__ import annotations

import json
from collections.abc import Callable, Collection, Mapping, Sequence

from swarmdsl.codegen.exchange.scxml.ids import RESERVED
from swarmdsl.codegen.shared.default_values import default_value
from swarmdsl.ir import (
    Call,
    Construction,
    EventData,
    Expression,
    FieldAccess,
    ItemRef,
    ParamRef,
    Primitive,
    Query,
    System,
    VariableRef,
)
from swarmdsl.ir.expression_printer import Printer

# `Infinity` and `NaN` of ECMAScript, and `undefined` for an item, are errors in the language.
NO_VALUE = "null.value"

_EXISTS = "b >= 0 && b < a.length"


def _function(parameters: str, result: str) -> Callable[[Sequence[str]], str]:
    head = f"(function ({parameters}) {{ return {result}; }})"
    return lambda values: f"{head}({', '.join(values)})"


ARRAY_FUNCTIONS: Mapping[str, Callable[[Sequence[str]], str]] = {
    "contains": lambda values: "({}.indexOf({}) >= 0)".format(*values),
    "item": _function("a, b", f"{_EXISTS} ? a[b] : {NO_VALUE}"),
    "append": _function("a, b, c", f"a.length < c ? a.concat([b]) : {NO_VALUE}"),
    "remove": _function("a, b", f"{_EXISTS} ? a.slice(0, b).concat(a.slice(b + 1)) : {NO_VALUE}"),
    "replace": _function(
        "a, b, c", f"{_EXISTS} ? a.slice(0, b).concat([c], a.slice(b + 1)) : {NO_VALUE}"
    ),
    "empty": lambda values: "[]",
}


def item_name(name: str, taken: Collection[str]) -> str:
    """Return the name of an item of a query, which must not hide the data of the machine."""
    while name in taken or RESERVED.fullmatch(name):
        name += "_"
    return name


def query_text(query: Query, text: Printer, taken: Collection[str]) -> str:
    """Return a query as calls of methods of the array."""
    name = item_name(query.item, taken)
    array = text(query.array)
    condition = query.condition
    chosen = f"function ({name}) {{ return {text(condition)}; }}" if condition is not None else ""
    if query.function == "count":
        return f"{array}.filter({chosen}).length"
    if query.function in ("any", "all"):
        return f"{array}.{'some' if query.function == 'any' else 'every'}({chosen})"
    first, second = _others(name, taken)
    if query.key is None:
        first = name
    left, right = first, second
    if query.key is not None:
        key = f"(function ({name}) {{ return {text(query.key)}; }})"
        left, right = f"{key}({first})", f"{key}({second})"
    sign = "<" if query.function == "min" else ">"
    filtered = f"{array}.filter({chosen})" if chosen else array
    better = f"{right} {sign} {left} ? {second} : {first}"
    return f"{filtered}.reduce(function ({first}, {second}) {{ return {better}; }})"


def _others(name: str, taken: Collection[str]) -> tuple[str, str]:
    """Return two names that hide nothing which a key may read."""
    known = {*taken, name}
    first = next(each for each in _names("a") if each not in known)
    return first, next(each for each in _names("b") if each not in known)


def _names(letter: str) -> list[str]:
    return [letter, *(f"{letter}{number}" for number in range(1, 1000))]


def construction_text(made: Construction, text: Printer, system: System | None) -> str:
    """Return a new message: the defaults of its fields, and the values in their place."""
    assert system is not None
    defaults = json.dumps(default_value(made.type, system))
    values = (f"{json.dumps(name)}: {copied(value, text(value))}" for name, value in made.values)
    return f"Object.assign({defaults}, {{{', '.join(values)}}})"


def copied(expression: Expression, text: str) -> str:
    """Return a value to keep; a message or an array that something else holds is copied."""
    kept = isinstance(
        expression, (VariableRef, ParamRef, EventData, FieldAccess, ItemRef, Query)
    ) or (isinstance(expression, Call) and expression.function == "item")
    if kept and not isinstance(expression.type, Primitive):
        return f"JSON.parse(JSON.stringify({text}))"
    return text
