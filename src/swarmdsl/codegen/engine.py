"""Source code of the state machine engine and of monitors, copied into generated packages."""

from __future__ import annotations

from pathlib import Path

from swarmdsl.base import resources


def engine_folder() -> Path:
    """Return the folder with the modules of the engine."""
    return resources.engine()


def monitors_folder() -> Path:
    """Return the folder with the modules of the monitors of properties."""
    return resources.monitors()
