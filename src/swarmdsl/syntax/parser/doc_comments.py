"""Documentation, which stands in `///` comments, and escapes in texts: what no parser looks at."""

from __future__ import annotations

import re

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.records import dataclass
from swarmdsl.base.source import Source, Span

# What has no end goes on to that of its line, or of the file.
_TOKEN = r'"[^"\\\n]*(?:\\[^\n][^"\\\n]*)*(?P<closed>")?|//[^\n]*|/\*(?s:.*?)(?:\*/|\Z)'
_DOC_LINE = re.compile(r"///(?!/)")
_BLANK = re.compile(r"(?:\s+|//(?!/(?!/))[^\n]*|/\*(?s:.*?)\*/)*")
_ESCAPE = r"\\[^\n]"
_ESCAPES = {r"\"", r"\\", r"\n", r"\t"}


@dataclass(frozen=True, slots=True)
class DocComment:
    """Lines of `///` that stand together; `next` is the offset of what follows them."""

    span: Span
    text: str
    next: int


class Comments:
    """Collects the documentation in a file, and reports what is wrong with comments and texts."""

    def __init__(self, source: Source, report: Diagnostics) -> None:
        self._source = source
        self._report = report
        self._lines: list[tuple[int, int]] = []

    def comment(self, start: int, end: int) -> None:
        """Look at a comment that ends with its line."""
        if not _DOC_LINE.match(self._source.text, start):
            return
        if starts_line(self._source.text, start):
            self._lines.append((start, end))
        else:
            self._report.report(
                "unattached-doc-comment",
                Span(self._source, start, end),
                help="it documents what follows on the next line: move it before",
            )

    def quoted(self, start: int, end: int) -> None:
        """Look at a text in double quotes."""
        for escape in re.compile(_ESCAPE).finditer(self._source.text, start + 1, end - 1):
            if escape[0] not in _ESCAPES:
                self._report.report(
                    "syntax-error",
                    Span(self._source, *escape.span()),
                    message=f"`{escape[0]}` means nothing in a text",
                    help="write `\\\\` for `\\`",
                )

    def documentation(self) -> tuple[DocComment, ...]:
        """What has been found: lines that follow each other are one comment."""
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
    """The documentation in a file without syntax errors."""
    text = source.text
    comments = Comments(source, report)
    if "\\" in text or "/*" in text:
        _look_at_all(source, comments)
        return comments.documentation()
    at = text.find("///")
    while at >= 0:
        if not starts_line(text, at):  # it may be in a text
            comments = Comments(source, report)
            _look_at_all(source, comments)
            break
        end = text.find("\n", at)
        end = end if end >= 0 else len(text)
        comments.comment(at, end)
        at = text.find("///", end)
    return comments.documentation()


def _look_at_all(source: Source, comments: Comments) -> None:
    has_escapes = "\\" in source.text
    for token in re.finditer(_TOKEN, source.text):
        written = token[0]
        if written[0] == '"':
            if has_escapes and token["closed"]:
                comments.quoted(*token.span())
        elif written.startswith("///"):
            comments.comment(*token.span())


def starts_line(text: str, offset: int) -> bool:
    """Whether nothing but space stands before an offset on its line."""
    if text[offset - 1 : offset] in ("", "\n"):
        return True
    end = end_before(text, offset)
    return end == 0 or "\n" in text[end:offset]


def end_before(text: str, offset: int) -> int:
    """Where what stands before an offset ends: the space between is passed over.

    As fast in a large text as in a small one.
    """
    while offset and text[offset - 1].isspace():
        offset -= 1
    return offset


def _next_token(text: str, offset: int) -> int:
    found = _BLANK.match(text, offset)
    return found.end() if found else offset
