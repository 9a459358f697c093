"""Lines that two versions of a file have in common, in time that grows with their number.

`difflib` reads what is left of a file again after each difference. In long files, lines that both
versions have once divide the file first, as in patience diff (B. Cohen), and only the short parts
between them are left to `difflib`.
"""

from __future__ import annotations

from bisect import bisect_left
from collections import Counter
from collections.abc import Iterator, Sequence
from difflib import Match, SequenceMatcher
from itertools import pairwise
from typing import Any

# Below this, `difflib` alone is quick, and its result can be a little better.
_FEW_LINES = 1_000
# Without a line to divide it, a longer part is one difference.
_MANY_LINES = 4_000

_Part = tuple[int, int, int, int]


def line_matcher(
    before: Sequence[Any], after: Sequence[Any], *, autojunk: bool = True
) -> SequenceMatcher[Any]:
    """Return a matcher of the lines of two versions that is quick with long files, too."""
    if len(before) + len(after) <= _FEW_LINES:
        return SequenceMatcher(None, before, after, autojunk)
    return _LongMatcher(before, after, autojunk)


class _LongMatcher(SequenceMatcher[Any]):
    def __init__(self, before: Sequence[Any], after: Sequence[Any], autojunk: bool) -> None:
        super().__init__(None, (), (), autojunk)  # which would index all lines
        self.a, self.b = before, after
        self._autojunk = autojunk
        self._found: list[Match] = []

    def get_matching_blocks(self) -> list[Match]:
        """Return blocks of common lines, the last of which is empty."""
        if not self._found:
            blocks: list[Match] = []
            for block in self._blocks((0, len(self.a), 0, len(self.b))):
                last = blocks[-1] if blocks else None
                if last and last.a + last.size == block.a and last.b + last.size == block.b:
                    blocks[-1] = Match(last.a, last.b, last.size + block.size)
                elif block.size:
                    blocks.append(block)
            self._found = [*blocks, Match(len(self.a), len(self.b), 0)]
        return self._found

    def _blocks(self, whole: _Part) -> Iterator[Match]:
        """Yield the blocks in order; some are empty."""
        before, after = self.a, self.b
        ahead: list[_Part | Match] = [whole]
        while ahead:
            each = ahead.pop()
            if isinstance(each, Match):
                yield each
                continue
            low, high, start, end = each
            head = tail = 0
            most = min(high - low, end - start)
            while head < most and before[low + head] == after[start + head]:
                head += 1
            while tail < most - head and before[high - tail - 1] == after[end - tail - 1]:
                tail += 1
            yield Match(low, start, head)
            ahead.append(Match(high - tail, end - tail, tail))
            if head + tail < most:
                ahead += self._divided(low + head, high - tail, start + head, end - tail)

    def _divided(self, low: int, high: int, start: int, end: int) -> Sequence[_Part | Match]:
        """Return the parts between lines that divide a part, or its blocks; the last one first."""
        before, after = self.a[low:high], self.b[start:end]
        anchors = _anchors(before, after)
        if anchors:
            ends = [(0, 0), *anchors, (len(before), len(after))]
            return [
                (low + one[0], low + other[0], start + one[1], start + other[1])
                for one, other in reversed([*pairwise(ends)])
            ]
        if len(before) + len(after) > _MANY_LINES:
            return ()
        found = SequenceMatcher(None, before, after, self._autojunk).get_matching_blocks()
        return [Match(low + at, start + to, size) for at, to, size in reversed(found)]


def _anchors(before: Sequence[Any], after: Sequence[Any]) -> list[tuple[int, int]]:
    """Return pairs of lines that both versions have once, in the same order in both."""
    here, there = Counter(before), Counter(after)
    places = {line: at for at, line in enumerate(after)}
    return _longest_ascending(
        [
            (at, places[line])
            for at, line in enumerate(before)
            if here[line] == 1 and there[line] == 1
        ]
    )


def _longest_ascending(pairs: list[tuple[int, int]]) -> list[tuple[int, int]]:
    """Return as many pairs as possible whose second numbers ascend."""
    ends: list[int] = []
    chosen: list[int] = []
    earlier: list[int] = []
    for number, (_, to) in enumerate(pairs):
        at = bisect_left(ends, to)
        ends[at : at + 1] = [to]
        chosen[at : at + 1] = [number]
        earlier.append(chosen[at - 1] if at else -1)
    found = []
    number = chosen[-1] if chosen else -1
    while number >= 0:
        found.append(pairs[number])
        number = earlier[number]
    return found[::-1]
