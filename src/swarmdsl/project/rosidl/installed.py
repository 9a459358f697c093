"""Find ROS 2 packages that are installed, by the index of ament."""

from __future__ import annotations

import os
import re
from pathlib import Path

from swarmdsl.base.read_files import is_file

PREFIXES = "AMENT_PREFIX_PATH"
"""Environment variable that the setup file of ROS 2 sets: the folders with packages."""
_NAME = re.compile(r"[a-z][a-z0-9_]*")


def installed_package(name: str) -> Path | None:
    """Return the folder with the interfaces of a package; None if it is not installed."""
    if _NAME.fullmatch(name) is None:
        return None
    for prefix in filter(None, os.environ.get(PREFIXES, "").split(os.pathsep)):
        if is_file(Path(prefix, "share/ament_index/resource_index/packages", name)):
            return Path(prefix, "share", name)
    return None
