"""Expressions: their text to a tree, by `grammar/expression.lark`.

The textX grammar only finds where an expression ends; precedence is settled here.
"""

from __future__ import annotations

import re
from functools import cache

from lark import Lark, Token, Tree
from lark.exceptions import UnexpectedInput, UnexpectedToken

from swarmdsl.diagnostics import Diagnostics
from swarmdsl.resources import grammar
from swarmdsl.source import Source, Span
from swarmdsl.syntax import Call, ExpressionTree, FieldUse, NameUse, OperatorUse, Value, Word

_QUANTITY = re.compile(r"(\d+(?:\.\d+)?(?:[eE][+-]?\d+)?)[ \t]*([a-z]*)")
_ESCAPE = re.compile(r"\\(.)")
_ESCAPED = {"n": "\n", "t": "\t"}


def parse_expression(span: Span, report: Diagnostics) -> ExpressionTree | None:
    """Parse the text at `span`; None when it is wrong, which has been reported then."""
    try:
        tree = _parser().parse(span.text)
    except UnexpectedInput as error:
        _report_unexpected(error, span, report)
        return None
    return _build(tree, span.source, span.start)


def unquoted(text: str) -> str:
    r"""The content of a text in double quotes, with `\"`, `\\`, `\n` and `\t` replaced."""
    return _ESCAPE.sub(lambda found: _ESCAPED.get(found[1], found[1]), text[1:-1])


@cache
def _parser() -> Lark:
    text = (grammar() / "expression.lark").read_text(encoding="utf-8")
    return Lark(text, parser="lalr", propagate_positions=True, maybe_placeholders=False)


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
    digits, unit = _QUANTITY.fullmatch(words[0]).groups()  # type: ignore[union-attr]
    return Value(span, int(digits) if digits.isdigit() else float(digits), unit)


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
