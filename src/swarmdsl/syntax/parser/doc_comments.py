"""Documentation in `///` comments, and escapes in strings: the parser skips both."""

from __future__ import annotations

import re

from swarmdsl.base.diagnostics.advice import Advice
from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.records import dataclass
from swarmdsl.base.source import Source, Span
from swarmdsl.syntax.parser.literals import escape_faults

# An unclosed string ends with its line, an unclosed comment with the file.
_TOKEN = r'"[^"\\\n]*(?:\\[^\n][^"\\\n]*)*(?P<closed>")?|//[^\n]*|/\*(?s:.*?)(?:\*/|\Z)'
CONTROL = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\x7f-\x9f\ud800-\udfff\ufffe\uffff]")
"""Control characters, and others that XML cannot contain (XML 1.0, 2.2): no file has them."""
_DOC_LINE = re.compile(r"///(?!/)")
_BLANK = re.compile(r"(?:\s+|//(?!/(?!/))[^\n]*|/\*(?s:.*?)\*/)*")


@dataclass(frozen=True, slots=True)
class DocComment:
    """Consecutive lines of `///`; `next` is the offset of the token after them."""

    span: Span
    text: str
    next: int


class DocCommentCollector:
    """Collector of `///` comments; reports misplaced ones, and wrong escapes in strings."""

    def __init__(self, source: Source, report: Diagnostics) -> None:
        self._source = source
        self._report = report
        self._lines: list[tuple[int, int]] = []

    def comment(self, start: int, end: int) -> None:
        """Add a comment that ends with its line."""
        if not _DOC_LINE.match(self._source.text, start):
            return
        if is_first_on_line(self._source.text, start):
            self._lines.append((start, end))
        else:
            self._report.report(
                "unattached-doc-comment",
                Span(self._source, start, end),
                help=Advice(
                    "move it to the line before: it documents what follows it", "move comment"
                ),
            )

    def quoted(self, start: int, end: int) -> None:
        """Check the escapes of a string."""
        for at, to, reason, hint in escape_faults(self._source.text, start + 1, end - 1):
            place = Span(self._source, at, to)
            self._report.report("syntax-error", place, message=reason, help=hint)

    def documentation(self) -> tuple[DocComment, ...]:
        """Return the comments; consecutive lines are one comment."""
        text = self._source.text
        groups: list[list[tuple[int, int]]] = []
        for start, end in self._lines:
            gap = text[groups[-1][-1][1] : start] if groups else "x"
            if groups and not gap.strip() and gap.count("\n") == 1:
                groups[-1].append((start, end))
            else:
                groups.append([(start, end)])
        return tuple(
            DocComment(
                Span(self._source, group[0][0], group[-1][1]),
                "\n".join([text[start:end].rstrip()[3:].removeprefix(" ") for start, end in group]),
                _next_token(text, group[-1][1]),
            )
            for group in groups
        )


def documentation(source: Source, report: Diagnostics) -> tuple[DocComment, ...]:
    """Return the documentation in a file without syntax errors."""
    text = source.text
    comments = DocCommentCollector(source, report)
    if "\\" in text or "/*" in text:
        _scan_tokens(source, comments)
        return comments.documentation()
    at = text.find("///")
    while at >= 0:
        if not is_first_on_line(text, at):  # it may be in a string
            comments = DocCommentCollector(source, report)
            _scan_tokens(source, comments)
            break
        end = text.find("\n", at)
        end = end if end >= 0 else len(text)
        comments.comment(at, end)
        at = text.find("///", end)
    return comments.documentation()


def _scan_tokens(source: Source, comments: DocCommentCollector) -> None:
    has_escapes = "\\" in source.text
    for token in re.finditer(_TOKEN, source.text):
        written = token[0]
        if written[0] == '"':
            if has_escapes and token["closed"]:
                comments.quoted(*token.span())
        elif written.startswith("///"):
            comments.comment(*token.span())


def doc_comment(text: str) -> list[str]:
    """Return documentation as lines of a file, none if it is empty.

    A carriage return ends a line of a file, and a control character is not allowed in one.
    """
    lines = re.split("\r\n|[\r\n]", CONTROL.sub(" ", text)) if text else []
    return [f"/// {line}".rstrip() for line in lines]


def is_first_on_line(text: str, offset: int) -> bool:
    """Return True if only spaces are before an offset on its line."""
    if text[offset - 1 : offset] in ("", "\n"):
        return True
    end = skip_space_back(text, offset)
    return end == 0 or "\n" in text[end:offset]


def skip_space_back(text: str, offset: int) -> int:
    """Return the end of the token before an offset, in time independent of the text's length."""
    while offset and text[offset - 1].isspace():
        offset -= 1
    return offset


def _next_token(text: str, offset: int) -> int:
    found = _BLANK.match(text, offset)
    return found.end() if found else offset
