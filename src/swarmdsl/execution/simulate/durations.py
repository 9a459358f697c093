"""Lengths of time: as they are written, and those that chance decides."""

from __future__ import annotations

import math
import re
from random import Random

from swarmdsl.base.records import dataclass
from swarmdsl.syntax.parser.literals import UNITS, nanoseconds

MILLISECOND = UNITS["ms"]
SECOND = UNITS["s"]

_WRITTEN = re.compile(rf"\s*([0-9]+(?:\.[0-9]+)?)\s*({'|'.join(UNITS)})\s*")
# 292 years: what ROS holds at most.
_LONGEST = 2**63 - 1
# So many evenly spread numbers have, added, a variance of 1, and are normally spread nearly.
_ADDED = 12


def duration(text: str) -> int | None:
    """The nanoseconds of a duration like `1.5 min`; None for anything else."""
    found = _WRITTEN.fullmatch(text)
    if found is None or len(found[1]) > len(str(_LONGEST)):
        return None
    length = nanoseconds(found[1], found[2])
    return length if length <= _LONGEST else None


def is_too_long(text: str) -> bool:
    """Whether a text is a duration but for its length, which ROS cannot hold."""
    return _WRITTEN.fullmatch(text) is not None and duration(text) is None


def shown(length: int) -> str:
    """A duration for people: `850 ms`, `12.5 s`, `4 min 3 s`, `2 h 0 min`."""
    if length < SECOND:
        return f"{length / MILLISECOND:.10g} ms"
    if length < 60 * SECOND:
        return f"{length / SECOND:.4g} s"
    minutes, seconds = divmod(round(length / SECOND), 60)
    if minutes < 60:
        return f"{minutes} min {seconds} s"
    return f"{minutes // 60} h {minutes % 60} min"


@dataclass(frozen=True)
class Fixed:
    """Always the same length."""

    length: int

    def draw(self, _chance: Random) -> int:
        """The length."""
        return self.length


@dataclass(frozen=True)
class Uniform:
    """Any length between two, in whole milliseconds."""

    low: int
    high: int

    def draw(self, chance: Random) -> int:
        """One of them."""
        return _whole(self.low + (self.high - self.low) * chance.random())


@dataclass(frozen=True)
class Normal:
    """Lengths around a mean, in whole milliseconds, never less than none.

    The sum of twelve numbers: `Random.gauss` asks the platform for a logarithm, whose last
    digit differs. So does that of `sum`, between versions of Python.
    """

    mean: int
    deviation: int

    def draw(self, chance: Random) -> int:
        """One of them."""
        spread = math.fsum(chance.random() for _ in range(_ADDED)) - _ADDED / 2
        return _whole(self.mean + self.deviation * spread)


Length = Fixed | Uniform | Normal
AT_ONCE = Fixed(0)
ONE_SECOND = Fixed(SECOND)


def _whole(length: float) -> int:
    return max(round(length / MILLISECOND), 0) * MILLISECOND
