"""Lines and blocks of a .swarm file."""

from __future__ import annotations

from collections.abc import Iterable

from swarmdsl.syntax.parser.doc_comments import doc_comment
from swarmdsl.syntax.parser.literals import quoted as string_literal

_INDENT = "  "


class UnprintableError(ValueError):
    """No text has this meaning: no model leads to such a system."""


def documented(doc: str, lines: Iterable[str]) -> list[str]:
    """Return lines with their documentation before them."""
    return [*doc_comment(doc), *lines]


def block(head: str, *groups: Iterable[str]) -> list[str]:
    """Return `head { ... }`, with a blank line between non-empty groups of lines."""
    body: list[str] = []
    for lines in map(list, groups):
        if lines and body:
            body.append("")
        body += lines
    if not body:
        return [f"{head} {{ }}"]
    return [f"{head} {{", *indented(body), "}"]


def indented(lines: Iterable[str]) -> list[str]:
    """Return lines one level deeper."""
    return [f"{_INDENT}{line}" if line else "" for line in lines]


def quoted(text: str) -> str:
    """Return a string in double quotes. Raises UnprintableError."""
    try:
        return string_literal(text)
    except ValueError as fault:
        raise UnprintableError(str(fault)) from None
