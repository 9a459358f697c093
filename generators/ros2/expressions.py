"""Expressions, values and types of the model in Python with rclpy.

Durations and times are integers in nanoseconds. Fields with them, and fields that the model does
not describe, are read with `get`.
"""

from __future__ import annotations

import keyword
from collections.abc import Callable
from functools import cache

from swarmdsl.codegen import (
    PYTHON_ARRAY_FUNCTIONS,
    PYTHON_DIVISION,
    PYTHON_FUNCTIONS,
    Dialect,
    python_item,
    python_literal,
    python_query,
    replace,
    translate,
    uses_math,
)
from swarmdsl.ir import (
    DURATION,
    FLOATS,
    STRING,
    Array,
    Call,
    Construction,
    EnvelopeField,
    Expression,
    FieldAccess,
    ItemRef,
    Literal,
    Named,
    Primitive,
    Query,
    Type,
    bound_of,
    mapped,
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
        if isinstance(part, Call) and part.function in (_GET, _PLAIN):
            imports.own("values", part.function)
        if isinstance(part, Call) and part.function in PYTHON_ARRAY_FUNCTIONS:
            imports.own("engine", PYTHON_ARRAY_FUNCTIONS[part.function])
        if isinstance(part, Construction):
            imports.own("values", "filled")
    return translate(made, _dialect(data))


def stored(expression: Expression, wanted: Type, imports: Imports, data: str = DATA) -> str:
    """Return an expression for a variable of the type `wanted`.

    Messages are copied, durations become integers in nanoseconds, and integers are checked against
    the range of the type.
    """
    if isinstance(expression, Call) and isinstance(expression.type, Array):
        if expression.function in ("append", "replace"):
            return _changed(expression, expression.type.element, imports, data)
        if expression.function in ("remove", "empty"):
            return python_expression(expression, imports, data)
    text = python_expression(expression, imports, data)
    if (bound := bound_of(expression, wanted)) is not None:
        return f"{imports.own('engine', 'bounded')}({text}, {bound!r})"
    if expression.type == DURATION:
        return text if isinstance(expression, Literal) else f"round({text})"
    if isinstance(expression.type, Primitive) or isinstance(expression, (Literal, Construction)):
        return text
    imports.name("copy", "deepcopy")
    return f"deepcopy({text})"


def _changed(call: Call, element: Type, imports: Imports, data: str) -> str:
    """Return an array with another item, which is a copy of a value."""
    at = 1 if call.function == "append" else 2
    values = [
        stored(part, element, imports, data)
        if number == at
        else python_expression(part, imports, data)
        for number, part in enumerate(call.arguments)
    ]
    function = imports.own("engine", PYTHON_ARRAY_FUNCTIONS[call.function])
    return f"{function}({', '.join(values)})"


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
            is_plain = type_ is not None and not _is_held_otherwise(type_)
            if is_plain and not keyword.iskeyword(field):
                return replace(expression, base=inner, field=field)
            return Call(_GET, (inner, Literal(field, STRING)), type_)
        case Call(function="item") | ItemRef() if _is_held_otherwise(expression.type):
            # The array may be that of a message.
            held = mapped(expression, lambda part: _for_python(part, imports))
            return Call(_PLAIN, (held,), expression.type)
        case Query(key=None, item=name, type=type_) if _is_held_otherwise(type_):
            compared = replace(expression, key=ItemRef(name, DURATION))
            return Call(_PLAIN, (_for_python(compared, imports),), type_)
        case Construction(type=type_, values=values):
            return replace(
                expression,
                type=Named("", imports.interface(type_, "msg")),
                values=tuple((field_name(name), _for_python(v, imports)) for name, v in values),
            )
    return mapped(expression, lambda part: _for_python(part, imports))


def _is_held_otherwise(type_: Type | None) -> bool:
    """Return True for a type whose values in messages are not those of the model."""
    return isinstance(type_, Primitive) and type_.name in _HELD_OTHERWISE


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
        functions={**PYTHON_FUNCTIONS, "present": f"{MACHINE}.world.present"},
        item=python_item,
        query=python_query,
        construction=_construction,
        in_state=lambda state: f"{MACHINE}.active({state!r})",
        elapsed=lambda state: f"{MACHINE}.elapsed({state!r})",
        division=PYTHON_DIVISION,
    )


def _construction(made: Construction, text: Callable[[Expression], str]) -> str:
    """Return a new message; a keyword of Python cannot be the name of an argument."""
    values = (
        f"**{{{name!r}: {text(value)}}}" if keyword.iskeyword(name) else f"{name}={text(value)}"
        for name, value in made.values
    )
    return f"filled({', '.join((f'{made.type.name}()', *values))})"


_GET = "get"
_PLAIN = "plain"
