"""Control of differential drives: speeds of two wheels that drive them where they want."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from swarmdsl.execution.physics.mjcf import form_of
from swarmdsl.execution.space.arrays import Flags, Floats
from swarmdsl.execution.space.layout import Unit

_TURN = 4.0
"""Rate of a turn by its angle, in 1/s."""
_ACCELERATION = 3.0
"""Greatest change of the speed, in m/s2: the wheels do not slip."""
_STILL = 1e-6


class Drives:
    """Controllers of the drives of a run; arrays have a row for each of them."""

    def __init__(self, units: Sequence[Unit]) -> None:
        forms = [form_of(unit.body) for unit in units]
        self._wheel: Floats = np.array([form.wheel for form in forms])
        self._half: Floats = np.array([form.track / 2 for form in forms])
        self._turn: Floats = np.array([unit.body.turn for unit in units])
        self._speed: Floats = np.zeros(len(units))

    def control(self, wanted: Floats, axes: Floats, alive: Flags, dt: float) -> Floats:
        """Return the rates of the left and right wheel of each robot, in radians per second.

        A robot turns to where it goes, and drives the slower the further it has to turn.
        """
        speed = np.hypot(wanted[:, 0], wanted[:, 1]) * alive
        ahead_x, ahead_y = axes[:, 0, 0], axes[:, 1, 0]
        along = ahead_x * wanted[:, 0] + ahead_y * wanted[:, 1]
        aside = ahead_x * wanted[:, 1] - ahead_y * wanted[:, 0]
        goes = speed > _STILL
        cosine = np.where(goes, along / np.where(goes, speed, 1.0), 0.0)
        angle = np.where(goes, np.arctan2(aside, along), 0.0)
        forward = speed * np.maximum(cosine, 0.0) ** 2
        most = _ACCELERATION * dt
        self._speed = self._speed + np.clip(forward - self._speed, -most, most)
        turn = np.clip(_TURN * angle, -self._turn, self._turn) * self._half
        return np.column_stack((self._speed - turn, self._speed + turn)) / self._wheel[:, None]
