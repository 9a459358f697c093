"""Motion of robots with masses, forces and contacts, by MuJoCo."""

from __future__ import annotations

import math

import mujoco
import numpy as np

from swarmdsl.execution.physics.mjcf import mjcf
from swarmdsl.execution.physics.scene import Scene
from swarmdsl.execution.physics.starts import apart
from swarmdsl.execution.space.arrays import Floats, Part
from swarmdsl.execution.space.layout import Layout
from swarmdsl.execution.space.motion import Motion
from swarmdsl.execution.space.robots import Robots

SUBSTEP = 0.005
"""Longest time between two substeps, in seconds."""
_BRAKES = 2.0
"""Acceleration with which robots brake, in m/s2."""
_NEARER = 2.0
"""Rate of the approach to a place, in 1/s."""


class PhysicalMotion(Motion):
    """Robots of some runs, each run in a scene of its own."""

    arrival = 0.1

    def __init__(self, robots: Robots) -> None:
        super().__init__(robots)
        self._substeps = substeps(robots.layout, robots.dt)
        model = mujoco.MjModel.from_xml_string(mjcf(robots.layout, robots.dt / self._substeps))
        self.scenes = []
        for run in range(len(robots.seeds)):
            rows = self._rows(run)
            robots.x[rows], robots.y[rows] = apart(robots, rows)
            self.scenes.append(Scene(model, robots.layout.units, robots.x[rows], robots.y[rows]))
        self._still = [0] * len(self.scenes)
        """Number of steps for which all in each run has been at rest."""
        self._through_air: Floats = np.zeros(robots.rows)

    def move(self, part: Part) -> None:
        """Do a step of some runs."""
        runs = range(len(self.scenes)) if isinstance(part, slice) else self._runs(part)
        for run in runs:
            self._move(run)
        self.robots.air_speed = self._through_air[part]

    def pace(self, gap: Floats, fastest: Floats) -> Floats:
        """Return speeds from which robots can brake, and do not swing around a place."""
        return np.minimum(fastest, np.minimum(np.sqrt(2 * _BRAKES * gap), _NEARER * gap))

    def rests(self, run: int) -> bool:
        """Return True if all is at rest, and not only turns back at the top of its way."""
        return self._still[run] >= 2

    def lose(self, row: int) -> None:
        """Let a robot fall: the motors of lost ones are off."""
        self._still[row // self.robots.robots] = 0

    def picture(self, run: int) -> bytes:
        """Return a picture of a run as PNG. Raises NoPictureError."""
        from swarmdsl.execution.physics.picture import picture

        return picture(self.scenes[run])

    def restore(self, row: int) -> None:
        """Set a robot on its feet."""
        robots = self.robots
        run = row // robots.robots
        self.scenes[run].set_upright(row % robots.robots)
        self._still[run] = 0

    # ---- internal

    def _rows(self, run: int) -> slice:
        return slice(run * self.robots.robots, (run + 1) * self.robots.robots)

    def _runs(self, part: Part) -> list[int]:
        found: list[int] = (part[:: self.robots.robots] // self.robots.robots).tolist()
        return found

    def _move(self, run: int) -> None:
        robots, rows = self.robots, self._rows(run)
        alive = robots.alive[rows]
        wind = np.zeros(3)
        if robots.weather.blows:
            x, y = robots.weather.wind(robots.ticks[run : run + 1] * robots.step_length)
            wind[:2] = x[0], y[0]
        wanted = self._wanted(rows, wind)
        places = self.scenes[run].step(wanted, alive, wind, self._substeps)
        x, y, z = places.place.T
        dx, dy, dz = x - robots.x[rows], y - robots.y[rows], z - robots.z[rows]
        robots.x[rows], robots.y[rows], robots.z[rows] = x, y, z
        robots.vx[rows], robots.vy[rows], robots.vz[rows] = places.velocity.T
        robots.heading_x[rows], robots.heading_y[rows] = places.heading.T
        robots.distance[rows] += np.sqrt(dx * dx + dy * dy + dz * dz)
        robots.touched[rows] = places.touched
        self._still[run] = self._still[run] + 1 if self.scenes[run].is_at_rest else 0
        through = places.velocity - wind * (z > 0)[:, None]
        self._through_air[rows] = np.hypot(through[:, 0], through[:, 1])

    def _wanted(self, rows: slice, wind: Floats) -> Floats:
        """Return the velocities over ground that robots want and that their bodies allow."""
        robots = self.robots
        alive = robots.alive[rows]
        air = np.zeros((len(alive), 2))
        air += wind[:2] * ((robots.z[rows] > 0) & robots.flies[rows])[:, None]
        flat = np.column_stack((robots.wanted_x[rows], robots.wanted_y[rows])) - air
        length = np.hypot(flat[:, 0], flat[:, 1])
        flat *= np.minimum(1.0, robots.speed[rows] / np.maximum(length, 1e-9))[:, None]
        climb = robots.climb[rows]
        rise = np.minimum(np.maximum(robots.wanted_z[rows], -climb), climb)
        found: Floats = np.column_stack((flat + air, rise)) * alive[:, None]
        return found


def substeps(layout: Layout, dt: float) -> int:
    """Return the number of substeps of a step: in none, a robot goes far into a wall."""
    bodies = [unit.body for unit in layout.units]
    shortest = min((each.radius / 2 / max(each.speed, 1.0) for each in bodies), default=SUBSTEP)
    return math.ceil(dt / min(SUBSTEP, shortest) - 1e-9)
