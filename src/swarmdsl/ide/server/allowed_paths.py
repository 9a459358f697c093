"""Paths that the server may read: models, their libraries, installed packages.

A user opens a model of someone else in an editor without a second thought. An import in it must not
reach the user's other files.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from functools import cached_property
from pathlib import Path

from swarmdsl.base import resources
from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.driver.config import Settings
from swarmdsl.project.libraries import installed_folders

# Search paths of installed ROS packages, separated like PATH.
_ROS = ("AMENT_PREFIX_PATH", "COLCON_PREFIX_PATH", "ROS_PACKAGE_PATH")


class AllowedPaths:
    """Folders of the editor, sources and libraries of a project, and installed packages."""

    def __init__(self, folders: Iterable[Path], settings: Settings) -> None:
        named = [*folders, *settings.sources, *settings.libraries, resources.library()]
        self._folders = {os.path.realpath(each) for each in named}

    def __contains__(self, path: object) -> bool:
        real = os.path.realpath(str(path))
        return self._holds(self._folders, real) or self._holds(self._installed, real)

    def _holds(self, folders: Iterable[str], path: str) -> bool:
        return any(
            path == each or path.startswith(each.rstrip(os.sep) + os.sep) for each in folders
        )

    @cached_property
    def _installed(self) -> set[str]:
        return {os.path.realpath(each) for each in (*installed_folders(Diagnostics()), *_ros())}


def _ros() -> Iterator[Path]:
    yield Path("/opt/ros")
    for name in _ROS:
        yield from (Path(each) for each in os.environ.get(name, "").split(os.pathsep) if each)
