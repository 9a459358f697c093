"""What a person can choose about the generated packages."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass

from swarmdsl.generator import option

# What catkin and ament demand of them.
_VERSION = re.compile(r"[0-9]+\.[0-9]+\.[0-9]+")
_EMAIL = re.compile(r"[a-zA-Z0-9._%+-]+@[a-zA-Z0-9._%+-]+\.[a-zA-Z]{2,6}")


def _version_fault(value: str) -> str | None:
    if _VERSION.fullmatch(value):
        return None
    return f"`{value}` is no version: three numbers, as in `1.2.0`"


def _email_fault(value: str) -> str | None:
    return None if _EMAIL.fullmatch(value) else f"`{value}` is no e-mail address"


def _line_fault(name: str) -> Callable[[str], str | None]:
    fault = f"option `{name}` needs a text on one line"
    return lambda value: None if value.strip() and value.isprintable() else fault


@dataclass(frozen=True)
class Options:
    """The options of the target."""

    language: str = option("python", "language of the nodes", choices=("python", "cpp"))
    ros: int = option(1, "generation of ROS that the nodes run on", choices=("1", "2"))
    only: str = option(
        "", "names of the functions and components to write, with commas; all when empty"
    )
    interfaces: bool = option(
        True, "write the packages of the model's interfaces; false where another target does"
    )
    version: str = option("0.1.0", "version of the packages", check=_version_fault)
    license: str = option("Apache-2.0", "license of the packages", check=_line_fault("license"))
    maintainer: str = option(
        "Maintainer", "name of the packages' maintainer", check=_line_fault("maintainer")
    )
    email: str = option(
        "maintainer@example.org", "e-mail address of the maintainer", check=_email_fault
    )
