"""Where the declarations of a file begin, known before it is parsed and whatever is wrong with it.

A piece is what a file can be cut into and put together again: a declaration with the comments
before it. What stands in one piece does not change how another one is read, so that after an
edit only the pieces it touches are parsed again.
"""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Iterator, Sequence
from itertools import pairwise

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


def split(text: str) -> list[tuple[int, int]]:
    """The offsets of the pieces of a text, which together are all of it."""
    starts = sorted({0, *_boundaries(text), len(text)})
    return list(pairwise(starts)) or [(0, 0)]


def is_closed(text: str) -> bool:
    """Whether nothing in a piece of a text reaches out of it: no bracket, comment or merge.

    What is around such a piece is cut as if it was not there.
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
        # Comments belong to what they stand before, unless they stand behind something.
        yield code.index("\n", last + len(before)) + 1
        last = start


def _continues(before: str, code: str, start: int) -> bool:
    """Whether what stands at the start of a line belongs to the declaration before it."""
    return any(
        before.endswith(last) and after.match(code, start) is not None
        for last, after in _CONTINUATIONS.items()
    )


def _code(text: str) -> tuple[str, list[tuple[int, int]]]:
    """The text with blanks for comments, also their ends of lines, and what is in quotes.

    With it come the pieces in which a merge was not finished.
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
    """Where a comment begins that has no end; it is code, and no other has one behind it."""
    if text.rfind("/*") > text.rfind("*/"):
        for found in _NO_CODE.finditer(text):
            if found["end"] == "":
                return found.start()
    return len(text)


def joined(source: Source, parts: Sequence[Parsed], report: Diagnostics) -> Parsed:
    """The pieces of a file as one, with a report of what stands in the wrong order."""
    parsed = Parsed(Model(Span(source, 0, len(source.text)), None, [], [], []))
    for part in parts:
        _add(part.model, parsed.model, report)
        parsed.damaged |= part.damaged
        parsed.lost_names |= part.lost_names
        parsed.repaired |= part.repaired
        parsed.unnamed |= part.unnamed
    if parsed.unnamed:
        _lose_references(parsed)
    return parsed


def _add(piece: Model, model: Model, report: Diagnostics) -> None:
    misplaced = piece.package or (piece.imports[0] if piece.imports else None)
    if piece.package and model.package:
        report.report(
            "syntax-error",
            piece.package.span,
            message="a file has one package",
            related=(Label(model.package.span, "it is given here"),),
            help="delete one of the two, or make two files",
        )
    elif misplaced and (
        model.declarations or model.optimizations or (piece.package and model.imports)
    ):
        report.report(
            "syntax-error",
            misplaced.span,
            message="the package and the imports stand at the top of the file",
            help="move it up",
        )
    model.package = model.package or piece.package
    model.imports += piece.imports
    model.declarations += piece.declarations
    model.optimizations += piece.optimizations


def _lose_references(parsed: Parsed) -> None:
    """Take names that nothing has for those of what has none."""
    names = {str(getattr(node, "name", "")) for node in walk(parsed.model)}
    model = parsed.model
    for owner in (*model.declarations, *model.optimizations):
        for _, ref in references(owner):
            if ref.kind in parsed.unnamed:
                parsed.lost_names |= {ref.name} - names
