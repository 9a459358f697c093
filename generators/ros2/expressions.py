"""Expressions, values and types of the model in Python with rclpy.

Durations and times are whole nanoseconds; what a message has of them is read with `get`, as
is what the model does not know of a message.
"""

from __future__ import annotations

import keyword
from functools import cache

from swarmdsl.codegen import Dialect, python_literal, replace, translate
from swarmdsl.ir import (
    DURATION,
    FLOATS,
    STRING,
    Array,
    Binary,
    Call,
    EventData,
    Expression,
    FieldAccess,
    Literal,
    Named,
    Primitive,
    Type,
    Unary,
    bound_of,
    subexpressions,
)

from .imports import Imports
from .names import field_name

MACHINE = "machine"
EVENT = "event"
DATA = f"{MACHINE}.data"
_HELD_OTHERWISE = ("byte", "duration", "time")


def python_expression(expression: Expression, imports: Imports, data: str = DATA) -> str:
    """The expression in a function of `machine` and `event`; `data` has variables and params."""
    made = _for_python(expression)
    for part in subexpressions(made):
        if isinstance(part, Call) and part.function == "sqrt":
            imports.module("math")
        if isinstance(part, Call) and part.function == _GET:
            imports.own("values", _GET)
    return translate(made, _dialect(data))


def stored(expression: Expression, wanted: Type, imports: Imports, data: str = DATA) -> str:
    """A value that is kept in a variable of the type `wanted`.

    It is a copy, as ROS has it, durations are in whole nanoseconds, and whole numbers fit.
    """
    text = python_expression(expression, imports, data)
    if (bound := bound_of(expression, wanted)) is not None:
        return f"{imports.own('engine', 'bounded')}({text}, {bound!r})"
    if expression.type == DURATION:
        return text if isinstance(expression, Literal) else f"round({text})"
    if isinstance(expression.type, Primitive) or isinstance(expression, Literal):
        return text
    imports.name("copy", "deepcopy")
    return f"deepcopy({text})"


def attribute(base: str, field: str) -> str:
    """A field of a message to go on from, also one that Python has a keyword for."""
    return f"getattr({base}, {field!r})" if keyword.iskeyword(field) else f"{base}.{field}"


def uses_event(expression: Expression) -> bool:
    """Whether it needs the message of the triggering event."""
    return any(isinstance(part, EventData) for part in subexpressions(expression))


def default_value(type_: Type, imports: Imports) -> str:
    """The value of a variable that the model gives none."""
    match type_:
        case Array(size=None) | Array(bounded=True):
            return "[]"
        case Array(element=element, size=size):
            return f"[{default_value(element, imports)} for _ in range({size})]"
        case Named():
            return f"{imports.interface(type_, 'msg')}()"
        case Primitive(name="bool"):
            return "False"
        case Primitive(name="string" | "wstring"):
            return "''"
        case Primitive(name=name):
            return "0.0" if name in FLOATS else "0"
    raise AssertionError(type_)


def _for_python(expression: Expression) -> Expression:
    """The same with fields as ROS has them."""
    match expression:
        case FieldAccess(base=base, field=field, type=type_):
            inner, field = _for_python(base), field_name(field)
            plain = isinstance(type_, Named | Array) or (
                isinstance(type_, Primitive) and type_.name not in _HELD_OTHERWISE
            )
            if plain and not keyword.iskeyword(field):
                return replace(expression, base=inner, field=field)
            return Call(_GET, (inner, Literal(field, STRING)), type_)
        case Unary(operand=operand):
            return replace(expression, operand=_for_python(operand))
        case Binary(left=left, right=right):
            return replace(expression, left=_for_python(left), right=_for_python(right))
        case Call(arguments=arguments):
            return replace(expression, arguments=tuple(map(_for_python, arguments)))
    return expression


def _literal(literal: Literal) -> str:
    if literal.type == DURATION and isinstance(literal.value, int):
        return f"{literal.value:_}"
    return python_literal(literal)


@cache
def _dialect(data: str) -> Dialect:
    """Python, where `data` has variables and params."""
    name = f"{data}.{{}}".format
    return Dialect(
        literal=_literal,
        variable=name,
        param=name,
        event=f"{EVENT}.data",
        operators={},
        functions={"sqrt": "math.sqrt"},
    )


_GET = "get"
