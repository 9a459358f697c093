"""Values in interface files: constants and defaults of fields."""

from __future__ import annotations

import re

from swarmdsl.base.diagnostics.advice import write
from swarmdsl.base.numerals import integer
from swarmdsl.base.source import Span
from swarmdsl.project.rosidl.fault import InterfaceError
from swarmdsl.syntax.ast import Value

TEXTS = ("string", "wstring")
Values = Value | tuple[Value, ...]

# Text before a comment. A `#` in quotes starts no comment.
BEFORE_COMMENT = re.compile(
    r""" (?: "(?:[^"\\]|\\.)*" | '(?:[^'\\]|\\.)*' | [^#"'] )* [^#]* """, re.X
)
_QUOTED = r""" "(?:[^"\\]|\\.)*" | '(?:[^'\\]|\\.)*' """
_ELEMENT = (
    r""" \s* (?P<text> "(?:[^"\\]|\\.)*" | '(?:[^'\\]|\\.)*' | [^,]*? ) \s* (?P<comma>,|$) """
)
_BOOLEANS = {"true": True, "1": True, "false": False, "0": False}
_RANGES = {
    # `byte` is signed in ROS 1 and unsigned in ROS 2.
    "byte": (-(2**7), 2**8 - 1),
    "char": (0, 2**8 - 1),
    **{f"int{bits}": (-(2 ** (bits - 1)), 2 ** (bits - 1) - 1) for bits in (8, 16, 32, 64)},
    **{f"uint{bits}": (0, 2**bits - 1) for bits in (8, 16, 32, 64)},
}


def is_quoted(text: str) -> bool:
    """Return True for a quoted string."""
    return re.fullmatch(_QUOTED, text, re.X) is not None


def read_values(span: Span, type_: str, bound: int | None, array: str) -> Values:
    """Parse the default of a field of this type; raise InterfaceError."""
    if not array:
        return read_value(span, type_, bound)
    if not re.fullmatch(r"\[.*\]", span.text, re.S):
        raise InterfaceError(
            span, f"`{span.text}` is no list of values", "write the values as `[1, 2, 3]`"
        )
    values = tuple(read_value(element, type_, bound) for element in _elements(span))
    size = re.search(r"\d+", array)
    if size is not None:
        limit = integer(size[0])
        if len(values) > limit or (len(values) < limit and "<" not in array):
            at_most = "at most " if "<" in array else ""
            raise InterfaceError(span, f"expected {at_most}{limit} values, found {len(values)}")
    return values


def _elements(span: Span) -> list[Span]:
    """Spans of the values in `[1, 2, 3]`."""
    text, start, end = span.source.text, span.start + 1, span.end - 1
    spans: list[Span] = []
    while text[start:end].strip() or spans:
        found = re.compile(_ELEMENT, re.X).match(text, start, end)
        assert found is not None  # matches anything up to a comma or the end
        spans.append(Span(span.source, *found.span("text")))
        if not found["comma"]:
            break
        start = found.end()
    return spans


def read_value(span: Span, type_: str, bound: int | None = None) -> Value:
    """Parse a single value of a built-in type; raise InterfaceError."""
    text = span.text
    value: bool | int | float | str | None
    if type_ in TEXTS:
        value = _text(span)
        if bound is not None and len(value) > bound:
            raise InterfaceError(span, f"the string is longer than {bound} characters")
        return Value(span, value)
    help_: str
    if type_ == "bool":
        value, help_ = _BOOLEANS.get(text.lower()), write("true", "false")
    elif type_ in _RANGES:
        value, help_ = _integer(text, type_)
    else:
        value, help_ = _float(text), "write a number, `0.5` for instance"
    if value is None:
        raise InterfaceError(span, f"`{text}` is no value of type `{type_}`", help_)
    return Value(span, value)


def _text(span: Span) -> str:
    text = span.text
    quote = text[:1]
    if quote not in ("'", '"'):
        return text
    if not is_quoted(text):
        raise InterfaceError(span, f"this string has no closing `{quote}`, or goes on after it")
    return text[1:-1].replace("\\" + quote, quote)


def _integer(text: str, type_: str) -> tuple[int | None, str]:
    lowest, highest = _RANGES[type_]
    value = None
    for base in (10, 0):  # `007` is a decimal number, unlike `0x07`
        try:
            value = int(text, base)
            break
        except ValueError:
            continue
    if value is not None and not lowest <= value <= highest:
        value = None
    return value, f"write a whole number from {lowest} to {highest}"


def _float(text: str) -> float | None:
    try:
        return float(text)
    except ValueError:
        return None
