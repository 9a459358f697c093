"""Slips in the token before the unexpected one: an unknown unit, a misspelled keyword."""

from __future__ import annotations

import re

from swarmdsl.base.diagnostics.advice import meant, write
from swarmdsl.base.suggest import closest
from swarmdsl.syntax.errors.delayed import DelayedError
from swarmdsl.syntax.errors.hints import MIN_SIMILARITY
from swarmdsl.syntax.parser.keywords import RESERVED
from swarmdsl.syntax.units import meant_unit


def find_unit(before: re.Match[str], found: re.Match[str]) -> DelayedError | None:
    """Find a number whose unit has another name here: `1 sec`."""
    number, name = before[0], found[0]
    gap = found.string[before.end() : found.start()]
    unit = meant_unit(name) if number[0].isdigit() and not gap.strip(" \t") else None
    if unit is None or unit == name:
        return None
    message = f"expected a unit, found `{name}`"
    return DelayedError(before.start(), found.end(), message, write(f"{number} {unit}"))


def find_keyword(
    expected: set[str], before: re.Match[str], found: re.Match[str]
) -> DelayedError | None:
    """Find a misspelled keyword that the parser took for the name of a part, field or swarm."""
    word = before[0]
    known = RESERVED if "`:`" in expected else frozenset[str]()
    if found[0] == "event" and "`{`" in expected:
        known = frozenset(("operator",))
    keyword = closest(word, known, MIN_SIMILARITY)
    if keyword is None or keyword == word:
        return None
    message = f"expected `{keyword}`, found `{word}`"
    return DelayedError(*before.span(), message, meant(keyword))
