"""Frames of PX4 and of ROS, and jumps of an estimate between two positions."""

from math import atan2, cos, isfinite, sin

_COUNTERS = 256
"""Values of a counter of PX4, which begins again after them."""


def to_ned(x, y, z):
    """Return a place of the frame east, north, up in the frame north, east, down, or back."""
    return y, x, -z


def turned(yaw):
    """Return an angle from east to the left as one from north to the right, or back."""
    return atan2(cos(yaw), sin(yaw))


def jump(before, after):
    """Return how far, and by which angle, the estimate has jumped between two positions."""
    seen = after.x - before.x, after.y - before.y, after.z - before.z
    north, east = _jumped(before, after, 'xy', after.delta_xy, seen[:2])
    (down,) = _jumped(before, after, 'z', [after.delta_z], seen[2:])
    turn = [after.heading - before.heading]
    (turn,) = _jumped(before, after, 'heading', [after.delta_heading], turn)
    return (north, east, down), turn


def _jumped(before, after, what, told, seen):
    """Return what is told of a jump, or what is seen of several: the last one alone is told."""
    name = f'{what}_reset_counter'
    count = (getattr(after, name) - getattr(before, name)) % _COUNTERS
    found = told if count == 1 else seen
    return [float(each) if count and isfinite(each) else 0.0 for each in found]


def heading(x, y, z, w):
    """Return the angle of a quaternion around the vertical axis; None if all of it is 0."""
    if not any((x, y, z, w)):
        return None
    return atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))
