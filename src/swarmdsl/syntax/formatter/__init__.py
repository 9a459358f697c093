"""The canonical layout of .swarm files."""

from __future__ import annotations

from swarmdsl.base.diagnostics.collector import Diagnostics, Severity
from swarmdsl.base.source import Source
from swarmdsl.syntax.formatter.items import itemized
from swarmdsl.syntax.formatter.layout import laid_out
from swarmdsl.syntax.formatter.lines import as_text
from swarmdsl.syntax.formatter.marks import mark
from swarmdsl.syntax.formatter.tokens import Tokens, essence, tokenize
from swarmdsl.syntax.parse import parse


class MeaningChangedError(Exception):
    """Formatting would change more than the layout: a bug in swarmdsl."""


def formatted(source: Source, report: Diagnostics) -> str | None:
    """The text of a file in its canonical layout; None when it has errors, which are reported."""
    found = Diagnostics()
    parsed = parse(source, found)
    report.include(one for one in found if one.severity is Severity.ERROR)
    if found.has_errors:
        return None
    tokens = Tokens(source.text)
    marks = mark(parsed.model, tokens)
    text = as_text(laid_out(itemized(tokens.all, marks), marks))
    if essence(tokenize(text)) != essence(tokens.all):
        raise MeaningChangedError(f"the layout of {source.name} would change its content")
    return text


__all__ = ["MeaningChangedError", "formatted"]
