"""Control of quadrotors: thrust and torques that make them fly as they want.

A velocity controller wants an acceleration, which tilts the robot and sets its thrust; an attitude
controller tilts it (T. Lee, M. Leok, N. H. McClamroch, 2010, with small angles). The drag of the
rotors is linear in the speed through the air (M. Faessler, A. Franchi, D. Scaramuzza, 2018).
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from swarmdsl.execution.physics.mjcf import GRAVITY, form_of
from swarmdsl.execution.space.arrays import Flags, Floats
from swarmdsl.execution.space.layout import Unit

MOST_TILT = math.radians(30)
_AT_TOP_SPEED = 0.8
"""Share of the acceleration by the greatest tilt that the drag takes at the greatest speed."""
_VELOCITY, _PLACE = 6.0, 6.0
"""Gains of the velocity, in 1/s, and of what was missed, in 1/s2."""
_TILT, _TILT_RATE, _YAW, _YAW_RATE = 625.0, 40.0, 3.0, 8.0
"""Gains of the attitude: accelerations by angle, in 1/s2, and by its rate, in 1/s."""
_MOST_LIFT = 0.5
"""Greatest vertical acceleration, in multiples of that of free fall."""


class Quadrotors:
    """Controllers of the quadrotors of a run; arrays have a row for each of them."""

    def __init__(self, units: Sequence[Unit]) -> None:
        forms = [form_of(unit.body) for unit in units]
        self.mass: Floats = np.array([form.mass for form in forms])
        self._inertia: Floats = np.array(
            [(form.inertia[0], form.inertia[0], form.inertia[1]) for form in forms]
        ).reshape(-1, 3)
        self._turn: Floats = np.array([unit.body.turn for unit in units])
        most = GRAVITY * math.tan(MOST_TILT)
        speeds: Floats = np.array([max(unit.body.speed, 1e-3) for unit in units])
        self._drag: Floats = _AT_TOP_SPEED * most / speeds
        self._most = most
        self._skim: Floats = np.array([0.1 + 0.6 * form.radius for form in forms])
        """Least height at which each robot flies to somewhere else."""
        self.missed: Floats = np.zeros((len(units), 3))
        """Way that each robot has gone too little."""

    def drag(self, velocity: Floats, wind: Floats, on: Flags) -> Floats:
        """Return the forces of the air on turning rotors."""
        through = velocity - wind
        through[:, 2] = 0.0
        return -(self.mass * self._drag * on)[:, None] * through

    def motors_on(self, wanted: Floats, height: Floats, alive: Flags) -> Flags:
        """Return the robots whose motors are on: those in the air, and those that want to go."""
        goes = (wanted[:, 2] > 0) | (np.hypot(wanted[:, 0], wanted[:, 1]) > 0.05)
        on: Flags = alive & ((height > 0) | goes)
        return on

    def wants(self, wanted: Floats, height: Floats) -> Floats:
        """Return the velocities to fly: nobody flies to somewhere else on the ground."""
        travels = np.hypot(wanted[:, 0], wanted[:, 1]) > 0.5
        rise = np.where(travels, 2 * (self._skim - height), -np.inf)
        found = wanted.copy()
        found[:, 2] = np.maximum(found[:, 2], np.minimum(rise, 0.5))
        return found

    def control(
        self,
        wanted: Floats,
        velocity: Floats,
        axes: Floats,
        spin: Floats,
        on: Flags,
        dt: float,
    ) -> Floats:
        """Return the thrust of each robot, and its torques around its own axes.

        `axes` are rotation matrices from the robot to the world, `spin` rates around its own axes.
        """
        error = wanted - velocity
        push = _VELOCITY * error + _PLACE * self.missed
        push[:, :2] += self._drag[:, None] * wanted[:, :2]
        length = np.hypot(push[:, 0], push[:, 1])
        lift = _MOST_LIFT * GRAVITY
        # A robot that does what it can misses nothing that it could catch up with later.
        can = np.column_stack((length < self._most, length < self._most, abs(push[:, 2]) < lift))
        self.missed = (self.missed + can * error * dt) * on[:, None]
        push[:, :2] *= np.minimum(1.0, self._most / np.maximum(length, 1e-9))[:, None]
        push[:, 2] = np.clip(push[:, 2], -lift, lift) + GRAVITY
        up = axes[:, :, 2]
        thrust = self.mass * np.maximum((push * up).sum(axis=1), 0.0)
        aim = push / np.sqrt((push * push).sum(axis=1))[:, None]
        lean = np.einsum("nij,ni->nj", axes, np.cross(up, aim))
        torques = np.empty_like(spin)
        torques[:, :2] = _TILT * lean[:, :2] - _TILT_RATE * spin[:, :2]
        torques[:, 2] = _YAW_RATE * (self._yaw_rate(wanted, axes) - spin[:, 2])
        torques *= self._inertia
        return np.column_stack((thrust, torques)) * on[:, None]

    def _yaw_rate(self, wanted: Floats, axes: Floats) -> Floats:
        """Return rates that turn robots to where they go."""
        ahead_x, ahead_y = axes[:, 0, 0], axes[:, 1, 0]
        along = ahead_x * wanted[:, 0] + ahead_y * wanted[:, 1]
        aside = ahead_x * wanted[:, 1] - ahead_y * wanted[:, 0]
        travels = np.hypot(wanted[:, 0], wanted[:, 1]) > 0.05
        angle = np.where(travels, np.arctan2(aside, along), 0.0)
        return np.clip(_YAW * angle, -self._turn, self._turn)
