"""Sets of numbers and strings for which a comparison with a constant holds."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterable, Iterator, Sequence
from math import ceil, floor, inf

from swarmdsl.base.records import dataclass

# A number and an offset: just below it (-1), at it (0), or just above it (1).
Bound = tuple[float, int]
Interval = tuple[Bound, Bound]

_LEAST: Bound = (-inf, 0)
_GREATEST: Bound = (inf, 0)


@dataclass(frozen=True)
class Numbers:
    """Disjoint intervals in ascending order, with or without NaN.

    NaN is not ordered and not equal to anything: `not (x > 3)` holds for it, `x <= 3` does not.
    A `whole` set contains only the integers in its intervals.
    """

    intervals: tuple[Interval, ...]
    nan: bool = False
    whole: bool = False

    def complement(self) -> Numbers:
        """Return all other numbers."""
        return Numbers(tuple(_gaps(self.intervals)), not self.nan, self.whole)

    def __and__(self, other: Numbers) -> Numbers:
        """Return the intersection."""
        kept = tuple(_overlaps(self.intervals, other.intervals))
        return Numbers(kept, self.nan and other.nan, self.whole)

    def __bool__(self) -> bool:
        """Return True if the set is not empty."""
        return self.nan or self._holds_any(self.intervals)

    def meets(self, other: Numbers) -> bool:
        """Return True if the sets intersect; faster than the intersection."""
        overlaps = _overlaps(self.intervals, other.intervals)
        return (self.nan and other.nan) or self._holds_any(overlaps)

    def _holds_any(self, intervals: Iterable[Interval]) -> bool:
        return any(not self.whole or _has_whole(low, high) for low, high in intervals)


@dataclass(frozen=True)
class Strings:
    """A finite set of strings or (`others`) its complement."""

    named: frozenset[str]
    others: bool = False

    def complement(self) -> Strings:
        """Return all other strings."""
        return Strings(self.named, not self.others)

    def __and__(self, other: Strings) -> Strings:
        """Return the intersection."""
        if self.others and other.others:
            return Strings(self.named | other.named, True)
        if self.others:
            return Strings(other.named - self.named)
        return Strings(self.named - other.named if other.others else self.named & other.named)

    def __bool__(self) -> bool:
        """Return True if the set is not empty."""
        return self.others or bool(self.named)

    def meets(self, other: Strings) -> bool:
        """Return True if the sets intersect."""
        return bool(self & other)


Values = Numbers | Strings


def all_numbers(*, whole: bool) -> Numbers:
    """Return the set of all numbers, with NaN unless `whole`."""
    return Numbers(((_LEAST, _GREATEST),), nan=not whole, whole=whole)


def between(least: int, most: int) -> Numbers:
    """Return the integers from `least` to `most`, both included."""
    return Numbers((((least, 0), (most, 0)),), whole=True)


def these(numbers: Iterable[int]) -> Numbers:
    """Return a set of integers."""
    return Numbers(tuple(((number, 0), (number, 0)) for number in sorted(set(numbers))), whole=True)


def compared(operator: str, number: float, *, whole: bool) -> Numbers:
    """Return the numbers for which a comparison with `number` holds."""
    below, at, above = (number, -1), (number, 0), (number, 1)
    intervals: tuple[Interval, ...] = ()
    match operator:
        case "==":
            intervals = ((at, at),)
        case "!=":
            intervals = ((_LEAST, below), (above, _GREATEST))
        case "<":
            intervals = ((_LEAST, below),)
        case "<=":
            intervals = ((_LEAST, at),)
        case ">":
            intervals = ((above, _GREATEST),)
        case ">=":
            intervals = ((at, _GREATEST),)
    return Numbers(intervals, nan=operator == "!=" and not whole, whole=whole)


def _overlaps(one: Sequence[Interval], other: Sequence[Interval]) -> Iterator[Interval]:
    """Yield the overlaps of two lists of intervals."""
    few, many = (one, other) if len(one) <= len(other) else (other, one)
    for low, high in few:
        for index in range(bisect_left(many, low, key=lambda each: each[1]), len(many)):
            least, most = many[index]
            if least > high:
                break
            yield max(low, least), min(high, most)


def _gaps(intervals: Iterable[Interval]) -> Iterator[Interval]:
    start = _LEAST
    for (low, beside_low), (high, beside_high) in intervals:
        if start <= (low, beside_low - 1):
            yield start, (low, beside_low - 1)
        start = (high, beside_high + 1)
    if start <= _GREATEST:
        yield start, _GREATEST


def _has_whole(low: Bound, high: Bound) -> bool:
    """Return True if an integer is between two bounds."""
    if -inf in (low[0], high[0]) or inf in (low[0], high[0]):
        return True
    first = floor(low[0]) + 1 if low[1] > 0 else ceil(low[0])
    last = ceil(high[0]) - 1 if high[1] < 0 else floor(high[0])
    return first <= last
