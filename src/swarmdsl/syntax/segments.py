"""Split a file into segments before it is parsed, whatever errors it has.

A segment is a top-level declaration with the comments before it. Segments are parsed independently
of each other: after an edit only those that it touches are parsed again.
"""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Iterator, Sequence
from itertools import pairwise

from swarmdsl.base.diagnostics.advice import Advice
from swarmdsl.base.diagnostics.collector import Diagnostics, Label
from swarmdsl.base.source import Source, Span
from swarmdsl.syntax.ast import Model, references, walk
from swarmdsl.syntax.parser.keywords import CATEGORIES, CLAUSES, MODIFIERS, TOP_LEVEL
from swarmdsl.syntax.parser.result import Parsed
from swarmdsl.syntax.recovery.brackets import outermost

# Clauses of the first line of a declaration, such as `extends`.
_CLAUSES = sorted(word for word, owners in CLAUSES.items() if owners <= TOP_LEVEL)
# A keyword of a declaration in the first column, or what looks like one that is misspelled
# (`Event Start :`).
_START = re.compile(
    rf"^(?=(?:{'|'.join(sorted(TOP_LEVEL))})\b"
    rf"|(?!(?:{'|'.join(_CLAUSES)})\b)[A-Za-z]+[ \t]+[A-Za-z_]\w*[ \t]*[:{{])",
    re.MULTILINE,
)
# A keyword of a declaration that continues the line above, by the end of that line.
_CONTINUATIONS = {
    **{
        modifier: re.compile("|".join(targets))
        for modifier, targets in MODIFIERS.items()
        if targets <= TOP_LEVEL
    },
    ":": re.compile(rf"(?:{'|'.join(CATEGORIES)})\s*\{{"),
}

_BRACKET = re.compile(r"[{}()\[\]]")
_MARK = re.compile(r"^(?:<{7}|>{7})", re.MULTILINE)
_ON_ONE_LINE = (
    r'(?P<text>"[^"\\\n]*(?:\\[^\n][^"\\\n]*)*"?)|//[^\n]*|(?P<mark>^(?:<{7}|>{7})(?![<>])[^\n]*)'
)
_NO_CODE = re.compile(rf"{_ON_ONE_LINE}|/\*(?s:.*?)(?P<end>\*/|\Z)", re.MULTILINE)
_LINES = re.compile(_ON_ONE_LINE, re.MULTILINE)


def split_declarations(text: str) -> list[tuple[int, int]]:
    """Return the ranges of the segments of a text, without gaps."""
    starts = sorted({0, *_boundaries(text), len(text)})
    return list(pairwise(starts)) or [(0, 0)]


def is_self_contained(text: str) -> bool:
    """Return True if no bracket, comment or conflict marker of a segment extends beyond it.

    The text around such a segment is split as if it was not there.
    """
    code, _ = _code(text)
    if "/*" in code or "*/" in code or _MARK.search(text):
        return False
    depth = 0
    for bracket in _BRACKET.findall(code):
        depth += 1 if bracket in "{([" else -1
        if depth < 0:
            return False
    return depth == 0


def _boundaries(text: str) -> Iterator[int]:
    code, merges = _code(text)
    blocks = outermost(code)
    openings = [start for start, _ in blocks]
    last = 0
    for found in _START.finditer(code):
        start = found.start()
        block = bisect_right(openings, start) - 1
        if block >= 0 and start < blocks[block][1]:
            continue
        merge = bisect_right(merges, (start,)) - 1
        if merge >= 0 and start < merges[merge][1]:
            continue
        before = code[last:start].rstrip()
        if not before or _continues(before, code, start):
            continue
        # Comments belong to the next declaration, except after other text on their line.
        yield code.index("\n", last + len(before)) + 1
        last = start


def _continues(before: str, code: str, start: int) -> bool:
    """Return True if the keyword at the start of a line belongs to the declaration before it."""
    return any(
        before.endswith(last) and after.match(code, start) is not None
        for last, after in _CONTINUATIONS.items()
    )


def _code(text: str) -> tuple[str, list[tuple[int, int]]]:
    """Replace comments, with their line breaks, and strings by blanks.

    The second result are the ranges of unresolved merge conflicts.
    """
    marks: list[tuple[int, str]] = []
    base = 0

    def blank(found: re.Match[str]) -> str:
        if found["mark"]:
            marks.append((base + found.start(), found[0][0]))
        return '"' * len(found[0]) if found["text"] else " " * len(found[0])

    end = _end_of_comments(text)
    code = _NO_CODE.sub(blank, text[:end])
    base = end
    code += _LINES.sub(blank, text[end:])
    merges = [
        (first, end)
        for (first, opening), (end, closing) in pairwise(marks)
        if opening == "<" and closing == ">"
    ]
    return code, merges


def _end_of_comments(text: str) -> int:
    """Return the offset of the first unclosed comment, or the end; from there on all is code."""
    if text.rfind("/*") > text.rfind("*/"):
        for found in _NO_CODE.finditer(text):
            if found["end"] == "":
                return found.start()
    return len(text)


def join_segments(source: Source, parts: Sequence[Parsed], report: Diagnostics) -> Parsed:
    """Join the segments of a file; report a misplaced package or import."""
    parsed = Parsed(Model(Span(source, 0, len(source.text)), None, [], [], []))
    for part in parts:
        _add(part.model, parsed.model, report)
        parsed.incomplete |= part.incomplete
        parsed.skipped_names |= part.skipped_names
        parsed.repaired |= part.repaired
        parsed.anonymous_kinds |= part.anonymous_kinds
    if parsed.anonymous_kinds:
        _skip_dangling_references(parsed)
    return parsed


def _add(segment: Model, model: Model, report: Diagnostics) -> None:
    misplaced = segment.package or (segment.imports[0] if segment.imports else None)
    if segment.package and model.package:
        report.report(
            "syntax-error",
            segment.package.span,
            message="duplicate package",
            related=(Label(model.package.span, "first given here"),),
            help="delete one of the two, or split the file",
        )
    elif misplaced and (
        model.declarations or model.optimizations or (segment.package and model.imports)
    ):
        report.report(
            "syntax-error",
            misplaced.span,
            message="the package and the imports come first in a file",
            help=Advice("move it to the top of the file", "move to top"),
        )
    model.package = model.package or segment.package
    model.imports += segment.imports
    model.declarations += segment.declarations
    model.optimizations += segment.optimizations


def _skip_dangling_references(parsed: Parsed) -> None:
    """Skip unresolved references to the kinds of elements whose name could not be parsed."""
    names = {str(getattr(node, "name", "")) for node in walk(parsed.model)}
    model = parsed.model
    for owner in (*model.declarations, *model.optimizations):
        for _, ref in references(owner):
            if ref.kind in parsed.anonymous_kinds:
                parsed.skipped_names |= {ref.name} - names
