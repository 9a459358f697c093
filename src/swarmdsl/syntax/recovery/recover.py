"""Parse a declaration with syntax errors.

Where the parser stops, the error is reported, and the statement around it is repaired with the
smallest change, or deleted; then the declaration is parsed again. Further errors in a repaired
statement have the same cause and are not reported.

The parser is a function from a source to a tree or a failure: `Parser`.
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
from swarmdsl.syntax.parser.patched_text import PatchedText
from swarmdsl.syntax.parser.result import Parsed
from swarmdsl.syntax.recovery.prescan import ScanResult
from swarmdsl.syntax.recovery.repair import repair_statement
from swarmdsl.syntax.recovery.statements import Statement, statement_at, statements_at

Parser = Callable[[Source], Model | Failure]
"""Parses a whole source; returns the farthest failure if it cannot."""

_MAX_ERRORS_PER_SEGMENT = 50
# In characters: longer statements are not repaired, and all attempts for one segment together
# parse at most so much. Otherwise a large broken file would take seconds.
_MAX_STATEMENT_LENGTH = 4_000
_MAX_PARSED_LENGTH = 2_000_000
# If one of these is expected, the text before is complete.
_COMPLETE = frozenset({"`}`", "EOF"})
_IDENTIFIER = re.compile(r"[A-Za-z_]\w*")
_SEPARATOR = re.compile(r"[;{}]")


def parse_with_recovery(
    source: Source,
    scanned: ScanResult,
    parser: Parser,
    report: Diagnostics,
    failure: Failure | None = None,
) -> Parsed:
    """Parse a text with syntax errors and report them.

    `failure` is the result of the parser for the unchanged text, if it is known.
    """
    return _Recovery(source, scanned, parser, report).parse(failure)


class _Recovery:
    def __init__(
        self, source: Source, scanned: ScanResult, parser: Parser, report: Diagnostics
    ) -> None:
        self._source = source
        self._scanned = scanned
        self._parser = parser
        self._report = report
        self._parsed = Parsed(Model(Span(source, 0, len(source.text)), None, [], [], []))
        self._read = 0

    def parse(self, failure: Failure | None) -> Parsed:
        """Parse the text; the first failure may be known."""
        parsed, source = self._parsed, self._source
        patched = PatchedText.of(source.text).repaired(*self._scanned.repairs)
        if self._scanned.nesting_exceeded_at is not None:
            self._skip_names(patched.text)
            return parsed
        # Offsets of reported errors; another error in the same statement follows from them.
        known = set(self._scanned.faults)
        incomplete = bool(known)
        failed: set[int] = set()
        doubtful: list[tuple[int, int]] = []
        for _ in range(_MAX_ERRORS_PER_SEGMENT):
            result = failure or self._parser(Source(source.name, patched.text))
            failure = None
            if isinstance(result, Model):
                parsed.repaired |= patched.restore(result, source)
                if incomplete:
                    parsed.incomplete |= {*result.declarations, *result.optimizations}
                # The target of a repaired import is unknown.
                result.imports = [
                    one
                    for one in result.imports
                    if not any(start <= one.span.start < end for start, end in doubtful)
                ]
                self._skip_names_around(patched, known)
                parsed.anonymous_kinds |= {*_anonymous_kinds(result)}
                parsed.model = result
                return parsed
            silent = Diagnostics()
            at = report_syntax_error(result, source, patched, silent)
            statement = _statement_at_fault(patched.text, at, result.expected)
            span = patched.origins[statement.start], patched.origins[statement.header]
            repaired = None
            short = statement.header - statement.start <= _MAX_STATEMENT_LENGTH
            if span[0] not in failed and short and self._read < _MAX_PARSED_LENGTH:
                repaired = repair_statement(patched, statement, self._failure)
            failed.add(span[0])
            if not (_has_any(known, span) or self._follows(known, span[0])):
                hint = repaired.help if repaired else None
                self._report.include(replace(one, help=one.help or hint) for one in silent)
            known.add(patched.origins[at])
            if repaired is not None:
                if not repaired.complete:
                    doubtful.append((span[0], span[1]))
                self._skip_names(patched.text[statement.start : statement.header] + " _")
                incomplete = incomplete or not repaired.complete
                patched = repaired.patched
            else:
                self._skip_names(patched.text[statement.start : statement.end])
                incomplete = True
                patched = patched.blanked(statement.start, max(statement.end, statement.start + 1))
        self._skip_names(patched.text)
        return parsed

    def _follows(self, known: set[int], at: int) -> bool:
        """Return True for the rest of a statement with an error, or of a line after its block."""
        before = self._source.text[:at].rstrip(" \t")
        line = before.rfind("\n") + 1
        if any(line <= each < at and not _SEPARATOR.search(before, each) for each in known):
            return True
        if not before.endswith("}"):
            return False
        block = statement_at(self._source.text, len(before) - 1)
        return _has_any(known, (block.start, block.header))

    def _failure(self, text: str) -> Failure | None:
        self._read += len(text)
        result = self._parser(Source(self._source.name, text))
        return result if isinstance(result, Failure) else None

    def _skip_names_around(self, patched: PatchedText, known: set[int]) -> None:
        """Note the names in statements with errors: they may be declared there."""
        inside = (bisect_right(patched.origins, at) - 1 for at in known)
        found = {(one.start, one.header) for one in statements_at(patched.text, inside)}
        for start, end in found:
            self._skip_names(patched.text[start:end])

    def _skip_names(self, text: str) -> None:
        self._parsed.skipped_names |= {*_IDENTIFIER.findall(text)}


def _has_any(places: set[int], span: tuple[int, int]) -> bool:
    return any(span[0] <= place <= span[1] for place in places)


def _statement_at_fault(text: str, at: int, expected: frozenset[str]) -> Statement:
    """Return the statement that causes a failure at `at`.

    A closing brace belongs to the block around it. The start of a statement is not the cause
    if an incomplete one is before it on the same line.
    """
    before = text[:at].rstrip()
    if text[at : at + 1] == "}" and before and before[-1] not in "{}":
        return statement_at(text, len(before) - 1)
    statement = statement_at(text, at)
    same_line = before and "\n" not in text[len(before) : at]
    if same_line and statement.start == at and not expected & _COMPLETE:
        return statement_at(text, len(before) - 1)
    return statement


def _anonymous_kinds(model: Model) -> Iterator[str]:
    """Yield the kinds of references to nodes whose name could not be parsed."""
    for node in walk(model):
        name = getattr(node, "name", None)
        if isinstance(name, Word) and name.span.text != name:
            yield type(node).__name__
            if isinstance(node, get_args(Vertex)):
                yield "Vertex"
