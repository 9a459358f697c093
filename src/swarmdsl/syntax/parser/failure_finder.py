"""Finds how far a text follows a grammar, and what could have come there.

It follows a program, as the parsing machine of LPeg does (R. Ierusalimschy, A Text Pattern-
Matching Tool based on Parsing Expression Grammars, 2009), with a stack of its own: nothing
is nested too deeply for it. It takes about three times as long as a generated parser, which
makes a tree as well.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from functools import cache

from swarmdsl.base.records import dataclass

# What an instruction does, and what its number means:
MATCH = 0  # match a terminal; its number
CHOICE = 1  # when something fails from here on, go on at an address instead
COMMIT = 2  # what was tried has succeeded: forget the other way, and go to an address
CALL = 3  # do what is at an address, up to its RETURN
RETURN = 4
END = 5

Instruction = tuple[int, int]


# A regular expression, the name of its rule, and the text where it is one.
MachineTerminal = tuple[str, str, str]


@dataclass(frozen=True, slots=True)
class Mismatch:
    """The place where a text stops following a grammar, and all that could come there."""

    at: int
    expected: frozenset[MachineTerminal]


def mismatch(
    program: Sequence[Instruction], terminals: Sequence[MachineTerminal], blank: str, text: str
) -> Mismatch | None:
    """Where a text departs from the grammar of a program; None when it follows it."""
    skip = _matcher(blank)
    furthest, expected = -1, set[MachineTerminal]()
    # Where to go on, and at which offset: None where a call returns.
    stack: list[tuple[int, int | None]] = []
    address = at = begin = 0
    skipped = -1
    while True:
        operation, number = program[address]
        address += 1
        if operation == MATCH:
            if at != skipped:  # several terminals are tried in one place
                skipped, blanks = at, skip(text, at)
                begin = blanks.end() if blanks is not None else at
            found = _matcher(terminals[number][0])(text, begin)
            if found is not None:
                at = found.end()
                continue
            if begin > furthest:
                furthest, expected = begin, set()
            if begin == furthest:
                expected.add(terminals[number])
            while stack:
                address, back = stack.pop()
                if back is not None:
                    at = back
                    break
            else:
                return Mismatch(furthest, frozenset(expected))
        elif operation == CHOICE:
            stack.append((number, at))
        elif operation == COMMIT:
            stack.pop()
            address = number
        elif operation == CALL:
            stack.append((address, None))
            address = number
        elif operation == RETURN:
            address, _ = stack.pop()
        else:
            return None


@cache
def _matcher(regex: str) -> Callable[[str, int], re.Match[str] | None]:
    return re.compile(regex, re.MULTILINE).match
