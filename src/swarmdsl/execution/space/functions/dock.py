"""Docking: one robot at a charger at a time, in the order in which they asked."""

from __future__ import annotations

import numpy as np

from swarmdsl.execution.space.arrays import Flags, Floats, Rows, Small, Whole
from swarmdsl.execution.space.functions.base import Arguments, Model, statuses
from swarmdsl.execution.space.stage import Stage

FREE = -1
AT = 0.5
"""Distance in metres up to which a robot is at a charger."""


def admit(guest: Whole, asked: Floats) -> tuple[Whole, Floats]:
    """Return who is at each charger after the free ones were given away, and who still waits.

    `guest` (seeds, chargers) has the number of the robot that holds a charger, or `FREE`; `asked`
    (seeds, robots) has the time at which a robot asked, infinite for one that does not wait. Of
    robots that asked at the same time, the one with the lowest number is first.
    """
    guest, asked = guest.copy(), asked.copy()
    runs = np.arange(len(guest))
    for charger in range(guest.shape[1]):
        first = asked.argmin(axis=1)
        gives = (guest[:, charger] == FREE) & np.isfinite(asked[runs, first])
        guest[gives, charger] = first[gives]
        asked[runs[gives], first[gives]] = np.inf
    return guest, asked


def release(guest: Whole, leaves: Flags) -> Whole:
    """Return who is at each charger after robots (seeds, robots) have left or are lost."""
    held = guest != FREE
    gone = np.take_along_axis(leaves, np.maximum(guest, 0), axis=1) & held
    return np.where(gone, FREE, guest)


class Dock(Model):
    """Wait for a free charger, go there, and land; aborted where there are no chargers.

    The charger belongs to the robot until it goes away, is lost, or gives up on its way. With a
    power, it charges the robot until then.
    """

    def __init__(self, stage: Stage) -> None:
        super().__init__(stage)
        runs, rows = len(stage.seeds), stage.rows
        self._kind = np.full(rows, "", dtype=object)
        self._height, self._speed = np.zeros((2, rows))
        self._asked: dict[str, Floats] = {}
        self._guests: dict[str, Whole] = {}
        self._docked: Flags = np.zeros(rows, dtype=np.bool_)
        self._power: Floats = np.zeros(rows)
        self._runs = runs

    def start(self, who: Rows, arguments: Arguments) -> None:
        """Ask for a charger, after those that have asked before."""
        stage, kind = self.stage, arguments["target"] or "charger"
        self._kind[who] = kind
        self._height[who] = self.height(who, arguments)
        self._speed[who] = self.speed(who, arguments)
        self._docked[who] = False
        self._power[who] = arguments["power"]
        if kind not in self._guests and kind in stage.targets.kinds:
            number = len(self._chargers(kind))
            self._guests[kind] = np.full((self._runs, number), FREE)
            self._asked[kind] = np.full((self._runs, stage.robots), np.inf)
        if kind in self._guests:
            ticks = stage.ticks[stage.run[who]]
            self._asked[kind][stage.run[who], who % stage.robots] = ticks

    def step(self, who: Rows, dt: float) -> Small:
        """Give free chargers away; go on to them, and down."""
        done, failed = np.zeros((2, len(who)), dtype=np.bool_)
        for kind in dict.fromkeys(self._kind[who].tolist()):
            of = self._kind[who] == kind
            if kind in self._guests:
                done[of] = self._go(kind, who[of], dt)
            else:
                failed |= of
        return statuses(done, failed)

    def stop(self, who: Rows) -> None:
        """Connect robots that are there; give back the chargers of the others."""
        stage = self.stage
        there = who[self._docked[who]]
        stage.charger[there] = self._power[there]
        for kind, guest in self._guests.items():
            leaves = np.zeros((self._runs, stage.robots), dtype=np.bool_)
            gone = who[~self._docked[who] & (self._kind[who] == kind)]
            leaves[stage.run[gone], gone % stage.robots] = True
            self._asked[kind][leaves] = np.inf
            self._guests[kind] = release(guest, leaves)

    def _go(self, kind: str, who: Rows, dt: float) -> Flags:
        """Send robots to their chargers, others stay; return which are there."""
        stage, chargers = self.stage, self._chargers(kind)
        self._leave(kind, chargers)
        guest, self._asked[kind] = admit(self._guests[kind], self._asked[kind])
        self._guests[kind] = guest
        held = guest[stage.run[who]] == (who % stage.robots)[:, None]
        invited = held.any(axis=1)
        target = stage.run[who] * stage.targets.count + chargers[held.argmax(axis=1)]
        x = np.where(invited, stage.targets.x[target], stage.x[who])
        y = np.where(invited, stage.targets.y[target], stage.y[who])
        dx, dy = x - stage.x[who], y - stage.y[who]
        above = np.sqrt(dx * dx + dy * dy) <= AT / 5
        z = np.where(invited & above, 0.0, self._height[who])
        stage.steer(who, x, y, z, self._speed[who], dt)
        there: Flags = invited & above & (stage.z[who] <= 0)
        self._docked[who[there]] = True
        return there

    def _leave(self, kind: str, chargers: Whole) -> None:
        """Free the chargers whose robots are lost, or have gone away after they were there."""
        stage, guest = self.stage, self._guests[kind]
        rows = np.arange(self._runs)[:, None] * stage.robots + np.maximum(guest, 0)
        target = np.arange(self._runs)[:, None] * stage.targets.count + chargers
        dx = stage.x[rows] - stage.targets.x[target]
        dy = stage.y[rows] - stage.targets.y[target]
        away = self._docked[rows] & (np.sqrt(dx * dx + dy * dy) > AT)
        self._guests[kind] = np.where(away | ~stage.alive[rows], FREE, guest)

    def _chargers(self, kind: str) -> Whole:
        """Return the numbers of the chargers in each run."""
        targets = self.stage.targets
        return np.flatnonzero(targets.kind[: targets.count] == targets.kinds.index(kind))
