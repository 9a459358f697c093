"""Mistakes that a parser notices late: it took what follows for what is missing.

The text behind them makes sense in another way, so that the first token that does not fit
stands further on, mostly on the next line.
"""

from __future__ import annotations

import re
from typing import NamedTuple


class Late(NamedTuple):
    """A mistake at its own place: offsets of the token that shows it, what is wrong, a way out."""

    start: int
    end: int
    message: str
    help: str | None = None


# What is expected behind these at the end of a line.
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


def noticed_late(text: str, at: int, before: int) -> Late | None:
    """The mistake behind a complaint at `at`, whose token before stands at `before`; or None."""
    line = text.rfind("\n", 0, before) + 1
    if found := _TARGET_FIRST.match(text, line):
        what = "guard" if found["token"] == "[" else "effect"
        end = text.find("\n", found.end())
        rest = text[found.end() : at]
        if found.start("token") <= at and (what == "effect" or "->" not in rest or at < end):
            message = f"the {what} of a transition stands before its target"
            return _late(found, message, "write `on event [guard] / effect -> Target`")
    if (found := _TWO_WORDS.match(text, line)) and found.end("token") > before:
        message = f"expected the end of the line, found `{found['token']}`"
        return _late(found, message, "the name of a type is one word, such as `uint32`")
    above = text.rfind("\n", 0, len(text[:line].rstrip())) + 1
    for found in _OPEN_END.finditer(text, above, at + 2):
        if found.end() == at:
            token = found["token"]
            return _late(found, f"expected {_MISSING[token]} after `{token}`")
    return None


def _late(found: re.Match[str], message: str, help_: str | None = None) -> Late:
    return Late(*found.span("token"), message, help_)
