"""Standard interface types of ROS, available without an installed ROS.

They are in two files beside this module, each interface as in its own file, below a line with
its name. A test generates the messages from `rosbags` (`make bless`), which as a dependency
would bring numpy and more, some 90 MB. The few services and actions were written by hand.

Interfaces are the union of ROS 1 and ROS 2. Parts that one of them lacks are documented as
`only in ROS 1` or `only in ROS 2`.
"""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path
from typing import Literal

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.read_files import read_text
from swarmdsl.base.source import Source
from swarmdsl.project.rosidl.interface_file import INTERFACE_KINDS, Interface, Kind, parse_interface
from swarmdsl.syntax.ast import Documented
from swarmdsl.syntax.types import Named

FOLDER = Path(__file__).resolve().parent
FILES = ("standard_messages.txt", "standard_services.txt")
_OWN = {("swarmdsl", "msg", "Member"): "string id\nstring role\n"}
"""Messages of events that no model declares; robots raise them themselves."""
_HEADING = re.compile(r"^== (\w+)/(\w+)/(\w+)\n", re.MULTILINE)
_ONLY: dict[str, Literal[1, 2]] = {"only in ROS 1": 1, "only in ROS 2": 2}


def lookup(type_: Named, kind: Kind | None = None) -> Interface | None:
    """Return the interface with a name, None if ROS has none.

    A service and an action may share a name: `nav_msgs/GetMap`. Without `kind` a message
    comes first, then a service.
    """
    for wanted in INTERFACE_KINDS if kind is None else (kind,):
        found = _parsed(type_.package, wanted, type_.name)
        if found is not None:
            return found
    return None


def only_in(node: Documented) -> Literal[1, 2] | None:
    """Return the only version of ROS with an interface or field; None if both have it."""
    return _ONLY.get(node.doc)


def packages() -> list[str]:
    """Return the standard packages of ROS, sorted."""
    return sorted(_texts())


def names(package: str, kind: Kind | None = None) -> list[str]:
    """Return the names of the interfaces of a package, of one kind or all, sorted.

    An unknown package has none.
    """
    known = _texts().get(package, ())
    return sorted({name for of, name in known if kind is None or of == kind})


@cache
def _texts() -> dict[str, dict[tuple[str, str], str]]:
    """Source text of each interface, by package, then by kind and name."""
    texts: dict[str, dict[tuple[str, str], str]] = {}
    for file in FILES:
        _, *parts = _HEADING.split(read_text(FOLDER / file))
        for package, kind, name, text in zip(*(parts[i::4] for i in range(4)), strict=True):
            texts.setdefault(package, {})[kind, name] = text
    return texts


@cache
def _parsed(package: str, kind: Kind, name: str) -> Interface | None:
    text = _OWN.get((package, kind, name)) or _texts().get(package, {}).get((kind, name))
    if text is None:
        return None
    source = Source(f"{package}/{kind}/{name}.{kind}", text)
    return parse_interface(source, package, name, kind, Diagnostics()).declaration
