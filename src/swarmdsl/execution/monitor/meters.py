"""Meters: measures of one run, each from the number of robots for which a claim holds.

That number is a function of time, which changes at the steps of the run.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable
from dataclasses import dataclass

from .claims import Measure
from .facts import ActorLike
from .truth import Claims, Trackers, is_momentary


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
    """Meters of one measure: one, or one for each robot of a role."""

    def __init__(self, measure: Measure, trackers: Trackers) -> None:
        self.claims = Claims(measure.each, trackers)
        self._measure = measure
        self._number = self.claims.number(measure.claim)
        self._momentary = is_momentary(measure.claim)
        self._meters: dict[str | None, Meter] = {}
        if measure.each is None:
            self._meters[None] = self._meter()

    @property
    def robots(self) -> Collection[str | None]:
        """Robots that have a meter; None for the one of all of them."""
        return self._meters

    def join(self, actor: ActorLike) -> None:
        """Follow a machine from its first line on."""
        robot = actor.robot
        if robot.role == self._measure.each and robot.name not in self._meters:
            self._meters[robot.name] = self._meter()

    def step(self, time: int, robots: Iterable[str | None]) -> None:
        """Take a step, in which the claim can have changed for these robots."""
        for robot in robots:
            self._meters[robot].step(time, self._number(robot))

    def read(self, now: int, limit: int | None = None) -> Reading:
        """Return the value so far, like that of a meter."""
        readings = [each.read(now, limit) for each in self._meters.values()]
        aggregate = self._measure.aggregate
        return readings[0] if aggregate is None else aggregated(aggregate, readings)

    def _meter(self) -> Meter:
        return Meter(self._measure.kind, self._measure.over, momentary=self._momentary)
