"""What can be read of a declaration with syntax errors, which is nearly all.

Where the parser stops, the mistake is reported and the statement it is in is mended, as
little as will do, or else left out; then the parser looks at the declaration again. What
fails in a statement that was mended has the same cause and is not reported.

All that this needs of a parser is a function from a text to its tree, or to where it had
to stop and what could have stood there: `Parser`.
"""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Callable, Iterator
from typing import get_args

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.records import replace
from swarmdsl.base.source import Source, Span
from swarmdsl.syntax.ast import Model, Vertex, Word, walk
from swarmdsl.syntax.errors.report import Failure, report_syntax_error
from swarmdsl.syntax.parser.patched_text import Draft, untouched
from swarmdsl.syntax.parser.result import Parsed
from swarmdsl.syntax.recovery.prescan import Scan
from swarmdsl.syntax.recovery.repair import mend
from swarmdsl.syntax.recovery.statements import Statement, statement_at, statements_at

Parser = Callable[[Source], Model | Failure]
"""Parses a whole source; of the failures, that furthest on."""

_ERRORS_PER_DECLARATION = 50
# Characters: what is longer is no statement that could be mended, and so much may be read to
# mend those of a declaration, so that nobody waits for seconds.
_LONGEST_MENDED = 4_000
_MOST_READ = 2_000_000
# Where one of these could stand, nothing is missing before it.
_COMPLETE = frozenset({"`}`", "EOF"})
_IDENTIFIER = re.compile(r"[A-Za-z_]\w*")


def parse_with_recovery(
    source: Source,
    scanned: Scan,
    parser: Parser,
    report: Diagnostics,
    failure: Failure | None = None,
) -> Parsed:
    """Parse a text with a syntax error, which is reported.

    `failure` is what the parser says of the text as it is, if that is known.
    """
    return _Recovery(source, scanned, parser, report).parse(failure)


class _Recovery:
    def __init__(self, source: Source, scanned: Scan, parser: Parser, report: Diagnostics) -> None:
        self._source = source
        self._scanned = scanned
        self._parser = parser
        self._report = report
        self._parsed = Parsed(Model(Span(source, 0, len(source.text)), None, [], [], []))
        self._read = 0

    def parse(self, failure: Failure | None) -> Parsed:
        """Parse what can be read of the text, of which the first failure may be known."""
        parsed, source = self._parsed, self._source
        draft = untouched(source.text).repaired(*self._scanned.repairs)
        if self._scanned.hopeless is not None:
            self._lose_names(draft.text)
            return parsed
        # Where what was reported stands; what is in the same statement is its consequence.
        known = set(self._scanned.faults)
        damaged = bool(known)
        failed: set[int] = set()
        doubtful: list[tuple[int, int]] = []
        for _ in range(_ERRORS_PER_DECLARATION):
            result = failure or self._parser(Source(source.name, draft.text))
            failure = None
            if isinstance(result, Model):
                parsed.repaired |= draft.restore(result, source)
                if damaged:
                    parsed.damaged |= {*result.declarations, *result.optimizations}
                # What a broken import leads to is anyone's guess.
                result.imports = [
                    one
                    for one in result.imports
                    if not any(start <= one.span.start < end for start, end in doubtful)
                ]
                self._lose(draft, known)
                parsed.unnamed |= {*_unnamed(result)}
                parsed.model = result
                return parsed
            silent = Diagnostics()
            at = report_syntax_error(result, source, draft, silent)
            statement = _blamed(draft.text, at, result.expected)
            span = draft.origins[statement.start], draft.origins[statement.header]
            mended = None
            short = statement.header - statement.start <= _LONGEST_MENDED
            if span[0] not in failed and short and self._read < _MOST_READ:
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
        return parsed

    def _failure(self, text: str) -> Failure | None:
        self._read += len(text)
        result = self._parser(Source(self._source.name, text))
        return result if isinstance(result, Failure) else None

    def _lose(self, draft: Draft, known: set[int]) -> None:
        """Take the names in statements with a mistake for possibly declared there."""
        inside = (bisect_right(draft.origins, at) - 1 for at in known)
        found = {(one.start, one.header) for one in statements_at(draft.text, inside)}
        for start, end in found:
            self._lose_names(draft.text[start:end])

    def _lose_names(self, text: str) -> None:
        self._parsed.lost_names |= {*_IDENTIFIER.findall(text)}


def _blamed(text: str, at: int, expected: frozenset[str]) -> Statement:
    """The statement that a complaint at `at` is about.

    A closing brace is of the block around it, and what begins a statement is not to blame for
    one before it on the line that is not complete.
    """
    before = text[:at].rstrip()
    if text[at : at + 1] == "}" and before and before[-1] not in "{}":
        return statement_at(text, len(before) - 1)
    statement = statement_at(text, at)
    same_line = before and "\n" not in text[len(before) : at]
    if same_line and statement.start == at and not expected & _COMPLETE:
        return statement_at(text, len(before) - 1)
    return statement


def _unnamed(model: Model) -> Iterator[str]:
    """What may refer to the nodes in a tree whose name could not be read."""
    for node in walk(model):
        name = getattr(node, "name", None)
        if isinstance(name, Word) and name.span.text != name:
            yield type(node).__name__
            if isinstance(node, get_args(Vertex)):
                yield "Vertex"
