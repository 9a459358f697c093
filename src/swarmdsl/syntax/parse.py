"""One file's text to its syntax tree.

`swarm_parser`, which is made from the grammar, parses a file or refuses it. Then it is cut
into pieces (`pieces`), and for those that are refused the rest comes in: a closer look
(`scan`), a slower parser that knows where it had to stop (`peg.machine`), and what makes the
best of it (`recovery`). All of that is imported with the first syntax error.
"""

from __future__ import annotations

import gc
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from typing import TYPE_CHECKING

from swarmdsl.base.diagnostics.collector import Diagnostics, placed
from swarmdsl.base.resources import checkout_root, grammar_checksum
from swarmdsl.base.source import Source, Span
from swarmdsl.syntax.ast import Documented, Expression, Model, walk
from swarmdsl.syntax.parser import generated
from swarmdsl.syntax.parser.doc_comments import DocComment, documentation
from swarmdsl.syntax.parser.expressions import TooDeepError, report_fault
from swarmdsl.syntax.parser.result import NESTING_LIMIT, Parsed

if TYPE_CHECKING:
    from swarmdsl.syntax.errors.report import Failure

# What is nested less than that, by itself and in expressions, has fewer brackets in each
# other than the limit: nobody needs to count them.
_SHALLOW = NESTING_LIMIT // 4


def parse(source: Source, report: Diagnostics) -> Parsed:
    """Parse a file; whatever is wrong with it is reported and left out of the tree."""
    with no_garbage_collection():
        return parse_flawless(source, report) or _parse_in_pieces(source, report)


def parse_piece(source: Source, report: Diagnostics) -> Parsed:
    """Parse a piece of a file on its own; all places are places in the piece."""
    with no_garbage_collection():
        return parse_flawless(source, report) or _parse_carefully(source, report)


def _parse_in_pieces(source: Source, report: Diagnostics) -> Parsed:
    from swarmdsl.syntax.parser.patched_text import Draft
    from swarmdsl.syntax.segments import joined, split

    parts = []
    for start, end in split(source.text):
        piece = Source(source.name, source.text[start:end], source.path)
        found = Diagnostics()
        part = parse_piece(piece, found)
        draft = Draft(piece.text, range(start, end + 1))
        draft.restore(part.model, source)
        moved = partial(_moved, source, start)
        report.include(placed(one, moved) for one in found)
        parts.append(part)
    return joined(source, parts, report)


def _moved(source: Source, base: int, span: Span) -> Span:
    return Span(source, base + span.start, base + span.end)


def parse_flawless(source: Source, report: Diagnostics) -> Parsed | None:
    """Parse a file without syntax errors; None where it has some, or may have."""
    found = Diagnostics()
    comments = documentation(source, found)
    docs = {comment.next: comment.text for comment in comments}
    try:
        made = generated.parse(source, docs, _SHALLOW)
    except TooDeepError:
        return None
    if made is None:
        return None
    model, faults = made
    model.span = Span(source, 0, len(source.text))
    report.include(found)
    for comment in comments:
        if comment.next in docs:  # nothing has taken it
            _report_unattached(comment, report)
    parsed = Parsed(model)
    if faults:
        _report_faults(parsed, report)
    return parsed


def _parse_carefully(source: Source, report: Diagnostics) -> Parsed:
    from swarmdsl.syntax.recovery.prescan import scan
    from swarmdsl.syntax.recovery.recover import parse_with_recovery

    if checkout_root() and grammar_checksum() != generated.GRAMMAR:
        warnings.warn("grammar/*.tx has changed: run `make parser`", stacklevel=3)
    scanned = scan(source, report)
    # What was refused before is wrong or nested deeply: it need not be parsed again to be wrong.
    whole = None if scanned.faults else _failure(source) or _parse_text(source)
    if isinstance(whole, Model):
        parsed = Parsed(whole)
    else:
        parsed = parse_with_recovery(source, scanned, _parse_text, report, whole)
    _attach(parsed, scanned.docs, report)
    _report_faults(parsed, report)
    return parsed


def _parse_text(source: Source) -> Model | Failure:
    made = generated.parse(source, {}, NESTING_LIMIT)
    if made is not None:
        model, _ = made
        model.span = Span(source, 0, len(source.text))
        return model
    failure = _failure(source)
    assert failure is not None, "the two parsers disagree"
    return failure


def _failure(source: Source) -> Failure | None:
    """Where a text departs from the grammar, if it does."""
    from swarmdsl.syntax.errors.report import TERMINALS, Failure
    from swarmdsl.syntax.parser.failure_finder import mismatch

    found = mismatch(generated.PROGRAM, generated.TERMINALS, generated.BLANK, source.text)
    if found is None:
        return None
    expected = (
        name if name in TERMINALS else f"`{literal or regex}`"
        for regex, name, literal in found.expected
    )
    return Failure(found.at, frozenset(expected))


def _report_faults(parsed: Parsed, report: Diagnostics) -> None:
    """Report what is wrong with expressions."""
    for node in walk(parsed.model):
        if isinstance(node, Expression) and node.tree is None and node not in parsed.repaired:
            report_fault(generated.LANGUAGE, node.span, report)


def _attach(parsed: Parsed, comments: tuple[DocComment, ...], report: Diagnostics) -> None:
    """Give each `///` comment to what begins behind it."""
    if not comments:
        return
    documented: dict[int, Documented] = {}
    for node in walk(parsed.model):
        if isinstance(node, Documented):
            documented.setdefault(node.span.start, node)
    for comment in comments:
        owner = documented.get(comment.next)
        if owner is not None:
            owner.doc = comment.text
        elif not parsed.lost_names:
            _report_unattached(comment, report)


def _report_unattached(comment: DocComment, report: Diagnostics) -> None:
    report.report(
        "unattached-doc-comment",
        comment.span,
        help="move it to the line before what it documents, or begin it with `//`",
    )


@contextmanager
def no_garbage_collection() -> Iterator[None]:
    """Let the collector rest: a tree grows fast, and there is no garbage in it."""
    was_enabled = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if was_enabled:
            gc.enable()


__all__ = ["Parsed", "no_garbage_collection", "parse", "parse_flawless", "parse_piece"]
