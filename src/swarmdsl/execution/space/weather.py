"""Wind and rain in a space, by the time of each run."""

from __future__ import annotations

import numpy as np

from swarmdsl.execution.space.arrays import Flags, Floats, Whole
from swarmdsl.execution.space.layout import Layout
from swarmdsl.execution.space.turning import direction_of

RAIN_SIGHT = 0.5
"""Share of its range that a sensor sees in the rain."""


class Weather:
    """Weather of an environment; several winds at a time add up."""

    def __init__(self, layout: Layout) -> None:
        self._winds = [
            (each.speed * cosine, each.speed * sine, each.start, each.end)
            for each in layout.winds
            for cosine, sine in (direction_of(each.angle),)
        ]
        self._rains = [(each.start, each.end) for each in layout.rains]
        self.blows = bool(self._winds)
        """True if there is ever any wind."""
        self.strongest = sum(each.speed for each in layout.winds)
        """Speed that the wind never exceeds."""
        self.rains = bool(self._rains)
        """True if there is ever any rain."""

    def wind(self, times: Whole) -> tuple[Floats, Floats]:
        """Return the velocity of the wind at some times, in nanoseconds."""
        x, y = np.zeros(len(times)), np.zeros(len(times))
        for speed_x, speed_y, start, end in self._winds:
            blowing = _within(times, start, end)
            x, y = x + speed_x * blowing, y + speed_y * blowing
        return x, y

    def is_raining(self, times: Whole) -> Flags:
        """Return True for times at which it rains."""
        found = np.zeros(len(times), dtype=np.bool_)
        for start, end in self._rains:
            found |= _within(times, start, end)
        return found


def _within(times: Whole, start: int, end: int | None) -> Flags:
    found: Flags = times >= start
    return found if end is None else found & (times < end)
