"""Naming styles, and valid names of Python and ROS."""

from __future__ import annotations

import keyword
import re
from collections.abc import Iterable, Mapping, Set
from functools import lru_cache

_WORD = re.compile(r"[A-Z]+(?![a-z])|[A-Z]?[a-z0-9]+|[0-9]+")


def incoming_topic(topic: str, swarm: bool) -> str:
    """Return the topic on which an event sent on `topic` arrives."""
    return f"bridge/events/{topic}" if swarm else topic


@lru_cache(maxsize=1000)
def snake_case(name: str) -> str:
    """`UavSearch` and `uav-search` become `uav_search`."""
    return "_".join(word.lower() for word in _WORD.findall(name))


def camel_case(name: str) -> str:
    """`uav_search` becomes `UavSearch`."""
    return "".join(word[0].upper() + word[1:] for word in _WORD.findall(name))


def is_python_name(name: str) -> bool:
    """Return True for a Python identifier that is no keyword."""
    return name.isidentifier() and not keyword.iskeyword(name)


def is_ros_package_name(name: str) -> bool:
    """Return True for a package name by REP 144: lower case, digits and `_`, first a letter."""
    return re.fullmatch(r"[a-z][a-z0-9_]*", name) is not None and not name.endswith("_")


def fresh(name: str, *taken: Iterable[str], gap: str = "_") -> str:
    """Append a number to a name if it is taken: `name_2`, or `name2` without a gap."""
    known = [each if isinstance(each, (Set, Mapping)) else set(each) for each in taken]
    number, made = 1, name
    while any(made in each for each in known):
        number += 1
        made = f"{name}{gap}{number}"
    return made


class FreshNames:
    """Names that are taken one by one; one that is taken gets a number, as by `fresh`."""

    def __init__(self, taken: Iterable[str] = ()) -> None:
        self._taken = set(taken)
        self._numbers: dict[str, int] = {}

    def new(self, name: str) -> str:
        """Take a name."""
        number = self._numbers.get(name, 1)
        made = name if number == 1 else f"{name}_{number}"
        while made in self._taken:
            number += 1
            made = f"{name}_{number}"
        self._numbers[name] = number
        self._taken.add(made)
        return made
