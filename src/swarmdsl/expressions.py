"""Expressions: their text to a tree, by `grammar/expression.lark`.

The textX grammar only finds where an expression ends; precedence is settled here.
"""

from __future__ import annotations

import re
from decimal import Decimal
from functools import cache
from math import isinf

from lark import Lark, Token, Tree
from lark.exceptions import UnexpectedInput, UnexpectedToken

from swarmdsl.diagnostics import Diagnostics
from swarmdsl.resources import grammar
from swarmdsl.scan import NESTING_LIMIT
from swarmdsl.source import Source, Span
from swarmdsl.syntax import Call, ExpressionTree, FieldUse, NameUse, OperatorUse, Value, Word

_QUANTITY = re.compile(r"(\d+(?:\.\d+)?(?:[eE][+-]?\d+)?)[ \t]*([a-z]*)")
# Nanoseconds in each unit of durations.
UNITS = {"us": 1_000, "ms": 1_000_000, "s": 10**9, "min": 60 * 10**9, "h": 3600 * 10**9}
# What a `uint64` holds at most, and a duration in nanoseconds.
_LARGEST, _LONGEST = 2**64 - 1, 2**63 - 1
_ESCAPE = re.compile(r"\\(.)")
# More would take Python long to read, and nobody needs them.
_MOST_DIGITS = 400
_ESCAPED = {"n": "\n", "t": "\t"}


def parse_expression(span: Span, report: Diagnostics) -> ExpressionTree | None:
    """Parse the text at `span`; None when it is wrong, which has been reported then."""
    try:
        tree = _parser().parse(span.text)
    except UnexpectedInput as error:
        _report_unexpected(error, span, report)
        return None
    if _depth(tree) > NESTING_LIMIT:
        report.report(
            "nested-too-deeply",
            span,
            limit=NESTING_LIMIT,
            help="each operator is a level: store a part of the value in a variable first",
        )
        return None
    large = next(tree.scan_values(_too_large), None)
    if large is not None:
        start = span.start + (large.start_pos or 0)
        place = Span(span.source, start, start + len(large))
        report.report("syntax-error", place, message="this number is too large")
        return None
    return _build(tree, span.source, span.start)


def unquoted(text: str) -> str:
    r"""The content of a text in double quotes, with `\"`, `\\`, `\n` and `\t` replaced."""
    return _ESCAPE.sub(lambda found: _ESCAPED.get(found[1], found[1]), text[1:-1])


@cache
def _parser() -> Lark:
    text = (grammar() / "expression.lark").read_text(encoding="utf-8")
    return Lark(text, parser="lalr", propagate_positions=True, maybe_placeholders=False)


def _depth(tree: Tree[Token]) -> int:
    """How many operations and fields stand in each other, at most."""
    depth, level = 0, [tree]
    while level:
        depth += 1
        level = [child for inner in level for child in inner.children if isinstance(child, Tree)]
    return depth


def _build(tree: Tree[Token], source: Source, base: int) -> ExpressionTree:
    assert tree.meta.start_pos is not None
    assert tree.meta.end_pos is not None
    span = Span(source, base + tree.meta.start_pos, base + tree.meta.end_pos)
    operands = [_build(child, source, base) for child in tree.children if isinstance(child, Tree)]
    words = [
        Word(child, Span(source, base + child.start_pos, base + child.end_pos))
        for child in tree.children
        if isinstance(child, Token) and child.start_pos is not None and child.end_pos is not None
    ]
    match tree.data:
        case "operation":
            return OperatorUse(span, words[0], tuple(operands))
        case "field":
            return FieldUse(span, operands[0], words[0])
        case "call":
            return Call(span, words[0], tuple(operands))
        case "name":
            return NameUse(span, str(words[0]))
        case "text":
            return Value(span, unquoted(words[0]))
        case "truth":
            return Value(span, words[0] == "true")
    return Value(span, *_quantity(words[0]))


def _quantity(text: str) -> tuple[int | float, str]:
    """A number and its unit, which may be empty."""
    digits, unit = _QUANTITY.fullmatch(text).groups()  # type: ignore[union-attr]
    return (int(digits) if digits.isdigit() else float(digits)), unit


def quantity_value(digits: str) -> int | float:
    """The number that is written so."""
    return int(digits) if digits.isdigit() else float(digits)


def is_too_large(text: str, digits: str, unit: str) -> bool:
    """Whether no type holds a number with its unit, which may be empty."""
    if len(text) > _MOST_DIGITS:
        return True
    value = quantity_value(digits)
    if isinstance(value, float) and isinf(value):
        return True
    if unit:
        return nanoseconds(text, unit) > _LONGEST
    return isinstance(value, int) and value > _LARGEST


def nanoseconds(text: str, unit: str) -> int:
    """The length of a duration, exactly as written, which a float may not be."""
    return round(Decimal(text.removesuffix(unit).rstrip()) * UNITS[unit])


def _too_large(token: object) -> bool:
    if not isinstance(token, Token) or token.type != "QUANTITY":
        return False
    digits, unit = _QUANTITY.fullmatch(token).groups()  # type: ignore[union-attr]
    return is_too_large(str(token), digits, unit)


def _report_unexpected(error: UnexpectedInput, span: Span, report: Diagnostics) -> None:
    at = error.pos_in_stream
    if at is None or at < 0 or at >= span.end - span.start:
        report.report("syntax-error", span, message="this expression ends too early")
        return
    if isinstance(error, UnexpectedToken):
        token = str(error.token)
        place = Span(span.source, span.start + at, span.start + at + len(token))
        if error.token.type == "COMPARISON":
            report.report(
                "syntax-error",
                place,
                message="comparisons cannot be chained",
                help="join them: `a < b and b < c`",
            )
            return
        report.report("syntax-error", place, message=f"`{token}` cannot stand here")
        return
    place = Span(span.source, span.start + at, span.start + at + 1)
    report.report("syntax-error", place, message=f"`{place.text}` cannot stand here")
