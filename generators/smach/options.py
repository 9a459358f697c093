"""What a person can choose about the generated package."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass

from swarmdsl.generator import option

from .names import package_fault

# What catkin demands of them.
_VERSION = re.compile(r"[0-9]+\.[0-9]+\.[0-9]+")
_EMAIL = re.compile(r"[a-zA-Z0-9._%+-]+@[a-zA-Z0-9._%+-]+\.[a-zA-Z]{2,6}")


def _package_fault(value: str) -> str | None:
    return package_fault(value) if value else None


def _version_fault(value: str) -> str | None:
    if _VERSION.fullmatch(value):
        return None
    return f"`{value}` is no version: three numbers, as in `1.2.0`"


def _email_fault(value: str) -> str | None:
    return None if _EMAIL.fullmatch(value) else f"`{value}` is no e-mail address"


def _line_fault(name: str) -> Callable[[str], str | None]:
    fault = f"option `{name}` needs a text on one line"
    return lambda value: None if value.strip() and value.isprintable() else fault


def _seconds_fault(value: int) -> str | None:
    return None if value > 0 else f"`{value}` is no time to wait: at least 1 (second)"


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
    simulation: bool = option(
        False, "whether to write launch files for Gazebo, with the worlds of the environments"
    )
    missing_server: int = option(
        10, "seconds to wait for the server of an action or service", check=_seconds_fault
    )
    dead_server: int = option(
        5, "seconds without a sign of life until a goal counts as aborted", check=_seconds_fault
    )
    cancel: int = option(5, "seconds to wait for the end of a cancelled goal", check=_seconds_fault)

    @property
    def timeouts(self) -> dict[str, int]:
        """How long nodes wait, in seconds, by the names of their ROS parameters."""
        return {
            "missing_server": self.missing_server,
            "dead_server": self.dead_server,
            "cancel": self.cancel,
        }
