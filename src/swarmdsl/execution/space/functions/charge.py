"""Charge: fill the battery at a charger, or have it swapped."""

from __future__ import annotations

import math

import numpy as np

from swarmdsl.execution.space.arrays import Rows, Small
from swarmdsl.execution.space.functions.base import Arguments, Model, statuses
from swarmdsl.execution.space.functions.choice import Choice
from swarmdsl.execution.space.functions.dock import AT
from swarmdsl.execution.space.stage import Stage


class Charge(Model):
    """Fill the battery up to a level; aborted away from chargers, in the air, or at a taken one.

    With a time, the battery is full after it, as it is where another one is put in.
    """

    stops_on_contact = False

    def __init__(self, stage: Stage) -> None:
        super().__init__(stage)
        self._power, self._level, self._left = np.zeros((3, stage.rows))
        self._choice = Choice(stage)
        self._at = np.full(stage.rows, -1)
        """Charger of each robot that charges, of all runs."""

    def start(self, who: Rows, arguments: Arguments) -> None:
        """Connect to the nearest charger in reach, if no other robot charges there."""
        self._choice.note(who, arguments["target"] or "charger")
        self._power[who] = arguments["power"]
        self._level[who] = arguments["level"]
        self._left[who] = math.inf if arguments["time"] is None else arguments["time"]
        for row in who.tolist():
            found = self._choice.nearest(row, AT)
            taken = found is None or bool((self._at == found).any())
            self._at[row] = -1 if taken or self.stage.z[row] > 0 else found

    def step(self, who: Rows, dt: float) -> Small:
        """Add the energy of a step."""
        stage = self.stage
        stage.halt(who)
        connected = self._at[who] >= 0
        swaps = np.isfinite(self._left[who])
        goal = stage.capacity[who] * np.where(swaps, 1.0, self._level[who])
        self._left[who] -= dt
        swapped = connected & (self._left[who] < dt / 2)
        added = np.where(connected & ~swaps, self._power[who] * dt, 0.0)
        added = np.where(swapped, np.inf, added)
        has = np.isfinite(stage.capacity[who])
        more = np.where(has, np.minimum(added, np.maximum(goal - stage.energy[who], 0.0)), 0.0)
        stage.energy[who] += more
        stage.charged[who] += more
        full = np.where(swaps, swapped, ~has | (stage.energy[who] >= goal))
        return statuses(connected & full, ~connected)

    def stop(self, who: Rows) -> None:
        """Disconnect."""
        self._at[who] = -1
