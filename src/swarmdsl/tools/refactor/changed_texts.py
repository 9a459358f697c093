"""Try the texts of a refactoring, and refuse it if they would not mean the same."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import Path

from swarmdsl.base.diagnostics.collector import Diagnostics, Severity
from swarmdsl.base.rewriting import Change
from swarmdsl.base.source import Source, Span
from swarmdsl.driver.workspace import Workspace
from swarmdsl.driver.workspace.renaming import RefusedError
from swarmdsl.syntax.formatter import format_source

COMMENT = re.compile(r"//[^\n]*|/\*.*?\*/", re.DOTALL)
_SEPARATOR = re.compile(r"[ \t]*;")
_ENDS_LINE = re.compile(r"[ \t]*;?[ \t]*(?://[^\n]*)?(?=\n|\Z)")


def applied(text: str, changes: Sequence[Change], start: int = 0, end: int | None = None) -> str:
    """Return a text, or a part of it, with those changes that are in it."""
    end = len(text) if end is None else end
    pieces: list[str] = []
    at = start
    for first, last, new in sorted(changes):
        if start <= first and last <= end and at <= first:
            pieces += (text[at:first], new)
            at = last
    return "".join((*pieces, text[at:end]))


def statement(span: Span) -> tuple[int, int]:
    """Return the bounds of a statement with the comments that belong to it.

    They are those on its last line, and those on the lines directly above it.
    """
    text = span.source.text
    found = _ENDS_LINE.match(text, span.end)
    end = found.end() if found is not None else span.end
    start = text.rfind("\n", 0, span.start) + 1
    if text[start : span.start].strip():
        return span.start, end
    while start > 0:
        above = text.rfind("\n", 0, start - 1) + 1
        if not text[above:start].lstrip().startswith("//"):
            break
        start = above
    return start, end


def removal(span: Span) -> Change:
    """Return the change that removes a statement with its comments, and what separates it."""
    start, end = statement(span)
    found = _SEPARATOR.match(span.source.text, end)
    return start, found.end() if found is not None else end, ""


def comments_of(span: Span) -> list[str]:
    """Return the comments that belong to a statement: above it, in it and behind it."""
    start, end = statement(span)
    return COMMENT.findall(span.source.text[start:end])


def tried(workspace: Workspace, texts: Mapping[Path, str]) -> dict[Path, str]:
    """Return formatted texts; raise RefusedError if they cause an error."""
    formatted: dict[Path, str] = {}
    for path, text in texts.items():
        result = format_source(Source(str(path), text, path), Diagnostics())
        if result is None:
            raise RefusedError("the file has syntax errors")
        formatted[path] = result
    before = _errors(workspace)
    with workspace.overriding(formatted):
        new = _errors(workspace) - before
        if new:
            known = {each.code: each.message for each in reversed(list(workspace.report))}
            raise RefusedError(f"there would be an error: {known[next(iter(new))]}")
    return formatted


def _errors(workspace: Workspace) -> Counter[str]:
    report = workspace.report
    return Counter(each.code for each in report if each.severity is Severity.ERROR)
