"""What a person can choose about the generated package."""

from __future__ import annotations

import re
from dataclasses import dataclass

from swarmdsl.generator import option
from swarmdsl.ros_package import PackageOptions, packages_fault

from .names import NAMES

_COPYRIGHT = re.compile(r"[0-9]{4}(-[0-9]{4})? \S.*")


def _copyright_fault(value: str) -> str | None:
    if not value or (_COPYRIGHT.fullmatch(value) and value.isprintable()):
        return None
    return f"`{value}` is not a year and a name, as in `2026 Example Robotics`"


@dataclass(frozen=True)
class Options(PackageOptions):
    """The options of the target."""

    package: str = option(
        "", "name of the package; made from the model's name when empty", check=NAMES.option_fault
    )
    interfaces: str = option(
        "",
        "packages of others to write too, with commas, from what the model says of them",
        check=packages_fault,
    )
    copyright: str = option(
        "", "year and holder of the copyright, for the head of each file", check=_copyright_fault
    )
    lifecycle: bool = option(False, "managed nodes: configured and activated from outside")
