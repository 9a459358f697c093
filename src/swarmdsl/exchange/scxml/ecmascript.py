"""Expressions and first values in ECMAScript, the data model of portable documents."""

from __future__ import annotations

import json
from collections.abc import Mapping

from swarmdsl.ir import Array, Message, Primitive, System, Type
from swarmdsl.translate import Dialect, ecmascript_literal


def dialect(data: Mapping[str, str]) -> Dialect:
    """How expressions are written where variables and params have the `<data>` ids of `data`."""
    return Dialect(
        literal=ecmascript_literal,
        variable=data.__getitem__,
        param=data.__getitem__,
        event="_event.data",
        operators={"and": "&&", "or": "||", "not": "!"},
        functions={
            "sqrt": "Math.sqrt",
            "min": "Math.min",
            "max": "Math.max",
            "abs": "Math.abs",
            "len": ".length",
        },
    )


def first_value(type_: Type, system: System) -> str:
    """The value of a variable to which the model gives none: ROS's default for its type."""
    value = json.dumps(_default(type_, system))
    # An engine that evaluates the text as a program would take the brace for a block.
    return f"({value})" if value.startswith("{") else value


def _default(type_: Type, system: System) -> object:
    match type_:
        case Primitive(name="string"):
            return ""
        case Primitive(name="bool"):
            return False
        case Primitive():
            return 0
        case Array(element=element, size=size):
            return [_default(element, system)] * (size or 0)
    described = system.interface(type_)
    if not isinstance(described, Message):
        return {}
    return {field.name: _default(field.type, system) for field in described.fields}
