"""Meters: measures of one run, each from the number of robots for which a claim holds.

That number is a function of time, which changes at the steps of the run.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from .claims import Measure
from .facts import Facts
from .truth import Claims, Roll, is_momentary


@dataclass(frozen=True)
class Reading:
    """Value of a measure: a number, or a time in nanoseconds; None if there is none.

    It is not `reached` if the value is a time that passed without what was waited for.
    """

    value: float | None
    reached: bool = True


class Meter:
    """Measure of a run, or of one robot in it.

    `kind` is `count` (the number in the end), `total` (how often it became larger), `time` (its
    integral over time) or `until` (the time at which it was first not 0). `over` is `mean`, `min`
    or `max`: that of the number in the run, instead of the one in the end.
    What is `momentary` happens at a step, and is counted at each.
    """

    def __init__(self, kind: str, over: str | None = None, *, momentary: bool = False) -> None:
        self._kind = kind
        self._over = over
        self._momentary = momentary
        self._time = 0
        self._number = 0
        self._total = 0
        self._integral = 0
        self._least: int | None = None
        self._most = 0
        self._first: int | None = None

    def step(self, time: int, number: int) -> None:
        """Process a step: at this time, in nanoseconds, the claim holds for so many robots."""
        self._integral += self._number * (time - self._time)
        before = 0 if self._momentary else self._number
        self._total += max(number - before, 0)
        self._time, self._number = time, number
        self._least = number if self._least is None else min(self._least, number)
        self._most = max(self._most, number)
        if number and self._first is None:
            self._first = time

    def read(self, now: int, limit: int | None = None) -> Reading:
        """Return the value so far; the run ends now, and could have lasted until the limit."""
        integral = self._integral + self._number * (now - self._time)
        match self._over or self._kind:
            case "count":
                return Reading(self._number)
            case "total":
                return Reading(self._total)
            case "time":
                return Reading(integral)
            case "mean":
                return Reading(integral / now if now else self._number)
            case "min":
                return Reading(self._least or 0)
            case "max":
                return Reading(self._most)
            case "until":
                if self._first is not None:
                    return Reading(self._first)
                return Reading(now if limit is None else limit, reached=False)
        raise ValueError(self._over or self._kind)


def aggregated(aggregate: str, readings: Iterable[Reading]) -> Reading:
    """Return the sum, mean, least or greatest of the values of robots.

    Without a robot only the sum has a value. It is reached if all are; the least if one is.
    """
    found = list(readings)
    values = [each.value for each in found if each.value is not None]
    if aggregate == "sum":
        return Reading(sum(values), all(each.reached for each in found))
    if not values:
        return Reading(None)
    if aggregate == "mean":
        return Reading(sum(values) / len(values), all(each.reached for each in found))
    if aggregate == "min":
        return Reading(min(values), any(each.reached for each in found))
    return Reading(max(values), all(each.reached for each in found))


class Gauge:
    """Number of robots that a measure is about, for the meters of any number of runs."""

    def __init__(self, measure: Measure, facts: Facts) -> None:
        self.each = measure.each
        self.claims = Claims(measure.each, facts)
        self._measure = measure
        self._number = self.claims.number(measure.claim)
        self._momentary = is_momentary(measure.claim)

    def meter(self) -> Meter:
        """Return a meter for a run."""
        return Meter(self._measure.kind, self._measure.over, momentary=self._momentary)

    def number(self, bits: int, roll: Roll, me: str | None) -> int:
        """Return the number at a moment, in which these facts hold for the robot of `each`."""
        return self._number(roll, self.claims.key(bits, roll, me))

    def read(self, meters: Iterable[Meter], now: int, limit: int | None = None) -> Reading:
        """Return the value so far, like that of a meter, of the meters of a run."""
        readings = [each.read(now, limit) for each in meters]
        aggregate = self._measure.aggregate
        return readings[0] if aggregate is None else aggregated(aggregate, readings)
