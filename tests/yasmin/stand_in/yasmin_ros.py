"""A stand-in for what generated packages use of `yasmin_ros`."""

from __future__ import annotations

from typing import Any


def set_ros_loggers(node: Any = None) -> None:
    """Do nothing: the stand-in for YASMIN has no log."""
