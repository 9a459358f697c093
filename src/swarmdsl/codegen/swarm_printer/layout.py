"""Lines and blocks of a .swarm file, the same for all that is printed."""

from __future__ import annotations

from collections.abc import Iterable

_INDENT = "  "
_ESCAPES = {'"': '\\"', "\\": "\\\\", "\n": "\\n", "\t": "\\t"}


class UnprintableError(ValueError):
    """There is no text that means this: no model leads to such a system."""


def documented(doc: str, lines: Iterable[str]) -> list[str]:
    """Lines with their documentation before them."""
    comment = [f"/// {line}".rstrip() for line in doc.split("\n")] if doc else []
    return [*comment, *lines]


def block(head: str, *groups: Iterable[str]) -> list[str]:
    """`head { ... }`, a blank line between groups of lines; empty groups leave no trace."""
    body: list[str] = []
    for lines in map(list, groups):
        if lines and body:
            body.append("")
        body += lines
    if not body:
        return [f"{head} {{ }}"]
    return [f"{head} {{", *indented(body), "}"]


def indented(lines: Iterable[str]) -> list[str]:
    """Lines one level further in."""
    return [f"{_INDENT}{line}" if line else "" for line in lines]


def quoted(text: str) -> str:
    """Text in double quotes."""
    return '"' + "".join(_ESCAPES.get(character, character) for character in text) + '"'
