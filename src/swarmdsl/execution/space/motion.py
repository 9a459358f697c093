"""Motion of robots: the seam to who moves them, and the kinematic motion of the flat world.

The kinematic one has wanted velocities, wind, and contact with what is in the way.
"""

from __future__ import annotations

import numpy as np

from swarmdsl.execution.space.arrays import Flags, Floats, Part
from swarmdsl.execution.space.robots import Robots

_LEAST_SPEED = 1e-9


class Motion:
    """Move robots as they want, in each step; here without masses and forces.

    Others take the wanted velocities from the arrays of `robots`, and write there where robots
    are: places, velocities, headings, the way, the speed through the air, and who was `touched`.
    """

    arrival = 0.0
    """Distance in metres within which a robot has arrived at a place."""

    def __init__(self, robots: Robots) -> None:
        self.robots = robots

    def move(self, part: Part) -> None:
        """Move the robots in some rows, which are those of whole runs, by a step."""
        move(self.robots, part)

    def rests(self, run: int) -> bool:
        """Return True if no robot of a run moves that does not want to."""
        return True

    def pace(self, gap: Floats, fastest: Floats) -> Floats:
        """Return speeds at which robots approach what is a gap away; here they brake at once."""
        return fastest

    def lose(self, row: int) -> None:
        """Let a robot fall that is lost."""
        self.robots.z[row] = 0.0

    def restore(self, row: int) -> None:
        """Let a lost robot go on where it is."""

    def picture(self, run: int) -> bytes | None:
        """Return a picture of a run as PNG, None if there is none."""
        return None

    def close(self) -> None:
        """Give back what the motion holds."""


def move(stage: Robots, part: Part) -> None:
    """Move robots; those that would touch something stay where they are."""
    dt, z = stage.dt, stage.z[part]
    alive = stage.alive[part]
    air_x, air_y = stage.wanted_x[part] * alive, stage.wanted_y[part] * alive
    blowing = stage.weather.blows
    if blowing:
        wind_x, wind_y = stage.weather.wind(stage.ticks[stage.run[part]] * stage.step_length)
        exposed = alive & (z > 0)
        wind_x, wind_y = wind_x * exposed, wind_y * exposed
        air_x, air_y = air_x - wind_x, air_y - wind_y
    length = np.sqrt(air_x * air_x + air_y * air_y)
    speed = stage.speed[part]
    moving = length > _LEAST_SPEED
    safe = np.maximum(length, _LEAST_SPEED)
    share = np.minimum(speed / safe, 1.0)
    vx, vy = air_x * share, air_y * share
    stage.air_speed = np.minimum(length, speed)
    _turn(stage, part, air_x / safe, air_y / safe, moving)
    if blowing:
        vx, vy = vx + wind_x, vy + wind_y
    x, y = stage.x[part], stage.y[part]
    next_x, next_y = x + vx * dt, y + vy * dt
    if stage.inner is not None:
        low_x, low_y, high_x, high_y = stage.inner
        inside_x = np.minimum(np.maximum(next_x, low_x[part]), high_x[part])
        inside_y = np.minimum(np.maximum(next_y, low_y[part]), high_y[part])
        touched = (inside_x != next_x) | (inside_y != next_y)
        next_x, next_y = inside_x, inside_y
    else:
        touched = np.zeros(len(x), dtype=np.bool_)
    next_z = z
    if stage.any_flies:
        climb = stage.climb[part]
        vz = np.minimum(np.maximum(stage.wanted_z[part] * alive, -climb), climb)
        next_z = np.minimum(np.maximum(z + vz * dt, 0.0), stage.ceiling)
    if not stage.shapes.is_empty:
        places = (x, y), (next_x, next_y)
        stopped = stage.shapes.touched(*places, next_z, stage.radius[part], stage.reach[part])
        if len(stopped):
            touched[stopped] = True
            next_x[stopped], next_y[stopped] = x[stopped], y[stopped]
            if stage.any_flies:
                next_z[stopped] = z[stopped]
    dx, dy = next_x - x, next_y - y
    square = dx * dx + dy * dy
    if stage.any_flies:
        dz = next_z - z
        square += dz * dz
        stage.z[part], stage.vz[part] = next_z, dz / dt
    stage.vx[part], stage.vy[part] = dx / dt, dy / dt
    stage.x[part], stage.y[part] = next_x, next_y
    stage.distance[part] += np.sqrt(square)
    stage.touched[part] = touched


def _turn(stage: Robots, part: Part, x: Floats, y: Floats, moving: Flags) -> None:
    """Turn robots that move towards where they go, as far as they can in a step."""
    old_x, old_y = stage.heading_x[part], stage.heading_y[part]
    most_x = stage.turn_x[part]
    short = (moving & (old_x * x + old_y * y < most_x)).nonzero()[0]
    if len(short):
        from_x, from_y = old_x[short], old_y[short]
        cosine, most_y = most_x[short], stage.turn_y[part][short]
        sine = np.where(from_x * y[short] - from_y * x[short] >= 0, most_y, -most_y)
        turned_x, turned_y = from_x * cosine - from_y * sine, from_y * cosine + from_x * sine
        # Many small turns must not make the direction longer or shorter.
        length = np.sqrt(turned_x * turned_x + turned_y * turned_y)
        x[short], y[short] = turned_x / length, turned_y / length
    if np.count_nonzero(moving) < len(moving):
        x, y = np.where(moving, x, old_x), np.where(moving, y, old_y)
    stage.heading_x[part], stage.heading_y[part] = x, y
