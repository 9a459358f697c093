"""Follow a path: go from one place to the next, in straight lines."""

from __future__ import annotations

import numpy as np

from swarmdsl.execution.space.arrays import Flags, Rows, Small
from swarmdsl.execution.space.functions.base import Arguments, Model, Place, statuses
from swarmdsl.execution.space.stage import Stage


class FollowPath(Model):
    """Go to all places of a path; done at the last one, aborted without any."""

    def __init__(self, stage: Stage) -> None:
        super().__init__(stage)
        self._x, self._y, self._z, self._height, self._speed, self._tolerance = np.zeros(
            (6, stage.rows)
        )
        self._paths: dict[int, tuple[Place, ...]] = {}
        self._leg = np.zeros(stage.rows, dtype=np.int64)

    def start(self, who: Rows, arguments: Arguments) -> None:
        """Go to the first place; those on the ground are gone to at the height of now."""
        path = tuple(arguments["path"] or ())
        self._leg[who] = 0
        self._height[who] = self.height(who, arguments)
        self._speed[who] = self.speed(who, arguments)
        self._tolerance[who] = arguments["tolerance"]
        for row in who.tolist():
            self._paths[row] = path
            if path:
                self._aim(row)

    def step(self, who: Rows, dt: float) -> Small:
        """Go on, to the next place from each one that is reached."""
        stage = self.stage
        lost = np.array([not self._paths[row] for row in who.tolist()], dtype=np.bool_)
        near = self._is_near(who)
        done = np.zeros(len(who), dtype=np.bool_)
        for number in np.flatnonzero(near & ~lost).tolist():
            row = int(who[number])
            done[number] = self._leg[row] + 1 >= len(self._paths[row])
            if not done[number]:
                self._leg[row] += 1
                self._aim(row)
        stage.steer(who, self._x[who], self._y[who], self._z[who], self._speed[who], dt)
        return statuses(done, lost)

    def stop(self, who: Rows) -> None:
        """Forget the paths."""
        for row in who.tolist():
            self._paths.pop(row, None)

    def _aim(self, row: int) -> None:
        x, y, z = self._paths[row][self._leg[row]]
        self._x[row], self._y[row] = x, y
        self._z[row] = z if z > 0 else self._height[row]

    def _is_near(self, who: Rows) -> Flags:
        stage = self.stage
        dx, dy = self._x[who] - stage.x[who], self._y[who] - stage.y[who]
        dz = np.where(stage.flies[who], self._z[who] - stage.z[who], 0.0)
        near: Flags = np.sqrt(dx * dx + dy * dy + dz * dz) <= self._tolerance[who]
        return near
