"""Batteries of robots, as `sensor_msgs/BatteryState` tells them."""

from __future__ import annotations

import math

BATTERY = "sensor_msgs/msg/BatteryState"


def share_of(percentage: float) -> float | None:
    """Return the charge from 0 to 1; None if the driver does not know it."""
    if not math.isfinite(percentage) or percentage < 0:
        return None
    # Some drivers give percent.
    return round(percentage if percentage <= 1 else percentage / 100, 3)
