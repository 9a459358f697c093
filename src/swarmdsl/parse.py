"""One file's text to its syntax tree, with textX.

Names that refer to something are only recorded (`Ref`): textX would stop at the first
it cannot resolve. After a syntax error the file is parsed declaration by declaration,
and inside a declaration without the statement that is wrong, so that one mistake hides
neither the next one nor the names the rest of the file declares.
"""

from __future__ import annotations

import re
import sys
from bisect import bisect_right
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field, fields
from functools import cache
from itertools import pairwise
from typing import Any

from swarmdsl.diagnostics import Diagnostics, Label
from swarmdsl.expressions import parse_expression, unquoted
from swarmdsl.resources import grammar
from swarmdsl.scan import DocComment, Scan, scan
from swarmdsl.source import Source, Span
from swarmdsl.syntax import (
    NODES,
    Declaration,
    Documented,
    Expression,
    Model,
    Node,
    Ref,
    Word,
    walk,
)
from swarmdsl.syntax_errors import report_syntax_error

# textX recurses some thirty frames a level; scan.NESTING_LIMIT bounds the levels.
RECURSION_LIMIT = 20_000
_ERRORS_PER_DECLARATION = 10
# Where a top-level declaration starts: a keyword in the first column, or what looks like
# one with a slip in it (`Event Start :`).
_DECLARATION_START = re.compile(
    r"^(?=(?:package|import|struct|enum|type|const|message|service|action|swarm|event|function|"
    r"sensor|actuator|controller|virtual|member|endless|statemachine|environment|fitness|"
    r"optimize)\b|[A-Za-z]+[ \t]+[A-Za-z_]\w*[ \t]*[:{])",
    re.MULTILINE,
)
_IDENTIFIER = re.compile(r"[A-Za-z_]\w*")


@dataclass
class Parsed:
    """A file's syntax tree and what could not be read of it.

    `damaged` holds declarations with a piece missing: checks of what they lack would
    mislead. `lost_names` are the words in the text that could not be parsed; whatever is
    not found under one of these names may well be declared there.
    """

    model: Model
    damaged: set[Declaration] = field(default_factory=set)
    lost_names: set[str] = field(default_factory=set)


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
        parsed = _parse_by_declaration(source, scanned, report) if scanned.faults else None
        parsed = parsed or _parse_whole(source) or _parse_with_recovery(source, scanned, report)
    _attach_docs(parsed, scanned.docs, report)
    for node in walk(parsed.model):
        if isinstance(node, Expression):
            node.tree = parse_expression(node.span, report)
    return parsed


def _parse_whole(source: Source) -> Parsed | None:
    """Parse a file without syntax errors; None when it has one."""
    from textx import TextXSyntaxError

    try:
        return Parsed(_tree(source, source.text, 0))
    except TextXSyntaxError:
        return None


def _parse_with_recovery(source: Source, scanned: Scan, report: Diagnostics) -> Parsed:
    """Parse a file that has a syntax error, which is reported in any case."""
    from textx import TextXSyntaxError

    before = len(report)
    parsed = _parse_by_declaration(source, scanned, report)
    if len(report) == before:  # each declaration is right, but not all of them together
        try:
            _tree(source, source.text, 0)
        except TextXSyntaxError as error:
            report_syntax_error(error, source, 0, source.text, report)
    return parsed


def _parse_by_declaration(source: Source, scanned: Scan, report: Diagnostics) -> Parsed:
    model = Model(Span(source, 0, len(source.text)), None, [], [], [])
    parsed = Parsed(model)
    bounds = sorted({0, *_declaration_starts(source.text, scanned.blocks), len(source.text)})
    for start, end in pairwise(bounds):
        inside = [fault for fault in scanned.faults if start <= fault < end]
        piece, lost = _parse_piece(source, start, end, inside, report)
        if lost:
            parsed.damaged.update(piece.declarations if piece else ())
            parsed.lost_names.update(_IDENTIFIER.findall(lost))
        if piece is None:
            continue
        misplaced = piece.package or (piece.imports[0] if piece.imports else None)
        if piece.package and model.package:
            report.report(
                "syntax-error",
                piece.package.span,
                message="a file has one package",
                related=(Label(model.package.span, "it is given here"),),
            )
        elif misplaced and (model.declarations or (piece.package and model.imports)):
            report.report(
                "syntax-error",
                misplaced.span,
                message="the package and the imports stand at the top of the file",
            )
        model.package = model.package or piece.package
        model.imports += piece.imports
        model.declarations += piece.declarations
        model.optimizations += piece.optimizations
    return parsed


def _declaration_starts(text: str, blocks: tuple[tuple[int, int], ...]) -> Iterator[int]:
    """Where declarations start that are not inside a block."""
    openings = [start for start, _ in blocks]
    for found in _DECLARATION_START.finditer(text):
        before = bisect_right(openings, found.start()) - 1
        if before < 0 or blocks[before][1] < found.start():
            yield found.start()


def _parse_piece(
    source: Source, start: int, end: int, faults: list[int], report: Diagnostics
) -> tuple[Model | None, str]:
    """Parse one declaration; return it, None if nothing of it is left, and the lost text.

    What stands at `faults` has been reported already and is left out from the start.
    """
    from textx import TextXSyntaxError

    text = source.text[start:end]
    brackets = {source.text[fault] for fault in faults} & {"{", "(", "["}
    if "{" in brackets:
        return None, text  # where the blocks end is anyone's guess
    if brackets:
        report = Diagnostics()  # what follows may well be inside the bracket
    lost = ""
    wrong = [fault - start for fault in faults]
    for _ in range(_ERRORS_PER_DECLARATION):
        if not wrong:
            try:
                return _tree(source, text, start), lost
            except TextXSyntaxError as error:
                wrong = [report_syntax_error(error, source, start, text, report) - start]
        statement = _statement(text, wrong.pop())
        if statement is None:
            break
        lost += " " + text[slice(*statement)]
        text = _blanked(text, *statement)
    return None, lost + " " + text


def _statement(text: str, at: int) -> tuple[int, int] | None:
    """The lines of the statement around an offset, with its block; None for the declaration."""
    start = text.rfind("\n", 0, at) + 1
    end = text.find("\n", at)
    end = len(text) if end < 0 else end
    if not text[:start].strip() or not text[start:end].strip(" \t\r}"):
        return None
    depth = 0
    for found in re.finditer(r'"(?:[^"\\\n]|\\[^\n])*"|//[^\n]*|[{}]', text[start:]):
        position = start + found.start()
        if position >= end and depth == 0:
            break
        depth += {"{": 1, "}": -1}.get(found[0], 0)
        if depth < 0:
            return None
        if position >= end and depth == 0:
            end = position + 1
            break
    return (start, end) if depth == 0 else None


def _blanked(text: str, start: int, end: int) -> str:
    return text[:start] + re.sub(r"[^\n]", " ", text[start:end]) + text[end:]


def _tree(source: Source, text: str, offset: int) -> Model:
    """Parse `text`, which stands at `offset` of the source; raises TextXSyntaxError."""
    made = metamodel().model_from_str(text)
    span = Span(source, offset, offset + len(text))
    if isinstance(made, str):  # textX makes no model of nothing
        return Model(span, None, [], [], [])
    model = _converted(made, source, offset)
    assert isinstance(model, Model)
    model.span = span
    return model


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
    """Give each `///` comment to the declaration that follows it."""
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
            report.report("unattached-doc-comment", doc.span)


@contextmanager
def _deep_recursion() -> Iterator[None]:
    limit = sys.getrecursionlimit()
    sys.setrecursionlimit(max(limit, RECURSION_LIMIT))
    try:
        yield
    finally:
        sys.setrecursionlimit(limit)


__all__ = ["Node", "Parsed", "metamodel", "parse"]
