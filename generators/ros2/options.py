"""What a person can choose about the generated package."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass

from swarmdsl.generator import option

from .names import package_fault

# What catkin_pkg demands of them.
_VERSION = re.compile(r"[0-9]+\.[0-9]+\.[0-9]+")
_EMAIL = re.compile(r"[a-zA-Z0-9._%+-]+@[a-zA-Z0-9._%+-]+\.[a-zA-Z]{2,6}")
_COPYRIGHT = re.compile(r"[0-9]{4}(-[0-9]{4})? \S.*")


def _package_fault(value: str) -> str | None:
    return package_fault(value) if value else None


def _version_fault(value: str) -> str | None:
    if _VERSION.fullmatch(value):
        return None
    return f"`{value}` is no version: three numbers, as in `1.2.0`"


def _email_fault(value: str) -> str | None:
    return None if _EMAIL.fullmatch(value) else f"`{value}` is no e-mail address"


def _copyright_fault(value: str) -> str | None:
    if not value or (_COPYRIGHT.fullmatch(value) and value.isprintable()):
        return None
    return f"`{value}` is not a year and a name, as in `2026 Example Robotics`"


def _line_fault(name: str) -> Callable[[str], str | None]:
    fault = f"option `{name}` needs a text on one line"
    return lambda value: None if value.strip() and value.isprintable() else fault


@dataclass(frozen=True)
class Options:
    """The options of the target."""

    package: str = option(
        "", "name of the package; made from the model's name when empty", check=_package_fault
    )
    version: str = option("0.1.0", "version of the package", check=_version_fault)
    license: str = option("Apache-2.0", "license of the package", check=_line_fault("license"))
    maintainer: str = option(
        "Maintainer", "name of the package's maintainer", check=_line_fault("maintainer")
    )
    email: str = option(
        "maintainer@example.org", "e-mail address of the maintainer", check=_email_fault
    )
    copyright: str = option(
        "", "year and holder of the copyright, for the head of each file", check=_copyright_fault
    )
    lifecycle: bool = option(False, "managed nodes: configured and activated from outside")
