"""Energy of robots: what they use in a step, and batteries that get empty."""

from __future__ import annotations

import numpy as np

from swarmdsl.execution.space.arrays import Part, Rows
from swarmdsl.execution.space.robots import Robots

GRAVITY = 9.81
"""Acceleration of free fall, in m/s2."""
_STILL = 0.01
"""Speed in m/s below which a robot does not move."""


def drain(stage: Robots, part: Part) -> Rows:
    """Use energy for a step; return the rows of robots that have none left.

    To climb takes the potential energy too; to go down gives nothing back.
    """
    consumption = stage.consumption
    if not consumption.is_needed:
        return np.empty(0, dtype=np.int64)
    alive = stage.alive[part]
    moves = (stage.air_speed > _STILL) | (np.abs(stage.vz[part]) > _STILL)
    hovers = ~moves & (stage.z[part] > 0)
    power = np.where(hovers, consumption.hovering[part], consumption.idling[part])
    power = np.where(moves, consumption.moving[part], power) + consumption.sensing[part]
    power = (power + stage.mass[part] * GRAVITY * np.maximum(stage.vz[part], 0.0)) * alive
    # The last step before a battery is empty gets what is left.
    used = np.minimum(power * stage.dt, stage.energy[part])
    stage.power[part] = used / stage.dt
    # Sums round: a robot never uses more than its battery has had.
    most = stage.capacity[part] + stage.charged[part]
    stage.used[part] = np.minimum(stage.used[part] + used, most)
    left = stage.energy[part] - used
    stage.energy[part] = left
    if stage.charger[part].any():
        _charge(stage, part)
    empty = np.flatnonzero(alive & (left <= 0))
    return empty if isinstance(part, slice) else part[empty]


def _charge(stage: Robots, part: Part) -> None:
    """Charge robots that stay at a charger; one that wants to move has left it."""
    wanted = np.abs(stage.wanted_x[part]) + np.abs(stage.wanted_y[part]) + stage.wanted_z[part]
    stage.charger[part] *= (wanted <= _STILL) & stage.alive[part]
    missing = np.maximum(stage.capacity[part] - stage.energy[part], 0.0)
    more = np.minimum(stage.charger[part] * stage.dt, missing)
    stage.energy[part] += more
    stage.charged[part] += more
