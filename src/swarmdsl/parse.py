"""One file's text to its syntax tree, with textX.

Names that refer to something are only recorded (`Ref`): textX would stop at the first
it cannot resolve. It stops at the first syntax error too; `recovery` goes on from there.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import fields
from functools import cache
from typing import Any

from swarmdsl.diagnostics import Diagnostics
from swarmdsl.expressions import parse_expression, unquoted
from swarmdsl.recovery import Parsed, parse_with_recovery
from swarmdsl.resources import grammar
from swarmdsl.scan import DocComment, scan
from swarmdsl.source import Source, Span
from swarmdsl.syntax import (
    NODES,
    Documented,
    Expression,
    Model,
    Node,
    Ref,
    Word,
    walk,
)
from swarmdsl.syntax_errors import TERMINALS, Failure

# textX recurses some thirty frames a level; scan.NESTING_LIMIT bounds the levels.
RECURSION_LIMIT = 20_000


@cache
def metamodel() -> Any:
    """The textX metamodel of the language; references stay unresolved."""
    from textx import metamodel_from_file

    made = metamodel_from_file(str(grammar() / "swarm.tx"), autokwd=True)
    made.register_scope_providers({"*.*": lambda _object, _attribute, reference: reference})
    return made


def parse(source: Source, report: Diagnostics) -> Parsed:
    """Parse a file; whatever is wrong with it is reported and left out of the tree."""
    scanned = scan(source, report)
    with _deep_recursion():
        whole = None if scanned.faults else _tree(source, source.text, 0)
        if isinstance(whole, Model):
            parsed = Parsed(whole)
        else:
            parsed = parse_with_recovery(source, scanned, whole, _tree, report)
    _attach_docs(parsed, scanned.docs, report)
    for node in walk(parsed.model):
        if isinstance(node, Expression) and node not in parsed.repaired:
            node.tree = parse_expression(node.span, report)
    return parsed


def _tree(source: Source, text: str, offset: int) -> Model | Failure:
    """Parse `text`, which stands at `offset` of the source."""
    from textx import TextXSyntaxError

    try:
        made = metamodel().model_from_str(text)
    except TextXSyntaxError as error:
        expected = (rule for rule in error.expected_rules if rule.rule_name != "Comment")
        # The offset of the error is known to the parser below textX only.
        return Failure(error.__cause__.position, frozenset(map(_terminal, expected)))
    span = Span(source, offset, offset + len(text))
    if isinstance(made, str):  # textX makes no model of nothing
        return Model(span, None, [], [], [])
    model = _converted(made, source, offset)
    assert isinstance(model, Model)
    model.span = span
    return model


def _terminal(rule: Any) -> str:
    return rule.rule_name if rule.rule_name in TERMINALS else f"`{getattr(rule, 'to_match', '')}`"


# Rules that find where an expression ends.
_EXPRESSIONS = frozenset({"Expression", "Operand", "Delay"})
# Rules whose object is one word with its place.
_WORDS = frozenset({"Name", "FieldName", "InterfaceName", "PackageName", "Text"})


def _converted(made: Any, source: Source, offset: int) -> Any:
    """The node of a textX object, with all below it."""
    if isinstance(made, list):
        return [_converted(item, source, offset) for item in made]
    if made is None or isinstance(made, (str, bool)):
        return made
    if hasattr(made, "obj_name"):  # an unresolved textX reference
        start = offset + made.position
        span = Span(source, start, start + len(made.obj_name))
        return Ref(made.obj_name, made.cls.__name__, span)
    span = Span(source, offset + made._tx_position, offset + made._tx_position_end)
    rule = type(made).__name__
    if rule in _WORDS:
        return Word(unquoted(made.text) if rule == "Text" else made.text, span)
    if rule in _EXPRESSIONS:
        return Expression(span)
    node = NODES[rule]
    attributes = {
        attribute.name: _converted(getattr(made, attribute.name), source, offset)
        for attribute in fields(node)
        if attribute.init and attribute.name != "span"
    }
    return node(span, **attributes)


def _attach_docs(parsed: Parsed, docs: tuple[DocComment, ...], report: Diagnostics) -> None:
    """Give each `///` comment to what begins behind it."""
    if not docs:
        return
    documented: dict[int, Documented] = {}
    for node in walk(parsed.model):
        if isinstance(node, Documented):
            documented.setdefault(node.span.start, node)
    for doc in docs:
        owner = documented.get(doc.next)
        if owner is not None:
            owner.doc = doc.text
        elif not parsed.lost_names:
            report.report(
                "unattached-doc-comment",
                doc.span,
                help="move it to the line before what it documents, or begin it with `//`",
            )


@contextmanager
def _deep_recursion() -> Iterator[None]:
    limit = sys.getrecursionlimit()
    sys.setrecursionlimit(max(limit, RECURSION_LIMIT))
    try:
        yield
    finally:
        sys.setrecursionlimit(limit)


__all__ = ["Node", "Parsed", "metamodel", "parse"]
