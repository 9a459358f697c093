"""Delayed syntax errors: the parser took the next word for the missing one.

The first unexpected token is then after the error, mostly on the next line. For example, in
`x :` before a line `y : int32` the type is missing, but the parser stops at the second `:`.
"""

from __future__ import annotations

import re
from typing import NamedTuple

from swarmdsl.base.diagnostics.advice import Advice, write
from swarmdsl.base.naming import fresh
from swarmdsl.syntax.units import UNITS


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
# Characters of the line on either side of the error.
_WIDTH = 1000
# The start of a statement, on a line of its own or not.
_BEGIN = r"(?:^|[{;])[ \t]*"
_TARGET_FIRST = re.compile(
    rf"{_BEGIN}(?P<head>(?:(?:internal[ \t]+)?(?:on|after|monitor)\b|\[|else\b)[^\n;{{}}]*?)[ \t]*"
    r"(?P<target>->[ \t]*[A-Za-z_][\w.]*)[ \t]*(?P<token>[\[/])(?!/)",
    re.MULTILINE,
)
_REST = r"(?P<rest>[ \t]*(?:\[|/(?!/)|->)(?:[^\n;}/]|/(?!/))*)"
_EVENTS = r"on[ \t]+(?P<events>[\w.]+(?:[ \t]*,[ \t]*[\w.]+)*?)[ \t]*"
_MIXED = (
    re.compile(
        rf"{_BEGIN}{_EVENTS}(?:,|\|\||\bor\b)[ \t]*(?P<token>after)[ \t]+(?P<delay>[^/\[\n]*?)"
        rf"{_REST}",
        re.MULTILINE,
    ),
    re.compile(
        rf"{_BEGIN}after[ \t]+(?P<delay>[^/\[\n]*?)[ \t]*(?:,|\|\||\bor\b)[ \t]*"
        rf"(?P<token>on\b)(?<=on){_EVENTS[2:]}{_REST}",
        re.MULTILINE,
    ),
)
_TAIL = re.compile(r"(?P<guard>\[[^]\n]*\][ \t]*)?(?:/(?:[^\n;}/]|/(?!/))*)?")
_NAMELESS = re.compile(rf"{_BEGIN}(?P<token>contract)[ \t]*:[ \t]*(?=on\b)", re.MULTILINE)
_TWO_WORDS = re.compile(
    r"^[ \t]*(?:(?:var|param)[ \t]+)?[A-Za-z_]\w*[ \t]*:[ \t]*(?P<first>[a-z]\w*)[ \t]+"
    r"(?P<token>[a-z]\w*(?:/\w+)?)[ \t]*$",
    re.MULTILINE,
)


def find_delayed_error(text: str, at: int, before: int) -> DelayedError | None:
    """Find the error that made the parser stop at `at`; the token before it is at `before`."""
    line = text.rfind("\n", 0, before) + 1
    end = text.find("\n", at)
    near, end = max(line, at - _WIDTH), min(end if end >= 0 else len(text), at + _WIDTH)
    found: re.Match[str] | None
    for found in _TARGET_FIRST.finditer(text, near, at + 1):
        what = "guard" if found["token"] == "[" else "effect"
        rest = text[found.end() : at]
        if what == "effect" or "->" not in rest or "\n" not in rest:
            message = f"the {what} of a transition comes before its target"
            return _delayed(found, message, write(_in_order(found, text)))
    for mixed in _MIXED:
        for found in mixed.finditer(text, near, end):
            if found.start() <= at <= found.end("token"):
                rest = found["rest"].strip()
                one, other = f"on {found['events']} {rest}", f"after {found['delay']} {rest}"
                message = "a transition waits for events or for a delay, not for both"
                return _delayed(found, message, f"write two: `{one}` and `{other}`")
    for found in _NAMELESS.finditer(text, near, at + 2):
        if found.end() == at:
            help_ = Advice(
                "name it before the `:`, as in `contract Stops : on Stop within 2 s reach Home`",
                "append",
                f" {fresh('Reacts', re.findall(r'[A-Za-z_]+[0-9]*', text), gap='')}",
            )
            return _delayed(found, "expected a name after `contract`", help_)
    if (found := _TWO_WORDS.match(text, line)) and found.end("token") > before:
        message = f"expected the end of the line, found `{found['token']}`"
        unit = write(f"{found['first']} in {found['token']}") if found["token"] in UNITS else None
        return _delayed(found, message, unit or "the name of a type is one word, such as `uint32`")
    above = text.rfind("\n", 0, len(text[:line].rstrip())) + 1
    for found in _OPEN_END.finditer(text, above, at + 2):
        if found.end() == at:
            token = found["token"]
            return _delayed(found, f"expected {_MISSING[token]} after `{token}`")
    return None


def _delayed(found: re.Match[str], message: str, help_: str | None = None) -> DelayedError:
    return DelayedError(*found.span("token"), message, help_)


def _in_order(found: re.Match[str], text: str) -> str:
    """Return the transition with its target last; the order alone, if it is not so simple."""
    tail = _TAIL.match(text, found.start("token"))
    head = found["head"]
    effects = re.search(r"\s/(?!/)", head) is not None
    if tail is None or effects or ("[" in head and tail["guard"]):
        return "on event [guard] / effect -> Target"
    return f"{head} {tail[0].rstrip()} {found['target']}"
