"""Trees by stock textX and Lark, to compare with the parsers of swarmdsl."""

from __future__ import annotations

import re
import sys
from collections.abc import Iterator
from dataclasses import dataclass, field, fields
from functools import cache
from typing import Any

from lark import Lark, Token, Tree
from lark.exceptions import UnexpectedInput
from textx import TextXSyntaxError

from swarmdsl.base.resources import grammar
from swarmdsl.base.source import Source, Span
from swarmdsl.syntax.ast import (
    NEIGHBORS,
    NODES,
    Call,
    Construction,
    DeliverySetting,
    Documented,
    Elapsed,
    Element,
    EnumValue,
    Expression,
    ExpressionTree,
    Field,
    FieldUse,
    FieldValue,
    IndexUse,
    InState,
    Model,
    NameUse,
    Node,
    OperatorUse,
    Parameter,
    PartValue,
    Query,
    Ref,
    TypeRef,
    Value,
    Word,
    walk,
)
from swarmdsl.syntax.parser.literals import is_out_of_range, quantity_value, unquoted
from swarmdsl.syntax.parser.result import NESTING_LIMIT
from swarmdsl.syntax.pegen.metamodel import metamodel
from swarmdsl.syntax.pegen.swarm_actions import TARGET
from swarmdsl.syntax.units import UNITS

_TOKEN = re.compile(
    r'(?P<blank>\s+|//[^\n]*|/\*(?:[^*]|\*(?!/))*\*/)|"(?:[^"\\\n]|\\[^\n])*"|\w+|.', re.DOTALL
)


@dataclass
class Expected:
    """A model, and the places of the expressions that are wrong."""

    model: Model
    wrong: set[tuple[int, int]] = field(default_factory=set)


@dataclass
class Refused:
    """Failure of textX: its offset and the expected terminals."""

    at: int
    expected: set[tuple[str, str]]


def parse(text: str) -> Expected | Refused:
    """Parse a text with textX and Lark."""
    source = Source("model.swarm", text)
    usual = sys.getrecursionlimit()
    sys.setrecursionlimit(20_000)  # textX takes some thirty frames a level
    try:
        made = _metamodel().model_from_str(text)
    except TextXSyntaxError as error:
        rules = [rule for rule in error.expected_rules if rule.rule_name != "Comment"]
        expected = {
            ("" if rule.rule_name == "sep" else rule.rule_name, getattr(rule, "to_match", ""))
            for rule in rules
        }
        return Refused(error.__cause__.position, expected)
    finally:
        sys.setrecursionlimit(usual)
    if isinstance(made, str):  # textX makes no model of nothing
        model = Model(Span(source, 0, 0), None, [], [], [])
        model.missing_separators = []
        return Expected(model)
    conversion = _Conversion(source)
    model = conversion.converted(made)
    model.missing_separators = list(_missing_separators(model, source))
    return Expected(model, conversion.wrong)


def _missing_separators(model: Model, source: Source) -> Iterator[Word]:
    """Yield what separates items on one line, where it is missing."""
    gaps: dict[int, tuple[str, str, int]] = {}  # by token: the one before, what is between, the end
    last, end = "", 0
    for token in _TOKEN.finditer(source.text):
        if token.lastgroup != "blank":
            gaps[token.start()] = last, source.text[end : token.start()], token.end()
            last, end = token[0], token.end()
    for node in sorted(walk(model), key=lambda node: node.span.start):
        start = node.span.start
        if isinstance(node, Documented) and not isinstance(node, Parameter):
            before, gap, end = gaps[start]
            if before not in ("", "{", "}", ",", ";") and "\n" not in gap:
                is_entry = isinstance(node, (DeliverySetting, EnumValue, Field, PartValue))
                yield Word("," if is_entry else ";", Span(source, start, end))


class _Conversion:
    def __init__(self, source: Source) -> None:
        self._source = source
        self.wrong: set[tuple[int, int]] = set()

    def converted(self, made: Any) -> Any:
        """The node of a textX object, with all below it."""
        if isinstance(made, list):
            return [self.converted(item) for item in made]
        if made is None or isinstance(made, (str, bool)):
            return made
        if hasattr(made, "obj_name"):  # an unresolved textX reference
            span = Span(self._source, made.position, made.position + len(made.obj_name))
            return Ref(made.obj_name, made.cls.__name__, span)
        span = Span(self._source, made._tx_position, made._tx_position_end)
        rule = type(made).__name__
        if rule in TARGET.words:
            return Word(unquoted(made.text) if rule == "Text" else made.text, span)
        if rule in TARGET.written:
            return self._expression(span)
        node = NODES[rule]
        attributes = {
            attribute.name: self.converted(getattr(made, attribute.name))
            for attribute in fields(node)
            if attribute.init and attribute.name != "span"
        }
        return node(span, **attributes)

    def _expression(self, span: Span) -> Expression:
        made = Expression(span)
        made.tree = expression_tree(span)
        if made.tree is None:
            self.wrong.add((span.start, span.end))
        return made


def expression_tree(span: Span) -> ExpressionTree | None:
    """Parse an expression with Lark; None if it is wrong."""
    try:
        tree = expressions().parse(span.text)
    except UnexpectedInput:
        return None
    if _depth(tree) > NESTING_LIMIT or any(tree.scan_values(_is_too_large)):
        return None
    return _build(tree, span.source, span.start)


@cache
def _metamodel() -> Any:
    return metamodel()


@cache
def expressions() -> Lark:
    """The parser of expressions that the grammar for Lark gives."""
    text = (grammar() / "expression.lark").read_text(encoding="utf-8")
    return Lark(text, parser="lalr", propagate_positions=True, maybe_placeholders=False)


def _depth(tree: Tree[Token]) -> int:
    depth, level = 0, [tree]
    while level:
        depth += 1
        level = [child for inner in level for child in inner.children if isinstance(child, Tree)]
    return depth


def _is_too_large(token: object) -> bool:
    if not isinstance(token, Token) or token.type != "QUANTITY":
        return False
    return is_out_of_range(token, *_quantity(token))


def _quantity(text: str) -> tuple[str, str]:
    unit = next((u for u in sorted(UNITS, key=len, reverse=True) if text.endswith(u)), "")
    return text.removesuffix(unit).rstrip(), unit


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
        case "index":
            return IndexUse(span, *operands)
        case "element":
            return Element(span, words[0], operands[0])
        case "query":
            parts = dict(zip(words[1:], operands[1:], strict=True))
            return Query(span, words[0], operands[0], parts.get("where"), parts.get("by"))
        case "value":
            return FieldValue(span, words[0], operands[0])
        case "construction":
            return Construction(
                span, TypeRef(words[0].span, str(words[0]), "", ""), tuple(operands)
            )
        case "call":
            return Call(span, words[0], tuple(operands))
        case "neighbors":
            first, second = words
            place = Span(source, first.span.start, second.span.end)
            return Call(span, Word(NEIGHBORS, place), tuple(operands))
        case "elapsed":
            path = words[1] if len(words) > 1 else None
            state = Ref(str(path), "Vertex", path.span) if path is not None else None
            return Elapsed(span, words[0], state)
        case "in_state":
            path = words[1]
            return InState(span, Ref(str(path), "Vertex", path.span))
        case "name":
            return NameUse(span, str(words[0]))
        case "text":
            return Value(span, unquoted(words[0]))
        case "truth":
            return Value(span, words[0] == "true")
    digits, unit = _quantity(words[0])
    return Value(span, quantity_value(digits), unit)


def differences(one: Any, other: Any, where: str = "model") -> Iterator[str]:
    """Yield the differences of two models: classes, attributes, spans."""
    if type(one) is not type(other):
        yield f"{where}: {one!r} and {other!r}"
    elif isinstance(one, (list, tuple)) and not isinstance(one, Span):
        if len(one) != len(other):
            yield f"{where}: {len(one)} and {len(other)} items"
        for number, (left, right) in enumerate(zip(one, other, strict=False)):
            yield from differences(left, right, f"{where}[{number}]")
    elif isinstance(one, (Node, Ref)):
        for attribute in fields(one):
            left, right = getattr(one, attribute.name), getattr(other, attribute.name)
            yield from differences(left, right, f"{where}.{attribute.name}")
    elif isinstance(one, Span):
        if one[1:] != other[1:]:
            yield f"{where}: {one[1:]} and {other[1:]}, {one.text!r} and {other.text!r}"
    elif one != other:
        yield f"{where}: {one!r} and {other!r}"
    elif isinstance(one, Word):
        yield from differences(one.span, other.span, f"{where}.span")
