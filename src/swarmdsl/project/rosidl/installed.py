"""Find ROS 2 packages that are installed, by the index of ament."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from pathlib import Path

from swarmdsl.base.read_files import is_file
from swarmdsl.base.suggest import closest, did_you_mean
from swarmdsl.project.rosidl.standard import packages

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


def advice(name: str) -> str | None:
    """Return why no installed package has a name, and a way out; None if it is no such name."""
    if _NAME.fullmatch(name) is None:
        return None
    if name in packages():
        return f"the interfaces of `{name}` come with swarmdsl, and need no import"
    if PREFIXES not in os.environ:
        return (
            "name the folder of a ROS package; or, to name a package that is installed, source the "
            f"setup file of ROS 2 before: {PREFIXES} is not set"
        )
    stem = closest(_stem(name), map(_stem, installed_packages()))
    similar = (each for each in installed_packages() if _stem(each) == stem)
    return did_you_mean(name, similar)


def _stem(name: str) -> str:
    """Return the part of a name that tells packages apart."""
    return re.sub("_(msg|srv|interface|action)s?$", "", name)


def _prefixes() -> Iterator[str]:
    return filter(None, os.environ.get(PREFIXES, "").split(os.pathsep))
