"""Carry: go to a place with what the robot has taken."""

from __future__ import annotations

import numpy as np

from swarmdsl.execution.space.arrays import Rows, Small
from swarmdsl.execution.space.functions.base import ABORTED
from swarmdsl.execution.space.functions.go_to import GoTo


class Carry(GoTo):
    """Go to a place; aborted for a robot that carries nothing."""

    def step(self, who: Rows, dt: float) -> Small:
        """Go on, if there is something to carry."""
        found = super().step(who, dt)
        found[~np.isin(who, self.stage.targets.carrier)] = ABORTED
        return found
