"""What can be read of a file with syntax errors: all but the statements that are wrong.

The file is parsed declaration by declaration, and inside a declaration without the
statement that is wrong, so that one mistake hides neither the next one nor the names the
rest of the file declares.

All that this needs of a parser is a function from a text to its tree, or to where it had
to stop and what could have stood there: `Parser`.
"""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from itertools import pairwise

from swarmdsl.diagnostics import Diagnostics, Label
from swarmdsl.scan import Scan
from swarmdsl.source import Source, Span
from swarmdsl.syntax import Declaration, Model
from swarmdsl.syntax_errors import Failure, report_syntax_error

Parser = Callable[[Source, str, int], Model | Failure]
"""Parses a text that stands at an offset of a source; of the failures, that furthest on."""

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


def parse_with_recovery(
    source: Source, scanned: Scan, failure: Failure | None, parser: Parser, report: Diagnostics
) -> Parsed:
    """Parse a file that has a syntax error, which is reported in any case.

    `failure` is where the parser stopped; None where it was not asked, for the scan has
    found a mistake.
    """
    before = len(report)
    parsed = _parse_by_declaration(source, scanned, parser, report)
    if failure and len(report) == before:  # each declaration is right, but not all together
        report_syntax_error(failure, source, 0, source.text, report)
    return parsed


def _parse_by_declaration(
    source: Source, scanned: Scan, parser: Parser, report: Diagnostics
) -> Parsed:
    model = Model(Span(source, 0, len(source.text)), None, [], [], [])
    parsed = Parsed(model)
    bounds = sorted({0, *_declaration_starts(source.text, scanned.blocks), len(source.text)})
    for start, end in pairwise(bounds):
        inside = [fault for fault in scanned.faults if start <= fault < end]
        piece, lost = _parse_piece(source, start, end, inside, parser, report)
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
    source: Source,
    start: int,
    end: int,
    faults: list[int],
    parser: Parser,
    report: Diagnostics,
) -> tuple[Model | None, str]:
    """Parse one declaration; return it, None if nothing of it is left, and the lost text.

    What stands at `faults` has been reported already and is left out from the start.
    """
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
            result = parser(source, text, start)
            if isinstance(result, Model):
                return result, lost
            wrong = [report_syntax_error(result, source, start, text, report) - start]
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
