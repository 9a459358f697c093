"""The environment with ROS 2 for tests of any folder."""

from __future__ import annotations

import fcntl
import os
from pathlib import Path

import pytest

LOCK = "lock"  # held while `environment.py` makes the folder


def installed() -> Path:
    """Return its folder once it is made, where that still goes on; skip the test without one."""
    named = os.environ.get("SWARMDSL_ROS2")
    if named is None:
        pytest.skip("no ROS 2: `make test-ros2`")
    folder = Path(named)
    if (folder / LOCK).exists():
        with (folder / LOCK).open() as lock:
            fcntl.flock(lock, fcntl.LOCK_SH)
    return folder
