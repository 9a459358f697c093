"""Three-way merge of texts, line by line: what two sides have made of the same one.

The algorithm is that of diff3 (S. Khanna, K. Kunal, B. C. Pierce, "A Formal Investigation of
Diff3", 2007). Lines that are the same in all three divide the text; what lies between two of
them is taken from the side that changed it. Where both have, and not in the same way, nobody can
tell: changes with no line between them are one.
"""

from __future__ import annotations

from difflib import SequenceMatcher

from swarmdsl.base.records import dataclass


@dataclass(frozen=True)
class Merge:
    """The result; None where it is not clear.

    `conflicts` are lines of the user's text, counted from 0, ends exclusive: where both sides
    have changed something. `taken` is how many changes of the generator are in the result.
    """

    text: bytes | None
    conflicts: tuple[tuple[int, int], ...]
    taken: int


def merge(base: bytes, of_user: bytes, generated: bytes) -> Merge:
    """What the user and the generator have made of a text, in one."""
    lines, user, ours = (text.splitlines(keepends=True) for text in (base, of_user, generated))
    in_user, in_ours = matches(lines, user), matches(lines, ours)
    made: list[bytes] = []
    conflicts: list[tuple[int, int]] = []
    taken = 0
    at_base = at_user = at_ours = 0
    ends = (len(lines), len(user), len(ours))
    stable = [(at, in_user[at], in_ours[at]) for at in in_user if at in in_ours]
    for end_base, end_user, end_ours in (*stable, ends):
        before = lines[at_base:end_base]
        theirs, here = user[at_user:end_user], ours[at_ours:end_ours]
        if theirs == before:
            made += here
            taken += here != before
        elif here in (before, theirs):
            made += theirs
        else:
            conflicts.append((at_user, end_user))
        made += lines[end_base : end_base + 1]
        at_base, at_user, at_ours = end_base + 1, end_user + 1, end_ours + 1
    return Merge(None if conflicts else b"".join(made), tuple(conflicts), taken)


def first_difference(base: bytes, of_user: bytes) -> int:
    """The line, counted from 0, where a text begins to be another one."""
    pairs = zip(base.splitlines(), of_user.splitlines(), strict=False)
    return next(
        (at for at, (one, other) in enumerate(pairs) if one != other), _shorter(base, of_user)
    )


def _shorter(one: bytes, other: bytes) -> int:
    return min(len(one.splitlines()), len(other.splitlines()))


def matches(before: list[bytes], after: list[bytes]) -> dict[int, int]:
    """The lines of one text that are in the other, in the same order."""
    blocks = SequenceMatcher(None, before, after, autojunk=False).get_matching_blocks()
    return {block.a + number: block.b + number for block in blocks for number in range(block.size)}
