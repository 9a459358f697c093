"""Standard messages of sensors of robots: the charge of batteries, and places."""

from __future__ import annotations

import json
import math
from typing import Any

BATTERY = "sensor_msgs/msg/BatteryState"
POSE, ODOMETRY = "geometry_msgs/msg/PoseStamped", "nav_msgs/msg/Odometry"
TYPES = (BATTERY, POSE, ODOMETRY)


def share_of(battery: Any) -> float | None:
    """Return the charge of a battery from 0 to 1; None if the driver does not know it."""
    percentage = float(battery.percentage)
    if not math.isfinite(percentage) or percentage < 0:
        return None
    # Some drivers give percent.
    return round(percentage if percentage <= 1 else percentage / 100, 3)


def place_of(message: Any) -> tuple[float, float, float] | None:
    """Return the place in a message with a pose; None if it has a number that is not finite."""
    pose = message.pose
    at = getattr(pose, "pose", pose).position
    found = (round(at.x, 3), round(at.y, 3), round(at.z, 3))
    return found if all(map(math.isfinite, found)) else None


def moved_line(places: dict[str, tuple[float, float, float]], time: int) -> str:
    """Return a line with the places of robots at a time, in milliseconds since 1970."""
    return json.dumps({"t": 0, "began": time, "moved": places})
