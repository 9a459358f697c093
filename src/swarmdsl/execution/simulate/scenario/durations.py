"""Durations: parsing, formatting and random distributions."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from random import Random

from swarmdsl.base.records import dataclass
from swarmdsl.syntax.parser.literals import UNITS, nanoseconds

MICROSECOND = UNITS["us"]
MILLISECOND = UNITS["ms"]
SECOND = UNITS["s"]

WRITTEN = re.compile(rf"\s*([0-9]+(?:\.[0-9]+)?)\s*({'|'.join(UNITS)})\s*")
# 292 years: the maximum in ROS.
_LONGEST = 2**63 - 1
# The sum of 12 uniform numbers has a variance of 1 and is nearly normal.
_ADDED = 12


def duration(text: str) -> int | None:
    """Parse a duration like `1.5 min` into nanoseconds; None if invalid."""
    found = WRITTEN.fullmatch(text)
    if found is None or len(found[1]) > len(str(_LONGEST)):
        return None
    length = nanoseconds(found[1], found[2])
    return length if length <= _LONGEST else None


def written_duration(length: int) -> str:
    """Write a duration so that `duration` reads the same: `90s`."""
    whole = [unit for unit, size in UNITS.items() if length and length % size == 0]
    if not whole:
        return f"{length // UNITS['us']}.{length % UNITS['us']:03}us"
    unit = max(whole, key=UNITS.__getitem__)
    return f"{length // UNITS[unit]}{unit}"


def is_too_long(text: str) -> bool:
    """Return True if a string is a duration that is too long for ROS."""
    return WRITTEN.fullmatch(text) is not None and duration(text) is None


def format_duration(length: int) -> str:
    """Format a duration: `850 ms`, `12.5 s`, `4 min 3 s`, `2 h 0 min`."""
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
    """Constant duration."""

    length: int

    @property
    def bounds(self) -> tuple[int, int]:
        """The least and the greatest duration."""
        return self.length, self.length

    def draw(self, _chance: Random) -> int:
        """Return the duration."""
        return self.length


@dataclass(frozen=True)
class Uniform:
    """Uniform distribution, in whole milliseconds."""

    low: int
    high: int

    @property
    def bounds(self) -> tuple[int, int]:
        """The least and the greatest duration."""
        return _whole(self.low), _whole(self.high)

    def draw(self, chance: Random) -> int:
        """Draw a duration."""
        return _whole(self.low + (self.high - self.low) * chance.random())


@dataclass(frozen=True)
class Normal:
    """Normal distribution, in whole milliseconds, cut off at 0.

    Computed as a sum of twelve uniform numbers: `Random.gauss` uses a logarithm of the platform,
    whose last digit varies. That of `sum` varies between versions of Python.
    """

    mean: int
    deviation: int

    @property
    def bounds(self) -> tuple[int, int]:
        """The least and the greatest duration: the sum of uniform numbers has both."""
        most = self.deviation * _ADDED // 2
        return _whole(self.mean - most), _whole(self.mean + most)

    def draw(self, chance: Random) -> int:
        """Draw a duration."""
        spread = math.fsum(chance.random() for _ in range(_ADDED)) - _ADDED / 2
        return _whole(self.mean + self.deviation * spread)


Length = Fixed | Uniform | Normal


def draw(length: Length, chance: Callable[[], Random]) -> int:
    """Draw a duration; a random stream is asked for only if it is needed."""
    return length.length if isinstance(length, Fixed) else length.draw(chance())


AT_ONCE = Fixed(0)
ONE_SECOND = Fixed(SECOND)


def _whole(length: float) -> int:
    return max(round(length / MILLISECOND), 0) * MILLISECOND
