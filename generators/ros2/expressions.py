"""Expressions, values and types of the model in Python with rclpy.

Durations and times are integers in nanoseconds. Fields with them, and fields that the model does
not describe, are read with `get`.
"""

from __future__ import annotations

import keyword
from functools import cache

from swarmdsl.codegen import (
    PYTHON_DIVISION,
    PYTHON_FUNCTIONS,
    Dialect,
    python_literal,
    replace,
    translate,
    uses_math,
)
from swarmdsl.ir import (
    DURATION,
    FLOATS,
    STRING,
    Array,
    Binary,
    Call,
    EnvelopeField,
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
    """Return an expression for a function of `machine` and `event`, with variables in `data`."""
    made = _for_python(expression, imports)
    for part in subexpressions(made):
        if uses_math(part):
            imports.module("math")
        if isinstance(part, Call) and part.function == _GET:
            imports.own("values", _GET)
    return translate(made, _dialect(data))


def stored(expression: Expression, wanted: Type, imports: Imports, data: str = DATA) -> str:
    """Return an expression for a variable of the type `wanted`.

    Messages are copied, durations become integers in nanoseconds, and integers are checked against
    the range of the type.
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
    """Return the access to a field of a message, by `getattr` if its name is a keyword."""
    return f"getattr({base}, {field!r})" if keyword.iskeyword(field) else f"{base}.{field}"


def default_value(type_: Type, imports: Imports) -> str:
    """Return the initial value of a variable that has none in the model."""
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


def _for_python(expression: Expression, imports: Imports) -> Expression:
    """Return an expression with the names of fields in ROS 2."""
    match expression:
        case Literal(name=name) if name:
            text = _literal(replace(expression, name=""))
            return replace(expression, name=imports.constants.name(name, text))
        case EnvelopeField(header=header) if header is not None:
            return _for_python(header, imports)
        case FieldAccess(base=base, field=field, type=type_):
            inner, field = _for_python(base, imports), field_name(field)
            plain = isinstance(type_, Named | Array) or (
                isinstance(type_, Primitive) and type_.name not in _HELD_OTHERWISE
            )
            if plain and not keyword.iskeyword(field):
                return replace(expression, base=inner, field=field)
            return Call(_GET, (inner, Literal(field, STRING)), type_)
        case Unary(operand=operand):
            return replace(expression, operand=_for_python(operand, imports))
        case Binary(left=left, right=right):
            return replace(
                expression, left=_for_python(left, imports), right=_for_python(right, imports)
            )
        case Call(arguments=arguments):
            return replace(
                expression, arguments=tuple(_for_python(each, imports) for each in arguments)
            )
    return expression


def _literal(literal: Literal) -> str:
    if literal.name:
        return literal.name
    if literal.type == DURATION and isinstance(literal.value, int):
        return f"{literal.value:_}"
    return python_literal(literal)


@cache
def _dialect(data: str) -> Dialect:
    """Return the dialect of Python in which `data` has variables and params."""
    name = f"{data}.{{}}".format
    return Dialect(
        literal=_literal,
        variable=name,
        param=name,
        event=f"{EVENT}.data",
        envelope=lambda fact: f"{EVENT}.envelope.{fact.field}",
        identity=f"{data}.self.{{}}".format,
        operators={},
        functions=PYTHON_FUNCTIONS,
        division=PYTHON_DIVISION,
    )


_GET = "get"
