"""What can be read of a file with syntax errors, which is nearly all.

The file is parsed declaration by declaration. Where the parser stops in one, the mistake is
reported and the statement it is in is mended, as little as will do, or else left out; then
the parser looks at the declaration again. What fails in a statement that was mended has the
same cause and is not reported.

All that this needs of a parser is a function from a text to its tree, or to where it had
to stop and what could have stood there: `Parser`.
"""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field, fields, replace
from itertools import pairwise
from typing import get_args

from swarmdsl.brackets import outermost
from swarmdsl.diagnostics import Diagnostics, Label
from swarmdsl.draft import Draft, untouched
from swarmdsl.repairs import mend
from swarmdsl.scan import Scan
from swarmdsl.source import Source, Span
from swarmdsl.statements import statement_at
from swarmdsl.syntax import Declaration, Expression, Model, Ref, Vertex, Word, walk
from swarmdsl.syntax_errors import Failure, report_syntax_error

Parser = Callable[[Source], Model | Failure]
"""Parses a whole source; of the failures, that furthest on."""

_ERRORS_PER_DECLARATION = 50
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
    mislead. `lost_names` are the words in statements that could not be parsed; whatever is
    not found under one of these names may well be declared there. `repaired` are the
    expressions that were read otherwise than they are written.
    """

    model: Model
    damaged: set[Declaration] = field(default_factory=set)
    lost_names: set[str] = field(default_factory=set)
    repaired: set[Expression] = field(default_factory=set)


def parse_with_recovery(
    source: Source, scanned: Scan, failure: Failure | None, parser: Parser, report: Diagnostics
) -> Parsed:
    """Parse a file that has a syntax error, which is reported in any case.

    `failure` is where the parser stopped; None where it was not asked, for the scan has
    found a mistake.
    """
    before = len(report)
    parsed = _Recovery(source, scanned, parser, report).parse()
    if failure and len(report) == before:  # each declaration is right, but not all together
        report_syntax_error(failure, source, untouched(source.text), report)
    return parsed


class _Recovery:
    def __init__(self, source: Source, scanned: Scan, parser: Parser, report: Diagnostics) -> None:
        self._source = source
        self._scanned = scanned
        self._parser = parser
        self._report = report
        self._unnamed: set[str] = set()  # kinds of what has no name that could be read
        self._parsed = Parsed(Model(Span(source, 0, len(source.text)), None, [], [], []))

    def parse(self) -> Parsed:
        """Parse the file declaration by declaration."""
        draft = untouched(self._source.text)
        for repair in reversed(self._scanned.repairs):
            draft = draft.repaired(repair)
        starts = _declaration_starts(draft.text)
        for start, end in pairwise(sorted({0, *starts, len(draft.text)})):
            piece = self._parse_piece(draft.piece(start, end))
            if piece is not None:
                self._add(piece)
        self._lose_references()
        return self._parsed

    def _lose_references(self) -> None:
        """Take names that nothing has for those of what has none."""
        names = {str(getattr(node, "name", "")) for node in walk(self._parsed.model)}
        for node in walk(self._parsed.model):
            for value in (getattr(node, one.name) for one in fields(node)):
                if isinstance(value, Ref) and value.kind in self._unnamed:
                    self._parsed.lost_names.update({value.name} - names)

    def _add(self, piece: Model) -> None:
        model = self._parsed.model
        misplaced = piece.package or (piece.imports[0] if piece.imports else None)
        if piece.package and model.package:
            self._report.report(
                "syntax-error",
                piece.package.span,
                message="a file has one package",
                related=(Label(model.package.span, "it is given here"),),
                help="delete one of the two, or make two files",
            )
        elif misplaced and (model.declarations or (piece.package and model.imports)):
            self._report.report(
                "syntax-error",
                misplaced.span,
                message="the package and the imports stand at the top of the file",
                help="move it up",
            )
        model.package = model.package or piece.package
        model.imports += piece.imports
        model.declarations += piece.declarations
        model.optimizations += piece.optimizations

    def _parse_piece(self, draft: Draft) -> Model | None:
        """Parse one declaration; None if nothing of it is left."""
        parsed, source = self._parsed, self._source
        begin, end = draft.origins[0], draft.origins[-1]
        hopeless = self._scanned.hopeless
        if hopeless is not None and begin <= hopeless < end:
            parsed.lost_names.update(_IDENTIFIER.findall(draft.text))
            return None
        # Where what was reported stands; what is in the same statement is its consequence.
        known = {fault for fault in self._scanned.faults if begin <= fault < end}
        damaged = bool(known)
        failed: set[int] = set()
        doubtful: list[tuple[int, int]] = []
        for _ in range(_ERRORS_PER_DECLARATION):
            result = self._parser(Source(source.name, draft.text))
            if isinstance(result, Model):
                parsed.repaired |= draft.restore(result, source)
                if damaged:
                    parsed.damaged.update(result.declarations)
                # What a broken import leads to is anyone's guess.
                result.imports = [
                    one
                    for one in result.imports
                    if not any(start <= one.span.start < end for start, end in doubtful)
                ]
                self._lose(draft, known)
                self._unnamed.update(_unnamed(result))
                return result
            silent = Diagnostics()
            at = report_syntax_error(result, source, draft, silent)
            statement = statement_at(draft.text, _in_statement(draft.text, at))
            span = draft.origins[statement.start], draft.origins[statement.header]
            mended = None
            if span[0] not in failed:
                mended = mend(draft, statement, self._failure)
            failed.add(span[0])
            if not any(span[0] <= place <= span[1] for place in known):
                advice = mended.help if mended else None
                self._report.include(replace(one, help=one.help or advice) for one in silent)
            known.add(draft.origins[at])
            if mended is not None:
                if not mended.whole:
                    doubtful.append((span[0], span[1]))
                self._lose_names(draft.text[statement.start : statement.header] + " _")
                damaged = damaged or not mended.whole
                draft = mended.draft
            else:
                self._lose_names(draft.text[statement.start : statement.end])
                damaged = True
                draft = draft.blanked(statement.start, max(statement.end, statement.start + 1))
        self._lose_names(draft.text)
        return None

    def _failure(self, text: str) -> Failure | None:
        result = self._parser(Source(self._source.name, text))
        return result if isinstance(result, Failure) else None

    def _lose(self, draft: Draft, known: set[int]) -> None:
        """Take the names in statements with a mistake for possibly declared there."""
        for at in known:
            inside = bisect_right(draft.origins, at) - 1
            statement = statement_at(draft.text, inside)
            self._lose_names(draft.text[statement.start : statement.header])

    def _lose_names(self, text: str) -> None:
        self._parsed.lost_names.update(_IDENTIFIER.findall(text))


def _in_statement(text: str, at: int) -> int:
    """An offset in the statement that a complaint at `at` is about.

    A closing brace is of the block around it: what is wrong is what it ends.
    """
    before = text[:at].rstrip()
    ended = text[at : at + 1] == "}" and before and before[-1] not in "{}"
    return len(before) - 1 if ended else at


def _unnamed(model: Model) -> Iterator[str]:
    """What may refer to the nodes in a tree whose name could not be read."""
    for node in walk(model):
        name = getattr(node, "name", None)
        if isinstance(name, Word) and name.span.text != name:
            yield type(node).__name__
            if isinstance(node, get_args(Vertex)):
                yield "Vertex"


def _declaration_starts(text: str) -> Iterator[int]:
    """Where declarations start that are not inside a block or comment."""
    code = _NO_CODE.sub(lambda found: re.sub(r"[^\n]", " ", found[0]), text)
    blocks = outermost(code)
    openings = [start for start, _ in blocks]
    for found in _DECLARATION_START.finditer(code):
        before = bisect_right(openings, found.start()) - 1
        if before < 0 or blocks[before][1] < found.start():
            yield found.start()


_NO_CODE = re.compile(r'"(?:[^"\\\n]|\\[^\n])*"|//[^\n]*|/\*(?:[^*]|\*(?!/))*\*/')
