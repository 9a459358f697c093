"""Selection ranges: from the word outwards to the file."""

from __future__ import annotations

from swarmdsl.base.source import Span
from swarmdsl.driver.workspace.references import owners
from swarmdsl.ide.server.completion import word_at
from swarmdsl.project.loader import File
from swarmdsl.syntax.ast import Node, children


def selection_ranges(file: File, offset: int) -> list[Span]:
    """Return the spans around an offset, innermost first."""
    whole = Span(file.source, 0, len(file.source.text))
    found = [whole]
    inside: list[Node] = [*owners(file), *file.model.imports]
    while True:
        spans = [(each.span.absolute, each) for each in inside]
        around = [(span, each) for span, each in spans if span.start <= offset <= span.end]
        if not around:
            break
        span, node = min(around, key=lambda one: one[0].end - one[0].start)
        if _strictly_inside(span, found[-1]):
            found.append(span)
        inside = [*children(node)]
    word = Span(file.source, *word_at(file.source.text, offset))
    if word.text and _strictly_inside(word, found[-1]):
        found.append(word)
    return found[::-1]


def _strictly_inside(inner: Span, outer: Span) -> bool:
    """Return True if a span is strictly inside another one."""
    return (outer.start, outer.end) != (inner.start, inner.end) and (
        outer.start <= inner.start and inner.end <= outer.end
    )
