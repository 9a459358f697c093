"""Values and expressions of machines as JSON, for the engine in the page.

JSON has one kind of numbers, so that values are marked: a number without a mark is an integer,
`{"f": 0.5}` a float, `{"i": "..."}` an integer that a float does not hold, `{"m": {...}}` a
message. An expression is a list: a word, and its parts.
"""

from __future__ import annotations

import math
from typing import Any

from swarmdsl.codegen.shared.default_values import default_value, field_type
from swarmdsl.ir import (
    Array,
    Binary,
    Call,
    Construction,
    Elapsed,
    EnvelopeField,
    EventData,
    Expression,
    FieldAccess,
    InState,
    ItemRef,
    Literal,
    ParamRef,
    Primitive,
    Query,
    SelfField,
    System,
    Type,
    Unary,
    VariableRef,
)
from swarmdsl.ir.integer_ranges import bound_of
from swarmdsl.syntax.types import DURATION

_LARGEST = 2**53
"""Integers up to here are numbers in JSON."""

Tree = list[Any]


def encoded(value: Any) -> Any:
    """Return engine data as JSON that tells integers from floats."""
    match value:
        case dict():
            return {"m": {key: encoded(each) for key, each in value.items()}}
        case list() | tuple():
            return [encoded(each) for each in value]
        case float() if math.isfinite(value):
            return {"f": value}
        case float():
            return {"f": "NaN" if math.isnan(value) else "Infinity" if value > 0 else "-Infinity"}
        case int() if not isinstance(value, bool) and abs(value) > _LARGEST:
            return {"i": str(value)}
    return value


def tree_of(expression: Expression) -> Tree:
    """Return an expression as a tree, as `machines/expressions.py` compiles it."""
    match expression:
        case Literal(value=literal):
            return ["value", encoded(literal)]
        case VariableRef(name=name) | ParamRef(name=name):
            return ["variable", name]
        case EventData():
            return ["data"]
        case EnvelopeField(field=field, header=header):
            return ["envelope", field] if header is None else tree_of(header)
        case SelfField(field=field):
            return ["self", field]
        case FieldAccess(base=base, field=field):
            return ["field", tree_of(base), field]
        case Unary(operator=symbol, operand=operand):
            return ["not" if symbol == "not" else "negative", tree_of(operand)]
        case Binary(operator=symbol, left=left, right=right):
            return [symbol, tree_of(left), tree_of(right)]
        case Call(function="present", arguments=arguments):
            match arguments:
                case (Literal(value=role),):
                    return ["present", str(role)]
            return ["present", None]
        case Call(function="empty"):
            return ["list"]
        case Call(function=name, arguments=arguments):
            return [name, *map(tree_of, arguments)]
        case ItemRef(name=name):
            return ["item of", name]
        case Query(function=name, item=item, array=array, condition=condition, key=key):
            parts = [tree_of(part) if part is not None else None for part in (condition, key)]
            return ["query", name, item, tree_of(array), *parts]
        case InState(state=state):
            return ["in", state]
        case Elapsed(state=state):
            return ["elapsed", state]
        case Construction():
            raise AssertionError("a new message is only stored or sent")


def stored_tree(expression: Expression, wanted: Type | None, system: System) -> Tree:
    """Return an expression whose value is stored or sent, as `machine_data.stored` has it."""
    match expression:
        case Construction(type=type_, values=values):
            fields = [
                [name, stored_tree(value, field_type(type_, (name,), system), system)]
                for name, value in values
            ]
            return ["message", encoded(default_value(type_, system)), fields]
        case Call(function="append" | "replace" as word, type=Array(element=element)):
            at = 1 if word == "append" else 2
            return [
                word,
                *(
                    stored_tree(part, element, system) if number == at else tree_of(part)
                    for number, part in enumerate(expression.arguments)
                ),
            ]
    tree = tree_of(expression)
    bound = bound_of(expression, wanted)
    if bound is not None:
        return ["bounded", tree, bound]
    if expression.type == DURATION:
        return ["round", tree]
    return tree if isinstance(expression.type, Primitive) else ["copy", tree]
