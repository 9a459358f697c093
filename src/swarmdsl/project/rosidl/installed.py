"""Find ROS 2 packages that are installed, by the index of ament."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from pathlib import Path

from swarmdsl.base.read_files import is_file

PREFIXES = "AMENT_PREFIX_PATH"
"""Environment variable that the setup file of ROS 2 sets: the folders with packages."""
_INDEX = "share/ament_index/resource_index"
_NAME = re.compile(r"[a-z][a-z0-9_]*")


def installed_package(name: str) -> Path | None:
    """Return the folder with the interfaces of a package; None if it is not installed."""
    if _NAME.fullmatch(name) is None:
        return None
    for prefix in _prefixes():
        if is_file(Path(prefix, _INDEX, "packages", name)):
            return Path(prefix, "share", name)
    return None


def installed_packages() -> list[str]:
    """Return the names of the installed packages with interfaces, sorted."""
    found: set[str] = set()
    for prefix in _prefixes():
        try:
            found.update(os.listdir(Path(prefix, _INDEX, "rosidl_interfaces")))  # noqa: PTH208
        except OSError:
            continue  # a folder with other packages, or one that is gone
    return sorted(filter(_NAME.fullmatch, found))


def _prefixes() -> Iterator[str]:
    return filter(None, os.environ.get(PREFIXES, "").split(os.pathsep))
