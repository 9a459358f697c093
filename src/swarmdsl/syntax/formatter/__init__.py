"""Formatter: the canonical layout of .swarm files."""

from __future__ import annotations

from swarmdsl.base.diagnostics.collector import Diagnostics, Severity
from swarmdsl.base.source import Source
from swarmdsl.syntax.ast import Model, Send, walk
from swarmdsl.syntax.formatter.items import group_items
from swarmdsl.syntax.formatter.layout import lay_out
from swarmdsl.syntax.formatter.lines import render_lines
from swarmdsl.syntax.formatter.marks import find_marks
from swarmdsl.syntax.formatter.separators import without_separators
from swarmdsl.syntax.formatter.tokens import Tokens, content_of, tokenize
from swarmdsl.syntax.parse import parse


class MeaningChangedError(Exception):
    """Raised if formatting would change more than the layout, a bug in swarmdsl."""


def format_source(source: Source, report: Diagnostics, *, migrate: bool = False) -> str | None:
    """Format a file; None if it has errors, which are reported.

    With `migrate`, the file is of an older version: missing separators are no errors, each item
    goes on a line of its own, and `send Event after 5 s -> Target` is two of them.
    """
    found = Diagnostics()
    parsed = parse(source, found)
    if migrate and (older := _with_delays_apart(source, parsed.model)) is not None:
        source, found = older, Diagnostics()
        parsed = parse(source, found)
    allowed = ("missing-separator",) if migrate else ()
    errors = [one for one in found if one.severity is Severity.ERROR and one.name not in allowed]
    report.include(errors)
    if errors:
        return None
    tokens = Tokens(source.text)
    marks = find_marks(parsed.model, tokens)
    text = render_lines(lay_out(group_items(without_separators(tokens.all, marks), marks), marks))
    if content_of(tokenize(text)) != content_of(tokens.all):
        raise MeaningChangedError(f"the layout of {source.name} would change its content")
    return text


def _with_delays_apart(source: Source, model: Model) -> Source | None:
    """Return the file with each delay of a `send` on a line of its own, as a transition.

    None if there is none, or if that would be wrong: then the file is not of an older version.
    """
    text = source.text
    delayed = [
        node.delay.span.start
        for node in walk(model)
        if isinstance(node, Send) and node.delay is not None
    ]
    for delay in reversed(delayed):
        word = text.rindex("after", 0, delay)
        text = f"{text[:word]}\n{text[word:]}"
    older, found = Source(source.name, text, source.path), Diagnostics()
    parse(older, found)
    wrong = any(d.severity is Severity.ERROR and d.name != "missing-separator" for d in found)
    return older if delayed and not wrong else None


__all__ = ["MeaningChangedError", "format_source"]
