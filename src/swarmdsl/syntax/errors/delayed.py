"""Delayed syntax errors: the parser took the next word for the missing one.

The first unexpected token is then after the error, mostly on the next line. For example, in
`x :` before a line `y : int32` the type is missing, but the parser stops at the second `:`.
"""

from __future__ import annotations

import re
from typing import NamedTuple


class DelayedError(NamedTuple):
    """Error at its own place: offsets of the token, message and hint."""

    start: int
    end: int
    message: str
    help: str | None = None


# What these expect, where they end a line.
_MISSING = {":": "a type", "->": "a name", "=": "a value", "initial": "a name", "do": "a name"}
_OPEN_END = re.compile(
    r"(?P<token>(?<![:<>=!]):|->|(?<![<>=!:])=|\binitial\b|\bdo\b)[ \t]*(?://[^\n]*)?\n\s*"
    r"[A-Za-z_][\w/]*\s*(?=[:=.][^:=])"
)
_TARGET_FIRST = re.compile(
    r"^[ \t]*(?:internal[ \t]+)?(?:on|after|monitor)\b[^\n]*?->[ \t]*[A-Za-z_][\w.]*[ \t]*"
    r"(?P<token>[\[/])(?!/)",
    re.MULTILINE,
)
_TWO_WORDS = re.compile(
    r"^[ \t]*[A-Za-z_]\w*[ \t]*:[ \t]*(?P<first>[a-z]+)[ \t]+(?P<token>[a-z]\w*)[ \t]*$",
    re.MULTILINE,
)


def find_delayed_error(text: str, at: int, before: int) -> DelayedError | None:
    """Find the error that made the parser stop at `at`; the token before it is at `before`."""
    line = text.rfind("\n", 0, before) + 1
    if found := _TARGET_FIRST.match(text, line):
        what = "guard" if found["token"] == "[" else "effect"
        end = text.find("\n", found.end())
        rest = text[found.end() : at]
        if found.start("token") <= at and (what == "effect" or "->" not in rest or at < end):
            message = f"the {what} of a transition comes before its target"
            return _delayed(found, message, "write `on event [guard] / effect -> Target`")
    if (found := _TWO_WORDS.match(text, line)) and found.end("token") > before:
        message = f"expected the end of the line, found `{found['token']}`"
        return _delayed(found, message, "the name of a type is one word, such as `uint32`")
    above = text.rfind("\n", 0, len(text[:line].rstrip())) + 1
    for found in _OPEN_END.finditer(text, above, at + 2):
        if found.end() == at:
            token = found["token"]
            return _delayed(found, f"expected {_MISSING[token]} after `{token}`")
    return None


def _delayed(found: re.Match[str], message: str, help_: str | None = None) -> DelayedError:
    return DelayedError(*found.span("token"), message, help_)
