"""Sweep an area in parallel lanes, as an ox ploughs a field."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from swarmdsl.execution.space.arrays import Rows, Small
from swarmdsl.execution.space.functions.base import Arguments, Finding, Model, statuses
from swarmdsl.execution.space.functions.choice import Choice
from swarmdsl.execution.space.sensing import tangent_of

if TYPE_CHECKING:
    from swarmdsl.execution.space.stage import Stage


_LEAST_WIDTH = 0.1
"""Minimum width in metres of a lane that follows from the height of flight."""


class Coverage(Model):
    """Lanes along the longer side of a share of the area: one for each robot of a role.

    Where there are targets, it succeeds when the robot sees one, and is aborted at the end of the
    last lane. Without any, it succeeds there. A search for new targets goes on where the robot
    found the one before.
    """

    def __init__(self, stage: Stage) -> None:
        super().__init__(stage)
        rows = stage.rows
        self._low_x, self._low_y = np.zeros(rows), np.zeros(rows)
        self._wide, self._deep, self._width = np.zeros(rows), np.zeros(rows), np.zeros(rows)
        self._height, self._speed = np.zeros(rows), np.zeros(rows)
        self._lane, self._end = np.zeros(rows, dtype=np.int64), np.zeros(rows, dtype=np.int64)
        self._searches, self._goes_on = np.zeros((2, rows), dtype=np.bool_)
        self._found = np.zeros(rows, dtype=np.int64)
        self._choice = Choice(stage)

    def start(self, who: Rows, arguments: Arguments) -> None:
        """Divide the area, and begin with the first lane."""
        stage = self.stage
        low_x, low_y, high_x, high_y = self._bounds(arguments["area"])
        long_x = high_x - low_x >= high_y - low_y
        # The area is divided along its longer side, and the lanes lie along that of a share.
        share = (high_x - low_x if long_x else high_y - low_y) / stage.count[who]
        first = (low_x if long_x else low_y) + share * stage.index[who]
        self._low_x[who] = first if long_x else low_x
        self._low_y[who] = low_y if long_x else first
        self._wide[who] = share if long_x else high_x - low_x
        self._deep[who] = high_y - low_y if long_x else share
        anew = who[~self._goes_on[who]] if arguments["which"] == "new" else who
        self._lane[anew], self._end[anew] = 0, 0
        self._goes_on[who] = False
        self._height[who] = self.height(who, arguments)
        self._width[who] = arguments["width"]
        if arguments["view"] is not None:
            seen = 2 * tangent_of(arguments["view"]) * self._height[who]
            self._width[who] = np.maximum(seen, _LEAST_WIDTH)
        self._speed[who] = self.speed(who, arguments)
        target, kinds = arguments["target"], stage.targets.kinds
        self._searches[who] = bool(kinds) if target is None else self._choice.is_there(target)
        self._choice.note(who, target, arguments["which"])
        blind = who[~stage.covering.has_eyes[who]]
        reach = stage.covering.reach
        reach[blind] = np.maximum(reach[blind], self._width[blind] / 2)

    def step(self, who: Rows, dt: float) -> Small:
        """Go on to the next end of a lane; done when it sees a target, or after the last lane."""
        stage = self.stage
        wide, deep, width = self._wide[who], self._deep[who], self._width[who]
        lanes_along_y = deep >= wide
        across, along = np.where(lanes_along_y, wide, deep), np.where(lanes_along_y, deep, wide)
        lanes = np.maximum(np.ceil(across / width), 1.0)
        lane, end = self._lane[who], self._end[who]
        aside = np.minimum((lane + 0.5) * width, across - np.minimum(width, across) / 2)
        margin = np.minimum(width, along) / 2
        ahead = np.where((lane + end) % 2 == 0, margin, along - margin)
        x = self._low_x[who] + np.where(lanes_along_y, aside, ahead)
        y = self._low_y[who] + np.where(lanes_along_y, ahead, aside)
        radius = stage.radius[who]
        if stage.bounds is not None:
            left, bottom, right, top = stage.bounds
            x = np.minimum(np.maximum(x, left + radius), right - radius)
            y = np.minimum(np.maximum(y, bottom + radius), top - radius)
        arrives = stage.steer(who, x, y, self._height[who], self._speed[who], dt)
        self._lane[who] = lane + (arrives & (end == 1))
        self._end[who] = np.where(arrives, 1 - end, end)
        over = self._lane[who] >= lanes
        searches = self._searches[who]
        target = np.where(searches, self._choice.seen(who), -1)
        sees = target >= 0
        self._found[who[sees]] = target[sees]
        self._choice.claim(who[sees], target[sees])
        self._goes_on[who[sees & ~over]] = True
        return statuses(sees | (over & ~searches), over & ~sees & searches)

    def result(self, row: int) -> Finding:
        """Return the target that the robot has found, and where it takes it for."""
        if not self._searches[row]:
            found = super().result(row)
            assert isinstance(found, Finding)
            return found
        return self._choice.finding(row, int(self._found[row]))

    def _bounds(self, area: str | None) -> tuple[float, float, float, float]:
        layout = self.stage.layout
        if area is not None and area not in layout.areas:
            raise ValueError(f"the environment has no area `{area}`")
        bounds = layout.bounds(area)
        if bounds is None:
            raise ValueError("the environment has no size: name an area")
        return bounds
