"""Energy of robots: what they use in a step, and batteries that get empty."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from swarmdsl.execution.space.arrays import Floats, Part, Rows
from swarmdsl.execution.space.layout import Battery, Layout

if TYPE_CHECKING:
    from swarmdsl.execution.space.stage import Stage

_STILL = 0.01
"""Speed in m/s below which a robot does not move."""
_NONE = Battery(math.inf)


def full(layout: Layout, rows: int) -> Floats:
    """Return the energy of full batteries."""
    batteries = [(each.battery or _NONE).capacity for each in layout.units]
    return np.tile(np.array(batteries, dtype=np.float64), rows // max(len(batteries), 1))


class Consumption:
    """Power that the robots need, in watts, by what they do."""

    def __init__(self, layout: Layout, runs: int) -> None:
        batteries = [each.battery or _NONE for each in layout.units]
        self.is_needed = any(each.battery is not None for each in layout.units)

        def column(values: list[float]) -> Floats:
            return np.tile(np.array(values, dtype=np.float64), runs)

        sensing = [
            each.sensing if unit.eyes else 0.0
            for each, unit in zip(batteries, layout.units, strict=True)
        ]
        self.moving = column([each.moving for each in batteries])
        self.hovering = column([each.hovering for each in batteries])
        self.always = column([e.idling + s for e, s in zip(batteries, sensing, strict=True)])


def drain(stage: Stage, part: Part) -> Rows:
    """Use energy for a step; return the rows of robots that have none left."""
    consumption = stage.consumption
    if not consumption.is_needed:
        return np.empty(0, dtype=np.int64)
    alive = stage.alive[part]
    moves = (stage.air_speed > _STILL) | (np.abs(stage.vz[part]) > _STILL)
    hovers = ~moves & (stage.z[part] > 0)
    power = consumption.always[part] + consumption.moving[part] * moves
    power = (power + consumption.hovering[part] * hovers) * alive
    used = power * stage.dt
    stage.used[part] += used
    left = stage.energy[part] - used
    stage.energy[part] = np.maximum(left, 0.0)
    empty = np.flatnonzero(alive & (left <= 0))
    return empty if isinstance(part, slice) else part[empty]
