"""Power that robots need, by what they do."""

from __future__ import annotations

import math

import numpy as np

from swarmdsl.execution.space.arrays import Floats
from swarmdsl.execution.space.layout import Battery, Layout

_NONE = Battery(math.inf)


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
        self.idling = column([each.idling for each in batteries])
        self.sensing = column(sensing)
