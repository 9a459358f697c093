"""Parse a file to its syntax tree.

The generated parser (`parser.generated`) accepts or rejects a whole file. A rejected file is split
into segments; for each rejected segment `recovery.prescan` looks for lexical errors, a slower
parser (`parser.failure_finder`) finds the place of the failure, and `recovery.recover` parses the
rest. All of that is imported with the first syntax error.
"""

from __future__ import annotations

import gc
import re
import warnings
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from functools import partial
from typing import TYPE_CHECKING

from swarmdsl.base.diagnostics.advice import Advice
from swarmdsl.base.diagnostics.collector import Diagnostic, Diagnostics, Severity, placed
from swarmdsl.base.resources import checkout_root, grammar_checksum
from swarmdsl.base.source import Source, Span
from swarmdsl.syntax.ast import Documented, Expression, Model, walk
from swarmdsl.syntax.parser import generated
from swarmdsl.syntax.parser.doc_comments import DocComment, documentation
from swarmdsl.syntax.parser.expressions import TooDeepError, report_fault
from swarmdsl.syntax.parser.result import NESTING_LIMIT, Parsed

if TYPE_CHECKING:
    from swarmdsl.syntax.errors.report import Failure

# With less nesting of blocks, and of expressions, there are fewer nested brackets than the limit.
_SHALLOW = NESTING_LIMIT // 4


def parse(source: Source, report: Diagnostics) -> Parsed:
    """Parse a file; report syntax errors and leave them out of the tree."""
    with no_garbage_collection():
        return parse_strict(source, report) or _parse_segments(source, report)


def parse_segment(source: Source, report: Diagnostics) -> Parsed:
    """Parse a segment of a file; all spans are offsets in the segment."""
    with no_garbage_collection():
        return parse_strict(source, report) or _parse_with_recovery(source, report)


def _parse_segments(source: Source, report: Diagnostics) -> Parsed:
    from swarmdsl.syntax.parser.patched_text import PatchedText
    from swarmdsl.syntax.segments import join_segments, split_declarations

    parts = []
    for start, end in split_declarations(source.text):
        segment = Source(source.name, source.text[start:end], source.path)
        found = Diagnostics()
        part = parse_segment(segment, found)
        patched = PatchedText(segment.text, range(start, end + 1))
        patched.restore(part.model, source)
        moved = partial(_moved, source, start)
        report.include(placed(one, moved) for one in found)
        parts.append(part)
    return join_segments(source, parts, report)


def _moved(source: Source, base: int, span: Span) -> Span:
    return Span(source, base + span.start, base + span.end)


def parse_strict(source: Source, report: Diagnostics) -> Parsed | None:
    """Parse a file without syntax errors; None if it has any, or may have."""
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
        if comment.next in docs:  # no node has taken it
            _report_unattached(comment, report)
    _report_missing_separators(model, report)
    parsed = Parsed(model)
    if faults:
        _report_faults(parsed, report)
    return parsed


def _parse_with_recovery(source: Source, report: Diagnostics) -> Parsed:
    from swarmdsl.syntax.recovery.prescan import scan
    from swarmdsl.syntax.recovery.recover import parse_with_recovery

    if checkout_root() and grammar_checksum() != generated.GRAMMAR:
        warnings.warn("grammar/*.tx has changed: run `make parser`", stacklevel=3)
    scanned = scan(source, report)
    # The text was rejected before, as wrong or as nested deeply.
    whole = None if scanned.faults else _failure(source) or _parse_text(source)
    if isinstance(whole, Model):
        parsed = Parsed(whole)
    else:
        parsed = parse_with_recovery(source, scanned, _parse_text, report, whole)
    errors = [found for found in report if found.severity is Severity.ERROR]
    _attach(parsed, scanned.docs, report)
    _report_missing_separators(parsed.model, report, errors)
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
    """Find the first syntax error of a text; None if it has none."""
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


def _report_missing_separators(
    model: Model, report: Diagnostics, errors: Iterable[Diagnostic] = ()
) -> None:
    """Report lines with items that are not separated.

    Lines with one of the syntax errors, and those after them, are left out: a repair may have
    joined items there.
    """
    if not model.missing_separators:
        return
    wrong = [_line_in_source(found.primary.span) for found in errors if found.primary is not None]
    known = {*wrong, *(line + 1 for line in wrong)}
    for separator in model.missing_separators:
        span = separator.span
        line = _line_in_source(span)
        # A repair may have put a word where the text has none.
        if line in known or not span.text.strip():
            continue
        known.add(line)
        report.report(
            "missing-separator",
            span,
            separator=separator,
            what="entry" if separator == "," else "statement",
            help=_bracket_hint(span)
            if span.text == "["
            else Advice(
                f"begin it on a line of its own, or write `{separator}` before it; "
                "`swarmc fmt --migrate` does so in whole files",
                "separate",
                str(separator),
            ),
        )


def _bracket_hint(bracket: Span) -> str:
    """Hint for a guard in the wrong place, or the number of a robot after a space."""
    before = bracket.source.text[: bracket.start].rstrip()
    if re.search(r"\bto\s+\w+\Z", before):
        return "write no space before the number of a robot, as in `to uav[1]`"
    return "write a guard before `/`: `on event [guard] / effect -> Target`"


def _line_in_source(span: Span) -> int:
    """Return the line in the parsed text: the offset of a segment in its file is not set yet."""
    return Source.line_column(span.source, span.start)[0]


def _report_faults(parsed: Parsed, report: Diagnostics) -> None:
    """Report expressions without a tree."""
    for node in walk(parsed.model):
        if isinstance(node, Expression) and node.tree is None and node not in parsed.repaired:
            report_fault(generated.LANGUAGE, node.span, report)


def _attach(parsed: Parsed, comments: tuple[DocComment, ...], report: Diagnostics) -> None:
    """Attach each `///` comment to the node that begins after it."""
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
        elif not parsed.skipped_names:
            _report_unattached(comment, report)


def _report_unattached(comment: DocComment, report: Diagnostics) -> None:
    report.report(
        "unattached-doc-comment",
        comment.span,
        help=Advice(
            "move it to the line before a declaration or statement, or begin it with `//`",
            "begin comment",
            "//",
        ),
    )


@contextmanager
def no_garbage_collection() -> Iterator[None]:
    """Pause garbage collection: a growing tree has no garbage."""
    was_enabled = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if was_enabled:
            gc.enable()


__all__ = ["Parsed", "no_garbage_collection", "parse", "parse_segment", "parse_strict"]
