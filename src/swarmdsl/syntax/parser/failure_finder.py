"""Find the first syntax error of a text, and the terminals expected there.

It interprets a program as the parsing machine of LPeg does (R. Ierusalimschy, A Text Pattern-
Matching Tool based on Parsing Expression Grammars, 2009), with an explicit stack, so that no
nesting is too deep. It takes about three times as long as the generated parser.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from functools import cache

from swarmdsl.base.records import dataclass

# Operations of instructions, each with the meaning of its number:
MATCH = 0  # match the terminal of that number
CHOICE = 1  # on a failure from here on, continue at an address
COMMIT = 2  # drop the last alternative and go to an address
CALL = 3  # call the rule at an address
RETURN = 4
END = 5

Instruction = tuple[int, int]


# A regular expression, the name of its rule, and the literal if it is one.
MachineTerminal = tuple[str, str, str]


@dataclass(frozen=True, slots=True)
class Mismatch:
    """Offset at which a text departs from the grammar, and the expected terminals."""

    at: int
    expected: frozenset[MachineTerminal]


def mismatch(
    program: Sequence[Instruction], terminals: Sequence[MachineTerminal], blank: str, text: str
) -> Mismatch | None:
    """Find where a text departs from the grammar of a program; None if it does not."""
    skip = _matcher(blank)
    furthest, expected = -1, set[MachineTerminal]()
    # Addresses to continue at, with the offset to go back to, or None for a return.
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
