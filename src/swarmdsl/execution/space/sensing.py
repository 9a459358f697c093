"""Sensors of robots: which targets they see, miss, or take something else for.

The field of view of a robot on the ground is around the direction in which it looks; a robot in the
air looks down.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from swarmdsl.execution.simulate.scenario.durations import SECOND
from swarmdsl.execution.space.arrays import Flags, Floats, Part, Rows, Whole
from swarmdsl.execution.space.hashing import key, shares
from swarmdsl.execution.space.robots import Robots
from swarmdsl.execution.space.turning import direction, direction_of
from swarmdsl.execution.space.weather import RAIN_SIGHT

_NONE = -1
_WRONG, _WHICH = key("sees", "wrong"), key("sees", "which")
_DISTANCE, _ANGLE = key("sees", "distance"), key("sees", "angle")


def radius_below(height: Floats, tangent: Floats | float) -> Floats:
    """Return the radius of a cone that looks down, at some heights below its tip."""
    below = np.where(height > 0, height, 1.0)
    made: Floats = np.where(height > 0, below * tangent, 0.0)
    return made


def footprint(stage: Robots, rows: Rows, reach: Floats | float, tangent: Floats | float) -> Floats:
    """Return the radius on the ground that sensors of robots see.

    One in the air looks down: it sees more the higher it is, until its range ends.
    """
    z = np.where(stage.flies[rows], stage.z[rows], 0.0)
    level = np.sqrt(np.maximum(np.square(reach) - z * z, 0.0))
    made: Floats = np.where(z > 0, np.minimum(radius_below(z, tangent), level), reach)
    return made


def tangent_of(view: float) -> float:
    """Return the tangent of half an angle, infinite for a half circle and more."""
    return math.tan(view / 2) if view < math.pi else math.inf


class Sighting(NamedTuple):
    """Report of a sensor: the robot, its sensor, the target that it takes it for, and where."""

    row: int
    eye: int
    target: int
    x: float
    y: float
    z: float


class Eyes:
    """All sensors for targets; each is one column of all runs.

    `latest` is the target that each robot has seen with its last look, or -1.
    """

    def __init__(self, stage: Robots) -> None:
        self._stage = stage
        self.latest: Whole = np.full(stage.rows, _NONE)
        self.visible: Flags = np.zeros((stage.rows, stage.targets.count), dtype=np.bool_)
        """Targets of the run that each robot has truly seen with its last look."""
        self.place_x: Floats = np.zeros(stage.rows)
        """Place that each robot takes for that of the target it saw last: x; likewise for y."""
        self.place_y: Floats = np.zeros(stage.rows)
        self.eyes = [
            (robot, number, eye)
            for robot, unit in enumerate(stage.layout.units)
            for number, eye in enumerate(unit.eyes)
            if eye.kind in stage.targets.kinds
        ]
        groups: dict[tuple[object, ...], list[int]] = {}
        for place, (_, number, eye) in enumerate(self.eyes):
            period = max(round(SECOND / (eye.rate * stage.step_length)), 1) if eye.rate else 0
            group = (eye.kind, eye.range, eye.view, eye.miss, eye.wrong, period, number)
            if period:
                groups.setdefault(group, []).append(place)
        self._groups = [_Group(stage, self, places) for places in groups.values()]

    @property
    def is_needed(self) -> bool:
        """True if there is anything to see, and somebody to see it."""
        return bool(self._groups)

    def look(self, part: Part) -> list[Sighting]:
        """Return what robots in some rows see now, in order."""
        found: list[Sighting] = []
        for group in self._groups:
            found += group.look(part)
        return sorted(found)


class _Group:
    """Sensors that are alike, of different robots."""

    def __init__(self, stage: Robots, eyes: Eyes, places: list[int]) -> None:
        self._stage = stage
        self._eyes = eyes
        first = eyes.eyes[places[0]]
        self._number, eye = first[1], first[2]
        robots = [eyes.eyes[place][0] for place in places]
        self._has: Flags = np.isin(np.arange(stage.rows) % stage.robots, robots)
        """True for robots with such a sensor."""
        self._rows = np.flatnonzero(self._has)
        self._range = eye.range
        self._miss, self._wrong = eye.miss, eye.wrong
        self._width = min(eye.view, 2 * math.pi)
        self._view = direction_of(eye.view / 2)[0] if eye.view < 2 * math.pi else -2.0
        self._tangent = tangent_of(eye.view)
        self._period = max(round(SECOND / (eye.rate * stage.step_length)), 1)
        kind = stage.targets.kinds.index(eye.kind)
        self._targets = np.flatnonzero(stage.targets.kind[: stage.targets.count] == kind)
        self._missed = [
            key("misses", self._number, stage.targets.names[target]) for target in self._targets
        ]

    def look(self, part: Part) -> list[Sighting]:
        stage = self._stage
        rows = self._rows if isinstance(part, slice) else part[self._has[part]]
        ticks = stage.ticks[stage.run[rows]]
        is_due = (ticks % self._period == 0) & stage.alive[rows]
        rows, ticks = rows[is_due], ticks[is_due]
        if not len(rows):
            return []
        self._eyes.latest[rows] = _NONE
        self._eyes.visible[np.ix_(rows, self._targets)] = False
        found = self._told(*self._seen(rows, ticks))
        if self._wrong:
            found += self._mistaken(rows, ticks)
        return found

    def _seen(self, rows: Rows, ticks: Whole) -> tuple[Rows, Whole]:
        """Return the robots that see targets, with the numbers of these in the run."""
        stage, targets = self._stage, self._stage.targets
        which = stage.run[rows][:, None] * targets.count + self._targets
        dx = targets.x[which] - stage.x[rows][:, None]
        dy = targets.y[which] - stage.y[rows][:, None]
        dz = targets.z[which] - stage.z[rows][:, None]
        flat = dx * dx + dy * dy
        square = flat + dz * dz
        reach = np.full(len(rows), self._range)
        if stage.weather.rains:
            wet = stage.weather.is_raining(ticks * stage.step_length)
            reach = np.where(wet, reach * RAIN_SIGHT, reach)
        seen = (square <= (reach * reach)[:, None]) & ~targets.taken[which]
        seen &= targets.carrier[which] != rows[:, None]
        if self._view > -1:
            ahead = dx * stage.heading_x[rows][:, None] + dy * stage.heading_y[rows][:, None]
            in_front = ahead >= self._view * np.sqrt(flat)
            wide = radius_below(-dz, self._tangent)
            in_air = stage.flies[rows] & (stage.z[rows] > 0)
            seen &= np.where(in_air[:, None], (dz < 0) & (flat <= wide * wide), in_front)
        line, column = np.nonzero(seen)
        if self._miss and len(line):
            asked = np.array(self._missed, dtype=np.uint64)[column]
            drawn = shares(stage.keys[rows[line]] ^ asked, 0, ticks[line])
            line, column = line[drawn >= self._miss], column[drawn >= self._miss]
        if len(line) and not stage.shapes.is_empty:
            there, here = which[line, column], rows[line]
            free = (
                stage.shapes.crossings(
                    (stage.x[here], stage.y[here]),
                    (targets.x[there], targets.y[there]),
                    (stage.z[here], targets.z[there]),
                )
                == 0
            )
            line, column = line[free], column[free]
        return rows[line], self._targets[column]

    def _told(self, who: Rows, which: Whole) -> list[Sighting]:
        """Note true sightings, and return them."""
        if not len(who):
            return []
        stage, targets = self._stage, self._stage.targets
        there = stage.run[who] * targets.count + which
        targets.seen[there] = True
        self._eyes.visible[who, which] = True
        # Of several, the one with the least number.
        eyes, backwards = self._eyes, slice(None, None, -1)
        eyes.latest[who[backwards]] = there[backwards]
        eyes.place_x[who[backwards]] = targets.x[there][backwards]
        eyes.place_y[who[backwards]] = targets.y[there][backwards]
        places = targets.x[there], targets.y[there], targets.z[there]
        return [
            Sighting(row, self._number, target, x, y, z)
            for row, target, x, y, z in zip(
                who.tolist(), there.tolist(), *(each.tolist() for each in places), strict=True
            )
        ]

    def _mistaken(self, rows: Rows, ticks: Whole) -> list[Sighting]:
        """Return targets that robots take something else for."""
        stage = self._stage
        wrong = stage.chance(rows, _WRONG + self._number, ticks) < self._wrong
        rows, ticks = rows[wrong], ticks[wrong]
        if not len(rows):
            return []
        share = stage.chance(rows, _WHICH + self._number, ticks)
        which = self._targets[(share * len(self._targets)).astype(np.int64)]
        reach = footprint(stage, rows, self._range, self._tangent)
        distance = reach * np.sqrt(stage.chance(rows, _DISTANCE + self._number, ticks))
        in_air = stage.flies[rows] & (stage.z[rows] > 0)
        width = np.where(in_air, 2 * math.pi, self._width)
        turn = (stage.chance(rows, _ANGLE + self._number, ticks) - 0.5) * width
        cosine, sine = direction(turn)
        ahead_x, ahead_y = stage.heading_x[rows], stage.heading_y[rows]
        x = stage.x[rows] + distance * (ahead_x * cosine - ahead_y * sine)
        y = stage.y[rows] + distance * (ahead_y * cosine + ahead_x * sine)
        there = stage.run[rows] * stage.targets.count + which
        unseen = self._eyes.latest[rows] == _NONE
        self._eyes.latest[rows[unseen]] = there[unseen]
        self._eyes.place_x[rows[unseen]], self._eyes.place_y[rows[unseen]] = x[unseen], y[unseen]
        return [
            Sighting(row, self._number, target, far, up, 0.0)
            for row, target, far, up in zip(
                rows.tolist(), there.tolist(), x.tolist(), y.tolist(), strict=True
            )
        ]
