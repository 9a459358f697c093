"""Expressions, values and types of the model in Python with rospy."""

from __future__ import annotations

import keyword
from collections.abc import Callable

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
    Array,
    Binary,
    Call,
    Construction,
    Elapsed,
    EnvelopeField,
    Expression,
    FieldAccess,
    InState,
    Literal,
    Named,
    Primitive,
    Type,
    mapped,
    subexpressions,
)

from .imports import Imports

EVENT = "event"
ENVELOPE = "envelope"
USERDATA = "userdata"


def python_expression(expression: Expression, imports: Imports) -> str:
    """Return an expression in Python; variables and params are in userdata."""
    for part in subexpressions(expression):
        if isinstance(part, Literal) and part.type == DURATION:
            imports.module("rospy")
        if isinstance(part, InState):
            imports.name(f"{imports.types.package}.states", "is_active")
        if isinstance(part, Elapsed):
            imports.name(f"{imports.types.package}.states", "elapsed")
        if isinstance(part, EnvelopeField) and part.field == "sent":
            imports.module("rospy")
        if isinstance(part, Call) and part.function in PYTHON_ARRAY_FUNCTIONS:
            engine = f"{imports.types.package}.engine"
            imports.name(engine, PYTHON_ARRAY_FUNCTIONS[part.function])
        if uses_math(part):
            imports.module("math")
    return translate(_for_python(expression, imports), _DIALECT)


def field_name(name: str) -> str:
    """Return a field's name in Python: genpy appends `_` to keywords."""
    return f"{name}_" if keyword.iskeyword(name) or name == "self" else name


def default_value(type_: Type, imports: Imports) -> str:
    """Return the initial value of a variable that has none in the model."""
    match type_:
        case Array(element=Primitive(name="uint8" | "char"), size=size, bounded=bounded):
            return "b''" if size is None or bounded else f"bytes({size})"
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
        case Primitive(name="time" | "duration" as name):
            imports.module("rospy")
            return f"rospy.{name.capitalize()}()"
        case Primitive(name=name):
            return "0.0" if name in FLOATS else "0"
    raise AssertionError(type_)


def _for_python(expression: Expression, imports: Imports) -> Expression:
    """Return an expression with names and operands that Python and rospy accept."""
    match expression:
        case Literal(name=name) if name:
            text = _literal(replace(expression, name=""))
            return replace(expression, name=imports.constants.name(name, text))
        case EnvelopeField(header=header) if header is not None:
            return replace(expression, header=_for_python(header, imports))
        case FieldAccess(base=base, field=field):
            return replace(expression, base=_for_python(base, imports), field=field_name(field))
        case Binary(operator="*", left=left, right=right, type=type_) if (
            type_ == DURATION and getattr(right, "type", None) == DURATION
        ):
            # `rospy.Duration * number` works, `number * rospy.Duration` does not.
            return replace(
                expression, left=_for_python(right, imports), right=_for_python(left, imports)
            )
        case Construction(type=type_, values=values):
            return replace(
                expression,
                type=Named("", imports.interface(type_, "msg")),
                values=tuple((field_name(name), _for_python(v, imports)) for name, v in values),
            )
    return mapped(expression, lambda part: _for_python(part, imports))


def _literal(literal: Literal) -> str:
    if literal.name:
        return literal.name
    text = python_literal(literal)
    return f"rospy.Duration({text})" if literal.type == DURATION else text


def _envelope(fact: EnvelopeField) -> str:
    """Return a fact about the event; one in a header is a field by now."""
    if fact.header is None:
        told = f"{ENVELOPE}.{fact.field}"
        return told if fact.field == "sender" else f"rospy.Duration(0, {told})"
    value = translate(fact.header, _DIALECT)
    return value if fact.field == "sender" else f"({value} - rospy.Time())"


def _construction(made: Construction, text: Callable[[Expression], str]) -> str:
    values = ", ".join(f"{name}={text(value)}" for name, value in made.values)
    return f"{made.type.name}({values})"


def _key(name: str) -> str:
    return f"{USERDATA}.{name}"


_DIALECT = Dialect(
    literal=_literal,
    variable=_key,
    param=_key,
    event=EVENT,
    envelope=_envelope,
    identity=f"{USERDATA}.self.{{}}".format,
    operators={},
    functions=PYTHON_FUNCTIONS,
    item=python_item,
    query=python_query,
    construction=_construction,
    in_state="is_active({!r})".format,
    elapsed="elapsed({!r})".format,
    division=PYTHON_DIVISION,
)
