"""Three-way merge of files, line by line.

The algorithm is diff3 (S. Khanna, K. Kunal, B. C. Pierce, "A Formal Investigation of Diff3",
2007). Lines that are the same in all three versions divide the files into chunks; each chunk is
taken from the side that changed it. A chunk that both sides changed differently is a conflict.
"""

from __future__ import annotations

from swarmdsl.base.line_matching import line_matcher
from swarmdsl.base.records import dataclass


@dataclass(frozen=True)
class Merge:
    """Result of a merge; `text` is None after a conflict.

    `conflicts` are line ranges of the user's version, from 0, ends exclusive. `taken` is the
    number of generated changes in the result.
    """

    text: bytes | None
    conflicts: tuple[tuple[int, int], ...]
    taken: int


def merge(base: bytes, of_user: bytes, generated: bytes) -> Merge:
    """Merge the versions of the user and of the generator."""
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
    """Return the first line that differs, from 0."""
    pairs = zip(base.splitlines(), of_user.splitlines(), strict=False)
    return next(
        (at for at, (one, other) in enumerate(pairs) if one != other), _shorter(base, of_user)
    )


def _shorter(one: bytes, other: bytes) -> int:
    return min(len(one.splitlines()), len(other.splitlines()))


def matches(before: list[bytes], after: list[bytes]) -> dict[int, int]:
    """Map lines of one version to equal lines of the other, in the same order."""
    blocks = line_matcher(before, after, autojunk=False).get_matching_blocks()
    return {block.a + number: block.b + number for block in blocks for number in range(block.size)}
