"""Hints for unexpected tokens."""

from __future__ import annotations

import re
import unicodedata

from swarmdsl.base.diagnostics.advice import Advice, meant, write
from swarmdsl.base.diagnostics.collector import listed
from swarmdsl.base.suggest import closest
from swarmdsl.syntax.errors.foreign_tokens import symbol_hint
from swarmdsl.syntax.types import PRIMITIVES
from swarmdsl.syntax.units import UNITS

_NAMES = "a name has ASCII letters, digits and `_`, and starts with no digit"
SIZES = Advice(
    "write `[]` for any number of elements, `[4]` for exactly 4, `[<=4]` for at most 4",
    "size",
    "[]",
    "[4]",
    "[<=4]",
)
_ARROWS = {"->", "=>", "-", "=", ">", ":", "\N{RIGHTWARDS ARROW}"}
_NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_]*")
# Similarity to a keyword: `Start` is too far from `state`.
MIN_SIMILARITY = 0.85
_PARAMETER = re.compile(r"[(,]\s*(?:inout|(?:in|out)\s+(?:in|out))$")
_UPDATES = (":=", "+=", "-=", "*=", "/=", "++", "--")


def token_hint(
    expected: set[str], before: re.Match[str] | None, found: re.Match[str]
) -> str | None:
    """Return a hint for the unexpected token `found` after `before`; None if there is none."""
    token, text, at = found[0], found.string, found.start()
    last = before[0] if before is not None else ""
    joined = before is not None and before.end() == at
    for arrow in ("->", "=>"):
        if f"`{arrow}`" in expected and token in _ARROWS:
            return write(arrow)
    if "`=`" in expected and text.startswith(_UPDATES, at):
        return "write the new value after `=`: `x = x + 1`"
    if token == "=" and joined and last == "=":
        return "write one `=` to assign"
    if token == "=" and "`]`" in expected:
        return "write `==` to compare"
    if token == "-" and text.startswith("--", at):
        return symbol_hint("#")
    if token == "-" and joined and last[0].isalpha():
        return _NAMES
    if "a name" in expected and re.fullmatch(r"\w+", token) and not _NAME.fullmatch(token):
        return _NAMES
    if before and "`:`" in expected and _PARAMETER.search(text, 0, before.end()):
        return "a parameter is `in` or `out`: declare two parameters for both directions"
    if "`:`" in expected and last in PRIMITIVES and _NAME.fullmatch(token):
        return Advice(
            f"write the name first: `{token} : {last}`", "name first", f"{token} : {last}"
        )
    if token == "[" and "`[`" in expected:
        return SIZES
    if token == "/" and joined:
        return "complete the name of the type, as in `std_msgs/Empty`"
    if last[:1].isdigit() and token[0].isalpha() and expected & {"`->`", "`+`"}:
        return f"the units are {listed(list(UNITS), 'and')}"
    if token in "})]" and "`struct`" in expected:
        return "delete it: there is no open bracket"
    if hint := symbol_hint(token):
        return hint
    keyword = closest(token, _literals(expected), MIN_SIMILARITY) if "`:`" not in expected else None
    return meant(keyword) if keyword and keyword != token else None


def _literals(expected: set[str]) -> list[str]:
    return [word.strip("`") for word in expected if re.fullmatch(r"`[a-z]+`", word)]


def strange_character(character: str) -> str | None:
    """Return the name of an invisible character or unusual space; None for others."""
    if not character or character in " \t\r\n" or character.isprintable():
        return None
    name = unicodedata.name(character, "")
    return f"U+{ord(character):04X}" + (f" ({name.lower()})" if name else "")
