"""One pass over a file before it is parsed: comments, texts and brackets.

It finds what a parser reports badly or in the wrong place: a bracket that is never
closed, text and comments without an end, nesting too deep to parse, and it gathers the
`///` comments with the place they document.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

from swarmdsl.diagnostics import Diagnostics
from swarmdsl.source import Source, Span

# Deeper than any model a person writes, and what the parser takes without overflow.
NESTING_LIMIT = 64

_TOKEN = re.compile(
    r'(?P<text>"(?:[^"\\\n]|\\[^\n])*")'
    r'|(?P<open_text>"[^\n]*)'
    r"|(?P<line>//[^\n]*)"
    r"|(?P<block>/\*(?:[^*]|\*(?!/))*\*/)"
    r"|(?P<open_block>/\*)"
    r"|(?P<bracket>[{}()\[\]])"
)
_ESCAPE = re.compile(r"\\[^\n]")
_ESCAPES = {r"\"", r"\\", r"\n", r"\t"}
_OPENER = {"}": "{", ")": "(", "]": "["}


@dataclass(frozen=True, slots=True)
class DocComment:
    """Lines of `///` that stand together; `next` is the offset of what follows them."""

    span: Span
    text: str
    next: int


@dataclass(frozen=True, slots=True)
class Scan:
    """What the pass found.

    `faults` are the offsets of what it reported, `blocks` the comments and the outermost
    brackets, in order: no declaration begins inside one.
    """

    docs: tuple[DocComment, ...]
    faults: tuple[int, ...]
    blocks: tuple[tuple[int, int], ...]


def scan(source: Source, report: Diagnostics) -> Scan:
    """Look over a file, reporting brackets, texts and comments without an end."""
    text = source.text
    brackets: list[int] = []
    doc_lines: list[tuple[int, int]] = []
    faults: list[int] = []
    comments: list[tuple[int, int]] = []
    for token in _TOKEN.finditer(text):
        start, end = token.span()
        match token.lastgroup:
            case "bracket":
                brackets.append(start)
            case "line" if _DOC_LINE.match(token[0]) and _starts_line(text, start):
                doc_lines.append((start, end))
            case "line" if _DOC_LINE.match(token[0]):
                report.report(
                    "unattached-doc-comment",
                    Span(source, start, end),
                    help="it documents what follows on the next line: move it before",
                )
            case "text":
                for escape in _ESCAPE.finditer(text, start + 1, end - 1):
                    if escape[0] not in _ESCAPES:
                        report.report(
                            "syntax-error",
                            Span(source, *escape.span()),
                            message=f"`{escape[0]}` means nothing in a text",
                            help="write `\\\\` for `\\`",
                        )
            case "block":
                comments.append((start, end))
            case "open_text":
                end -= len(token[0]) - len(token[0].rstrip())
                report.report(
                    "unterminated-text",
                    Span(source, start, end),
                    help='close the text with `"` on the same line',
                )
                faults.append(start)
            case "open_block":
                report.report("unterminated-comment", Span(source, start, end))
                faults.append(start)
                break
    too_deep = _too_deep(text, brackets)
    if too_deep is not None:
        report.report(
            "nested-too-deeply", Span(source, too_deep, too_deep + 1), limit=NESTING_LIMIT
        )
        faults.append(too_deep)
    elif not faults:
        for at in _unclosed(source, brackets):
            report.report("unclosed-bracket", Span(source, at, at + 1), bracket=text[at])
            faults.append(at)
    return Scan(_join(source, doc_lines), tuple(faults), _blocks(text, brackets, comments))


def _too_deep(text: str, brackets: list[int]) -> int | None:
    depth = 0
    for at in brackets:
        depth = depth + 1 if text[at] not in _OPENER else max(depth - 1, 0)
        if depth > NESTING_LIMIT:
            return at
    return None


def _blocks(
    text: str, brackets: list[int], comments: list[tuple[int, int]]
) -> tuple[tuple[int, int], ...]:
    """Comments and outermost brackets; of brackets that are not closed nothing is known."""
    pairs: list[tuple[int, int]] = []
    start = depth = 0
    for at in brackets:
        if text[at] not in _OPENER:
            start = at if depth == 0 else start
            depth += 1
        elif depth > 0:
            depth -= 1
            if depth == 0:
                pairs.append((start, at))
    found: list[tuple[int, int]] = []
    for block in sorted((pairs if depth == 0 else []) + comments):
        if not found or block[0] > found[-1][1]:
            found.append(block)
    return tuple(found)


def _unclosed(source: Source, brackets: list[int]) -> list[int]:
    """Offsets of the brackets that nothing closes.

    When closers are missing, those that are there do not say whose they are: the one at
    the end of the file is reported by a parser, not the one the writer forgot. So a second
    look takes a closer that stands further left than its opener's line for a closer of
    something outside, and the opener for the forgotten one.
    """
    left_over = _match(source, brackets, trust_indentation=False)
    return (left_over and _match(source, brackets, trust_indentation=True)) or left_over


def _match(source: Source, brackets: list[int], *, trust_indentation: bool) -> list[int]:
    text = source.text
    opened: list[int] = []
    unclosed: list[int] = []
    for at in brackets:
        opener = _OPENER.get(text[at])
        if opener is None:
            opened.append(at)
            continue
        if trust_indentation and _starts_line(text, at):
            while len(opened) > 1 and _indentation(source, at) < _indentation(source, opened[-1]):
                unclosed.append(opened.pop())
        if any(text[other] == opener for other in opened):
            while text[opened[-1]] != opener:
                unclosed.append(opened.pop())
            opened.pop()
    return unclosed + opened


def _indentation(source: Source, offset: int) -> int:
    line, _ = source.line_column(offset)
    text = source.line_text(line).expandtabs(4)
    return len(text) - len(text.lstrip())


def _starts_line(text: str, offset: int) -> bool:
    return not text[text.rfind("\n", 0, offset) + 1 : offset].strip()


def _join(source: Source, lines: list[tuple[int, int]]) -> tuple[DocComment, ...]:
    """Make one comment of lines that follow each other."""
    text = source.text
    groups: list[list[tuple[int, int]]] = []
    for start, end in lines:
        gap = text[groups[-1][-1][1] : start] if groups else "x"
        if groups and not gap.strip() and gap.count("\n") == 1:
            groups[-1].append((start, end))
        else:
            groups.append([(start, end)])
    return tuple(
        DocComment(
            Span(source, group[0][0], group[-1][1]),
            "\n".join(text[start:end].rstrip()[3:].removeprefix(" ") for start, end in group),
            _next_token(text, group[-1][1]),
        )
        for group in groups
    )


_DOC_LINE = re.compile(r"///(?!/)")
_BLANK = re.compile(r"(?:\s|//(?!/(?!/))[^\n]*|/\*(?:[^*]|\*(?!/))*\*/)*")


def _next_token(text: str, offset: int) -> int:
    found = _BLANK.match(text, offset)
    return found.end() if found else offset
