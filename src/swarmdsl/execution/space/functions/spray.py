"""Spray: treat the targets around a robot, as long as there is something in its tank."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from swarmdsl.execution.space.arrays import Rows, Small
from swarmdsl.execution.space.functions.base import Arguments, Model, statuses
from swarmdsl.execution.space.functions.choice import Choice
from swarmdsl.execution.space.stage import Stage


class Spray(Model):
    """Spray for a time; then the targets within the width of the jet are treated, and are gone.

    It takes an amount from the tank, and is aborted if there is less. The result is what is left,
    in the field `left`, and the number of targets that were treated, in `treated`.
    """

    stops_on_contact = False

    def __init__(self, stage: Stage) -> None:
        super().__init__(stage)
        self._left, self._width, self._amount = np.zeros((3, stage.rows))
        self._choice = Choice(stage)
        self._treated = np.zeros(stage.rows, dtype=np.int64)

    def start(self, who: Rows, arguments: Arguments) -> None:
        """Note what to treat, and how much it takes."""
        self._choice.note(who, arguments["target"])
        self._left[who], self._width[who] = arguments["time"], arguments["width"]
        self._amount[who] = arguments["amount"]

    def step(self, who: Rows, dt: float) -> Small:
        """Stay, until it is done."""
        stage = self.stage
        stage.halt(who)
        # Twenty times a twentieth is a whole tank.
        enough = stage.tank[who] >= self._amount[who] - 1e-9
        self._left[who] -= dt
        done = enough & (self._left[who] < dt / 2)
        for row in who[done].tolist():
            self._treated[row] = 0
            while (target := self._choice.nearest(row, float(self._width[row]) / 2)) is not None:
                stage.targets.taken[target] = True
                self._treated[row] += 1
        stage.tank[who[done]] = np.maximum(stage.tank[who[done]] - self._amount[who[done]], 0.0)
        return statuses(done, ~enough)

    def result(self, row: int) -> Mapping[str, Any]:
        """Return what is left in the tank, and how many targets were treated."""
        return {"left": float(self.stage.tank[row]), "treated": int(self._treated[row])}
