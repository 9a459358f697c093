"""Insert statements into bodies, and remove them, as the formatter lays them out."""

from __future__ import annotations

import re

from swarmdsl.base.diagnostics.collector import Fix
from swarmdsl.base.source import Source, Span
from swarmdsl.syntax.ast import Node

_UP_TO_BODY = re.compile(
    r'(?:"(?:\\.|[^"\\\n])*"|//[^\n]*|/\*.*?\*/|[^{}"/]|/(?![/*]))*\{', re.DOTALL
)
# Lines of documentation above a statement.
_DOCUMENTATION = re.compile(r"(?:^[ \t]*///[^\n]*\n)+\Z", re.MULTILINE)
_AFTER = re.compile(r"[ \t]*([;,])?[ \t]*")
_INDENT = "  "


def opening_brace(node: Node) -> int | None:
    """Return the offset after the opening brace of a node; None without a body."""
    source, start, end = node.span.absolute
    name = getattr(node, "name", None)
    if name is not None and hasattr(name, "span"):
        start = name.span.absolute.end
    found = _UP_TO_BODY.match(source.text, start, end)
    return found.end() if found is not None else None


def insert(node: Node, lines: str, *, first: bool = False, shown: str = "") -> Fix | None:
    """Return the fix that inserts statements at the beginning or the end of a body.

    A node without a body gets one.
    """
    edit = insertion(node, lines, first=first)
    title = f"Add `{shown or lines.partition(chr(10))[0]}`"
    return Fix(title, (edit,)) if edit is not None else None


def insertion(node: Node, lines: str, *, first: bool = False) -> tuple[Span, str] | None:
    """Return the edit that inserts statements into a body."""
    source, start, end = node.span.absolute
    text = source.text
    opening = opening_brace(node)
    if opening is None:
        joined = "; ".join(map(str.strip, lines.split("\n")))
        return Span(source, end, end), f" {{ {joined} }}"
    closing = end - 1
    if text[closing : closing + 1] != "}" or closing < opening:
        return None
    indent = _indentation(source, start)
    block = "".join(f"{indent}{_INDENT}{line}\n" for line in lines.split("\n"))
    if "\n" in text[opening:closing]:
        if first:
            line_end = text.find("\n", opening)
            if text[opening:line_end].strip() and not text[opening:line_end].strip().startswith(
                "//"
            ):
                return Span(source, opening, opening), f"\n{block.rstrip()}\n{indent}{_INDENT}"
            return Span(source, line_end + 1, line_end + 1), block
        line_start = text.rfind("\n", 0, closing) + 1
        if not text[line_start:closing].strip():
            return Span(source, line_start, line_start), block
        return Span(source, closing, closing), f"\n{block}{indent}"
    joined = "; ".join(map(str.strip, lines.split("\n")))
    inside = text[opening:closing].strip()
    if not inside:
        return Span(source, opening, closing), f" {joined} "
    if first:
        return Span(source, opening, opening), f" {joined};"
    at = len(text[:closing].rstrip())
    return Span(source, at, at), f"; {joined}"


def _indentation(source: Source, at: int) -> str:
    """Return the white space at the beginning of the line of an offset."""
    start = source.text.rfind("\n", 0, at) + 1
    line = source.text[start:at]
    return line[: len(line) - len(line.lstrip())]


def removal(span: Span) -> tuple[Span, str]:
    """Return the edit that removes a statement, with its documentation, lines and separator."""
    source, start, end = span.absolute
    text = source.text
    line_start = text.rfind("\n", 0, start) + 1
    line_end = text.find("\n", end)
    line_end = len(text) if line_end < 0 else line_end + 1
    rest = text[end:line_end].strip()
    alone = not text[line_start:start].strip() and (
        not rest or rest.startswith("//") or rest == ";"
    )
    if alone:
        documented = _DOCUMENTATION.search(text, 0, line_start)
        return Span(source, documented.start() if documented else line_start, line_end), ""
    after = _AFTER.match(text, end)
    if after is not None and after[1]:
        return Span(source, start, after.end()), ""
    before = text[:start].rstrip()
    if before[-1:] in (";", ","):
        return Span(source, len(before) - 1, end), ""
    return Span(source, len(before) if before[-1:] not in "{(" else start, end), ""


def remove(span: Span, what: str, *, safe: bool = False) -> Fix:
    """Return the fix that removes a statement."""
    return Fix(f"Remove {what}", (removal(span),), safe)
