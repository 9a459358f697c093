"""Match brackets: find unmatched ones, and where the other one belongs.

If a closing bracket is missing, counting alone finds it missing at the end of the file. Indentation
tells more: a line that is indented no further than the line of the opening brace is outside of
its block. If that finds more errors than counting, it is not used.
"""

from __future__ import annotations

import re
from bisect import bisect_right

from swarmdsl.base.diagnostics.advice import Advice
from swarmdsl.base.diagnostics.collector import Diagnostics, Label
from swarmdsl.base.records import dataclass
from swarmdsl.base.source import Source, Span
from swarmdsl.syntax.parser.doc_comments import is_first_on_line, skip_space_back
from swarmdsl.syntax.parser.patched_text import Repair

CLOSER = {"{": "}", "(": ")", "[": "]"}
_OPENER = {closer: opener for opener, closer in CLOSER.items()}
_TOKEN = re.compile(r"^[ \t]*(?=[^\s})\]])|->|[{}()\[\]]", re.MULTILINE)
_BRACKET = re.compile(r"[{}()\[\]]")
_CLOSERS = re.compile(r"[})\]\s]*")
_INDENTATION = re.compile(r"[ \t]*")


@dataclass(frozen=True, slots=True)
class BracketFault:
    """Unmatched bracket.

    `at` is its offset, or that of the last word of the header for a block without `{`; `before`
    is the line before which the closing bracket seems to belong, None if that does not matter.
    """

    kind: str  # unclosed, unopened, extra or wrong
    at: int
    repair: Repair
    opener: int | None = None
    before: int | None = None


def find_faults(code: str) -> list[BracketFault]:
    """Find unmatched brackets in a text without comments and strings, sorted."""
    if _balanced(code):
        return []
    counted = _Match(code, trust_indentation=False).faults
    trusted = _Match(code, trust_indentation=True).faults
    return sorted(trusted if len(trusted) <= len(counted) else counted, key=lambda fault: fault.at)


def outermost(code: str) -> list[tuple[int, int]]:
    """Return the outermost pairs of matching brackets."""
    pairs: list[tuple[int, int]] = []
    opened: list[int] = []
    for bracket in _BRACKET.finditer(code):
        if bracket[0] in CLOSER:
            opened.append(bracket.start())
        elif opened:
            start = opened.pop()
            if not opened:
                pairs.append((start, bracket.start()))
    return pairs


def _balanced(code: str) -> bool:
    opened: list[str] = []
    for bracket in _BRACKET.findall(code):
        if bracket in CLOSER:
            opened.append(CLOSER[bracket])
        elif not opened or opened.pop() != bracket:
            return False
    return not opened


def report_fault(fault: BracketFault, source: Source, report: Diagnostics) -> None:
    """Report an unmatched bracket."""
    at, text = fault.at, source.text
    place = Span(source, at, at + 1)
    bracket = text[at]
    if fault.kind == "unclosed":
        closer = CLOSER[bracket]
        related: tuple[Label, ...] = ()
        if fault.before is not None:
            end = text.find("\n", fault.before)
            line = Span(source, fault.before, end if end >= 0 else len(text))
            message = f"by its indentation, `{closer}` is missing before this line"
            related = (Label(line, message),)
        help_ = (
            Advice(f"write `{closer}` at the end of the block", "close block", closer)
            if bracket == "{"
            else None
        )
        report.report("unclosed-bracket", place, bracket=bracket, related=related, help=help_)
    elif fault.kind == "wrong" and fault.opener is not None:
        opener = text[fault.opener]
        report.report(
            "syntax-error",
            place,
            message=f"expected `{CLOSER[opener]}`, found `{bracket}`",
            related=(Label(Span(source, fault.opener, fault.opener + 1), "opened here"),),
            help=f"close `{opener}` with `{CLOSER[opener]}`",
        )
    elif fault.kind == "unopened":
        word = Span(source, at, fault.repair.start)
        message = f"expected `{{` after `{word.text}`"
        report.report("syntax-error", word, message=message, help="open the block with `{`")
    else:
        report.report(
            "syntax-error",
            place,
            message=f"unmatched `{bracket}`",
            help=Advice("delete it, or open it before", "remove bracket"),
        )


class _Match:
    """One pass over the brackets of a text."""

    def __init__(self, code: str, *, trust_indentation: bool) -> None:
        self.faults: list[BracketFault] = []
        self._code = code
        self._lines = [0, *(found.end() for found in re.finditer("\n", code))]
        self._trusts = trust_indentation
        self._open: list[int] = []
        skip = 0
        for token in _TOKEN.finditer(code):
            at = token.end() if token[0] not in ("->", *CLOSER, *_OPENER) else token.start()
            if at < skip:
                continue
            if token[0] in _OPENER:
                skip = self._close(at)
            elif token[0] in CLOSER or token[0] == "->":
                if token[0] in ("{", "->"):
                    self._end_of_brackets(at)
                if token[0] in CLOSER:
                    self._open.append(at)
            elif at < len(code):
                self._begin_line(at)
        while self._open:
            self._unclosed(len(code), None)

    def _begin_line(self, at: int) -> None:
        column = self._column(at)
        while self._open and column <= self._indentation(self._open[-1]):
            block = self._code[self._open[-1]] == "{"
            if block and (not self._trusts or self._code[at] == "{"):
                break
            self._unclosed(at, at if block else None)

    def _end_of_brackets(self, at: int) -> None:
        """Close parentheses and square brackets: they cannot extend beyond this token."""
        while self._open and self._code[self._open[-1]] != "{":
            self._unclosed(at, None)

    def _close(self, at: int) -> int:
        """Match a closing bracket; return the offset to continue from."""
        code = self._code
        opener = _OPENER[code[at]]
        if opener == "{":
            if self._open and self._is_wrong(at):
                return self._wrong(at)
            self._end_of_brackets(at)
            if self._trusts and is_first_on_line(code, at):
                column = self._column(at)
                while len(self._open) > 1 and column < self._indentation(self._open[-1]):
                    self._unclosed(at, at)
                if self._open and column > self._indentation(self._open[-1]):
                    return self._extra(at)
        else:
            inside = self._open[self._last_block() + 1 :]
            if any(code[other] == opener for other in inside):
                while code[self._open[-1]] != opener:
                    self._unclosed(at, None)
            elif inside:
                return self._wrong(at)
            else:
                return self._extra(at)
        if not self._open:
            return self._extra(at)
        self._open.pop()
        return at + 1

    def _is_wrong(self, at: int) -> bool:
        """Return True if a `}` closes a parenthesis of its line: no block was opened there."""
        line = self._line(at)
        block = self._last_block()
        return self._open[-1] >= line and (block < 0 or self._open[block] < line)

    def _wrong(self, at: int) -> int:
        opener = self._open.pop()
        repair = Repair(at, at + 1, CLOSER[self._code[opener]])
        self.faults.append(BracketFault("wrong", at, repair, opener))
        return at + 1

    def _last_block(self) -> int:
        blocks = (i for i in reversed(range(len(self._open))) if self._code[self._open[i]] == "{")
        return next(blocks, -1)

    def _unclosed(self, end: int, before: int | None) -> None:
        at = self._open.pop()
        if before is None and self._code[at] != "{":  # it ends with its line
            following = bisect_right(self._lines, at)
            end = min(end, *self._lines[following : following + 1], len(self._code))
        end = skip_space_back(self._code, end)
        # A brace gets its own line, so that errors before it are not reported at the brace.
        closer = "\n}" if self._code[at] == "{" else CLOSER[self._code[at]]
        repair = Repair(end, end, closer)
        self.faults.append(BracketFault("unclosed", at, repair, before=before))

    def _extra(self, at: int) -> int:
        """Add a fault for extra closing brackets, or for a block without `{`."""
        header = self._header(at) if self._trusts and self._code[at] == "}" else None
        if header is not None:
            self.faults.append(header)
            return at + 1
        found = _CLOSERS.match(self._code, at) if not self._open else None
        end = found.end() if found else at + 1
        blank = re.sub(r"\S", " ", self._code[at:end])
        self.faults.append(BracketFault("extra", at, Repair(at, end, blank)))
        return end

    def _header(self, at: int) -> BracketFault | None:
        """Find the header of an indented block without `{` that ends with the brace at `at`."""
        code = self._code
        end = skip_space_back(code, at)
        if not is_first_on_line(code, at) or self._indentation(end) <= self._column(at):
            return None
        while end and self._indentation(end) > self._column(at):
            end = skip_space_back(code, self._line(end))
        header = code[self._line(end) : end].lstrip()
        if not header[:1].isalpha() or "{" in header or "}" in header:
            return None
        word = end
        while word and (code[word - 1].isalnum() or code[word - 1] in "_./"):
            word -= 1
        return BracketFault("unopened", min(word, end - 1), Repair(end, end, " {"))

    def _indentation(self, at: int) -> int:
        found = _INDENTATION.match(self._code, self._line(at))
        return len(found[0].expandtabs(4)) if found else 0

    def _column(self, at: int) -> int:
        """Return the column of the first token of a line."""
        return len(self._code[self._line(at) : at].expandtabs(4))

    def _line(self, at: int) -> int:
        """Return the offset of the start of the line."""
        return self._lines[bisect_right(self._lines, at) - 1]
