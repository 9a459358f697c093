"""Scan a file before parsing: comments, strings, brackets, foreign characters.

It finds errors that a parser would report badly or in the wrong place: unclosed brackets, strings
and comments, too deep nesting, lookalike characters, conflict markers. For each there is a repair,
so that the rest can be parsed. It also collects `///` comments with the offset they document.
"""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import Any

from swarmdsl.base.diagnostics.advice import Advice, write
from swarmdsl.base.diagnostics.collector import Diagnostics, Label
from swarmdsl.base.records import dataclass
from swarmdsl.base.source import Source, Span
from swarmdsl.syntax.errors.hints import strange_character
from swarmdsl.syntax.errors.substitutions import plain_equivalent
from swarmdsl.syntax.parser.doc_comments import DocComment, DocCommentCollector
from swarmdsl.syntax.parser.patched_text import Repair
from swarmdsl.syntax.parser.result import NESTING_LIMIT
from swarmdsl.syntax.recovery.brackets import CLOSER, find_faults, report_fault

_TOKEN = re.compile(
    r'(?P<text>"(?:[^"\\\n]|\\[^\n])*")'
    r'|(?P<open_text>"[^\n]*)'
    r"|(?P<line>//[^\n]*)"
    r"|(?P<block>/\*)"
    r"|(?P<curly>[\u201c-\u201e\u00ab][^\u201c-\u201e\u00bb\"\n]*[\u201c-\u201e\u00bb\"])"
    r"|(?P<odd>(?P<one>[^\x00-\x7f])(?P=one)*)"
    r"|(?P<mark>^(?:<{7}|={7}|>{7}|[|]{7})(?![<=>|])[^\n]*)",
    re.MULTILINE,
)
_OPEN_BLOCK = re.compile(r"/\*[^\n]*(?:\n[ \t]*\*[^\n]*)*")


@dataclass(frozen=True, slots=True)
class ScanResult:
    """Result of a scan.

    `faults` are the offsets of reported errors, and `repairs` the changes that let the rest be
    parsed, both sorted. `nesting_exceeded_at` is the first offset nested too deeply. `code` is the
    unrepaired text with blanks for comments and strings.
    """

    docs: tuple[DocComment, ...]
    faults: tuple[int, ...]
    repairs: tuple[Repair, ...]
    nesting_exceeded_at: int | None
    code: str


def scan(source: Source, report: Diagnostics) -> ScanResult:
    """Scan a file and report unclosed brackets, strings and comments, and the like."""
    return _Scanner(source, report).scan()


class _Scanner:
    def __init__(self, source: Source, report: Diagnostics) -> None:
        self._source = source
        self._report = report
        self._comments = DocCommentCollector(source, report)
        self._found: list[tuple[int, Repair]] = []
        self._code: list[str] = []
        self._done = 0
        self._spaces: set[str] = set()

    def scan(self) -> ScanResult:
        text = self._source.text
        marks: list[re.Match[str]] = []
        last_end = text.rfind("*/")
        at = 0
        while token := _TOKEN.search(text, at):
            start, end = token.span()
            at = end
            match token.lastgroup:
                case "line":
                    self._comments.comment(start, end)
                case "text":
                    self._comments.quoted(start, end)
                case "open_text":
                    end = self._open_text(start, end)
                case "block" if end <= last_end:
                    at = end = text.index("*/", end) + 2
                case "block":
                    found = _OPEN_BLOCK.match(text, start)
                    at = end = found.end() if found else end
                    self._fault("unterminated-comment", start, start + 2, Repair(end, end, "*/"))
                case "curly":
                    self._curly(start, end)
                case "odd":
                    self._odd(start, end)
                    continue
                case "mark":
                    marks.append(token)
                    continue
            self._blank(start, end)
        self._blank(len(text), len(text))
        code = _without("".join(self._code), self._conflicts(marks))
        nesting_exceeded_at = _too_deep(code)
        if nesting_exceeded_at is not None:
            place = Span(self._source, nesting_exceeded_at, nesting_exceeded_at + 1)
            self._report.report("nested-too-deeply", place, limit=NESTING_LIMIT)
        else:
            for fault in find_faults(code):
                report_fault(fault, self._source, self._report)
                self._found.append((fault.at, fault.repair))
        faults = {at for at, _ in self._found}
        if nesting_exceeded_at is not None:
            faults.add(nesting_exceeded_at)
        return ScanResult(
            self._comments.documentation(),
            tuple(sorted(faults)),
            tuple(sorted(repair for _, repair in self._found)),
            nesting_exceeded_at,
            code,
        )

    def _fault(self, name: str, start: int, end: int, repair: Repair, **more: Any) -> None:
        self._report.report(name, Span(self._source, start, end), **more)
        self._found.append((start, repair))

    def _blank(self, start: int, end: int) -> None:
        text = self._source.text
        self._code += (text[self._done : start], re.sub(r"[^\n]", " ", text[start:end]))
        self._done = end

    def _open_text(self, start: int, end: int) -> int:
        """Report an unclosed string, which likely ends after its first word; return its end."""
        text = self._source.text
        before = re.search(r"[\w./]+$", text[max(0, start - 80) : start])
        if before and not text[start + 1 : end].strip(" \t;,{}"):
            at = start - len(before[0])
            message = 'this string has no opening `"`'
            self._fault(
                "syntax-error",
                at,
                start + 1,
                Repair(at, at, '"'),
                message=message,
                help=write(f'"{before[0]}"'),
            )
            return start + 1
        end -= len(text[start:end]) - len(text[start:end].rstrip())
        inside = re.compile(r'"[^\s,;)}\]]*').match(text, start)
        close = inside.end() if inside else end
        help_ = Advice('close the string with `"` on the same line', "append", '"')
        self._fault("unterminated-text", start, end, Repair(close, close, '"'), help=help_)
        return close

    def _curly(self, start: int, end: int) -> None:
        text = self._source.text
        inside = re.sub(r'[\\"]', " ", text[start + 1 : end - 1])
        repair = Repair(start, end, f'"{inside}"')
        message = f"the quotes of this string are `{text[start]}` and `{text[end - 1]}`"
        help_ = f'write plain quotes: `"{inside}"`'
        self._fault("syntax-error", start, end, repair, message=message, help=help_)

    def _odd(self, start: int, end: int) -> None:
        """Report characters that only look like those of the language."""
        character = self._source.text[start]
        plain = plain_equivalent(character)
        if plain is None:
            return
        repair = Repair(start, end, plain * (end - start))
        if not plain.strip() and character in self._spaces:
            self._found.append((start, repair))
            return
        self._spaces.add(character)
        strange = strange_character(character) or f"`{character}`"
        more = self._source.text.count(character) - (end - start) if not plain.strip() else 0
        self._fault(
            "syntax-error",
            start,
            start + 1,
            repair,
            message=f"unexpected character {strange}",
            notes=(f"the file has {more} more of them",) if more else (),
            help={"": "delete it", " ": "write a plain space"}.get(plain, write(plain)),
        )

    def _conflicts(self, marks: list[re.Match[str]]) -> list[tuple[int, int]]:
        """Report merge conflicts; return the ranges of markers and of second versions."""
        found: list[tuple[int, int]] = []
        first: re.Match[str] | None = None
        middle: re.Match[str] | None = None
        left: list[re.Match[str]] = []
        begun: list[re.Match[str]] = []
        for mark in marks:
            begun.append(mark)
            if mark[0].startswith("<"):
                first, middle = mark, None
                left += begun[:-1]
                begun = [mark]
            elif first is not None and middle is None and mark[0][0] in "=|":
                middle = mark
            elif first is not None and middle is not None and mark[0].startswith(">"):
                ends = Repair(middle.start(), mark.end(), _blank_lines(self._source, middle, mark))
                self._fault(
                    "syntax-error",
                    *first.span(),
                    Repair(*first.span(), " " * len(first[0])),
                    message="unresolved merge conflict",
                    related=(
                        Label(Span(self._source, *middle.span()), "the other version"),
                        Label(Span(self._source, *mark.span()), "it ends here"),
                    ),
                    help="keep the correct version, and delete the three markers",
                )
                self._found.append((middle.start(), ends))
                found += (first.span(), (middle.start(), mark.end()))
                first = middle = None
                begun = []
            elif first is None:
                left += begun
                begun = []
        for mark in (*left, *begun):
            self._fault(
                "syntax-error",
                *mark.span(),
                Repair(*mark.span(), " " * len(mark[0])),
                message="marker of a merge conflict without its counterpart",
                help="delete it, and keep the correct version",
            )
            found.append(mark.span())
        return sorted(found)


def _without(text: str, pieces: Iterable[tuple[int, int]]) -> str:
    """Replace sorted ranges of a text by blanks."""
    kept: list[str] = []
    done = 0
    for start, end in pieces:
        kept += (text[done:start], re.sub(r"[^\n]", " ", text[start:end]))
        done = end
    return "".join([*kept, text[done:]])


def _blank_lines(source: Source, first: re.Match[str], last: re.Match[str]) -> str:
    return re.sub(r"[^\n]", " ", source.text[first.start() : last.end()])


def _too_deep(code: str) -> int | None:
    depth = 0
    for found in re.finditer(r"[{}()\[\]]", code):
        depth = depth + 1 if found[0] in CLOSER else max(depth - 1, 0)
        if depth > NESTING_LIMIT:
            return found.start()
    return None
