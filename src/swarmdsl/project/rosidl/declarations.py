"""Parser of one line of an interface file: a field or a constant."""

from __future__ import annotations

import re

from swarmdsl.base.diagnostics.advice import sizes, write
from swarmdsl.base.numerals import integer
from swarmdsl.base.records import dataclass
from swarmdsl.base.source import Span
from swarmdsl.project.rosidl.fault import InterfaceError
from swarmdsl.project.rosidl.values import (
    BEFORE_COMMENT,
    TEXTS,
    Values,
    is_quoted,
    read_value,
    read_values,
)
from swarmdsl.syntax.ast import Constant, Expression, Field, TypeRef, Value, Word
from swarmdsl.syntax.types import PRIMITIVES

_BUILT_IN = frozenset({*PRIMITIVES, "wstring"})
# Built-in types with literals.
_WITH_VALUES = _BUILT_IN - {"time", "duration"}
_SAME_TYPE = {
    "Header": "std_msgs/Header",
    "builtin_interfaces/Time": "time",
    "builtin_interfaces/Duration": "duration",
}

_DECLARATION = re.compile(
    r"\s*(?P<type>[^\s#]+)(?:\s+(?P<name>[^\s#=]+)\s*(?P<constant>=?)\s*)?(?P<rest>.*)"
)
_NAME = re.compile(r"[A-Za-z]\w*", re.ASCII)
_TYPE = re.compile(
    r"(?P<name>[A-Za-z]\w*(?:/[A-Za-z]\w*)?)(?:<=(?P<bound>\d{1,9}))?(?P<array>(?:\[[^\]]*\])*)",
    re.ASCII,
)
_ARRAY = r"\[(?:(?:<=)?(?!0+\])\d{1,9})?\]"


@dataclass(frozen=True, slots=True)
class Line:
    """Declaration in a line.

    `bound` is the greatest length of a string (`string<=10`), `default` the default value of a
    field, and `bad_default` the error in it.
    """

    declared: Field | Constant
    comment: str
    bound: int | None
    default: Values | None = None
    bad_default: InterfaceError | None = None


def read_line(line: Span, package: str) -> Line:
    """Parse a line of a file of `package` that is no comment; raise InterfaceError."""
    source = line.source
    found = _DECLARATION.match(source.text, line.start, line.end)
    assert found is not None  # the line is not blank
    type_span = Span(source, *found.span("type"))
    type_, bound = _type(type_span, package)
    if found["name"] is None:
        raise InterfaceError(
            type_span,
            f"`{type_span.text}` has no name",
            f"a field is a type and a name: `{type_span.text} data` for instance",
        )
    name = _name(Span(source, *found.span("name")), type_span)
    rest = Span(source, *found.span("rest"))
    if found["constant"]:
        return _constant(name, type_, bound, rest)
    value, comment = _split(rest)
    end = value.end if value.text else name.span.end
    field = Field(Span(source, type_span.start, end), name, type_)
    if not value.text:
        return Line(field, comment, bound)
    try:
        return Line(field, comment, bound, _default(value, type_, bound))
    except InterfaceError as error:
        return Line(field, comment, bound, bad_default=error)


def _type(span: Span, package: str) -> tuple[TypeRef, int | None]:
    """Type and the greatest length of its strings."""
    found = _TYPE.fullmatch(span.text)
    if found is None:
        raise InterfaceError(span, *_no_type(span.text))
    name, array, bound = found["name"], found["array"], found["bound"]
    if array.count("[") > 1:
        raise InterfaceError(
            span, "ROS has no arrays of arrays", "put the inner array into a message of its own"
        )
    if array and not re.fullmatch(_ARRAY, array, re.ASCII):
        raise InterfaceError(
            span, f"`{array}` is no size of an array", sizes("[]", "[16]", "[<=16]")
        )
    if bound is not None and (name not in TEXTS or not integer(bound)):
        raise InterfaceError(
            span, f"`{span.text}` is no type", "strings can have a bound: `string<=10`"
        )
    if name in _SAME_TYPE:
        name = _SAME_TYPE[name]
    elif name not in _BUILT_IN and "/" not in name:
        name = f"{package}/{name}"
    return TypeRef(span, name, f"<={bound}" if bound is not None else "", array), (
        integer(bound) if bound is not None else None
    )


def _name(span: Span, type_: Span) -> Word:
    name = Word(span.text, span)
    if _NAME.fullmatch(name):
        return name
    hint = "a name has letters, digits and `_`, and starts with a letter"
    if found := re.fullmatch(r"(\w+)(\[.*\])", name):
        hint = write(f"{type_.text}{found[2]} {found[1]}")
    elif name.endswith((",", ";")):
        hint = f"a line has one field and nothing after it: `{type_.text} {name[:-1]}`"
    raise InterfaceError(span, f"`{name}` cannot be a name", hint)


def _constant(name: Word, type_: TypeRef, bound: int | None, rest: Span) -> Line:
    if type_.name not in _WITH_VALUES or type_.array:
        raise InterfaceError(
            type_.span,
            f"a constant cannot be of type `{type_.span.text}`",
            "a constant is a number, a string or a Boolean",
        )
    span, comment = _split(rest)
    if type_.name in TEXTS and not is_quoted(span.text):
        # In ROS 1 the rest of the line is the string, with quotes and `#`.
        value, comment = Value(rest, rest.text), ""
    elif span.text:
        value = read_value(span, type_.name, bound)
    else:
        raise InterfaceError(name.span, f"constant `{name}` has no value")
    whole = Span(rest.source, type_.span.start, value.span.end)
    written = Expression(value.span)
    written.tree = value
    return Line(Constant(whole, name, type_, written), comment, bound)


def _default(value: Span, type_: TypeRef, bound: int | None) -> Values:
    if type_.name not in _WITH_VALUES:
        raise InterfaceError(
            value,
            f"a field of type `{type_.name}` cannot have a default",
            "a field is a type and a name; a comment starts with `#`",
        )
    return read_values(value, type_.name, bound, type_.array)


def _split(rest: Span) -> tuple[Span, str]:
    """Value and comment after a name."""
    found = BEFORE_COMMENT.match(rest.text)
    assert found is not None  # matches the empty string too
    value = found[0].rstrip()
    return Span(rest.source, rest.start, rest.start + len(value)), rest.text[found.end() :]


def _no_type(text: str) -> tuple[str, str]:
    if found := re.fullmatch(r"(\w+)/(?:msg|srv|action)/(\w+.*)", text):
        return f"`{text}` is no type", write(f"{found[1]}/{found[2]}")
    if re.fullmatch(r"\w+=.*", text):
        return f"`{text}` has no type", "a constant is a type, a name, `=` and a value"
    return (
        f"`{text}` is no type",
        "a type is a built-in one, such as `float64`, or a message, such as `geometry_msgs/Pose`",
    )
