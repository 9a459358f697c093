"""Stage: the robots of many runs, and one step of all of them."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from swarmdsl.execution.space import energy
from swarmdsl.execution.space.arrays import Flags, Floats, Part, Rows
from swarmdsl.execution.space.covering import Covering
from swarmdsl.execution.space.layout import Layout
from swarmdsl.execution.space.motion import Motion
from swarmdsl.execution.space.neighbours import pairs
from swarmdsl.execution.space.robots import Robots
from swarmdsl.execution.space.routes import Router
from swarmdsl.execution.space.sensing import Eyes

_ALL = slice(None)


class Stage(Robots):
    """Robots of some runs, with what they see and cover, and what models of functions use."""

    def __init__(
        self, layout: Layout, seeds: Sequence[int], motion: Callable[[Robots], Motion] = Motion
    ) -> None:
        super().__init__(layout, seeds)
        self.motion = motion(self)
        self.eyes = Eyes(self)
        self.covering = Covering(self)
        self.router = Router(self.shapes, self.bounds, self.motion.arrival)
        self._pairs: dict[float, tuple[Rows, Rows]] = {}

    # ---- for models of functions

    def steer(self, who: Rows, x: Floats, y: Floats, z: Floats, speed: Floats, dt: float) -> Flags:
        """Let robots go to places; return True for those that arrive with this step."""
        dx, dy, dz = x - self.x[who], y - self.y[who], z - self.z[who]
        flat = np.sqrt(dx * dx + dy * dy)
        longest = self.motion.pace(flat, np.minimum(speed, self.speed[who])) * dt
        share = np.where(flat > longest, longest / np.where(flat > 0, flat, 1.0), 1.0)
        most = self.motion.pace(np.abs(dz), self.climb[who]) * dt
        rise = np.where(self.flies[who], np.clip(dz, -most, most), 0.0)
        self.wanted_x[who] = dx * share / dt
        self.wanted_y[who] = dy * share / dt
        self.wanted_z[who] = rise / dt
        near = self.motion.arrival
        level = (np.abs(dz - rise) <= near) | ~self.flies[who]
        arrives: Flags = (flat <= np.maximum(longest, near)) & level
        return arrives

    def keep_height(self, who: Rows, z: Floats, dt: float) -> None:
        """Let robots go up or down to a height, or stay there."""
        if not self.any_flies:
            self.wanted_z[who] = 0.0
            return
        dz = z - self.z[who]
        most = self.motion.pace(np.abs(dz), self.climb[who])
        self.wanted_z[who] = np.minimum(np.maximum(dz / dt, -most), most)

    def halt(self, who: Rows) -> None:
        """Let robots stay where they are."""
        self.wanted_x[who] = self.wanted_y[who] = self.wanted_z[who] = 0.0

    def pairs(self, distance: float) -> tuple[Rows, Rows]:
        """Return all pairs of robots that are there and near each other, both ways, in order."""
        found = self._pairs.get(distance)
        if found is None:
            rows = np.flatnonzero(self.alive)
            found = self._pairs[distance] = pairs(self.x, self.y, self.run, rows, distance)
        return found

    def moved(self) -> None:
        """Forget what is only so while nobody moves."""
        self._pairs.clear()

    def part_of(self, who: Rows) -> Part:
        """Return rows in order as an index: a slice, which takes less time, if they are all."""
        return _ALL if len(who) == self.rows else who

    # ---- steps

    def rows_of(self, runs: Sequence[int]) -> Part:
        """Return the rows of some runs, in order."""
        if len(runs) == len(self.seeds):
            return _ALL
        starts = np.asarray(runs, dtype=np.int64) * self.robots
        return (starts[:, None] + np.arange(self.robots)).ravel()

    def move(self, part: Part) -> Rows:
        """Move the robots in some rows as they want; return those whose battery gets empty."""
        self.moved()
        self.motion.move(part)
        self.targets.follow(self.x, self.y, self.z)
        self.covering.note(part)
        return energy.drain(self, part)
