"""Source code of the state machine engine, copied into generated packages."""

from __future__ import annotations

from pathlib import Path

from swarmdsl.base import resources


def engine_folder() -> Path:
    """Return the folder with the modules of the engine."""
    return resources.engine()
