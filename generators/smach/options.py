"""What a person can choose about the generated package."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

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


def _checked(default: str, text: str, fault: Callable[[str], str | None]) -> Any:
    """An option; `fault` says what is wrong with a value, None for one that is right."""
    return field(default=default, metadata={**option(default, text).metadata, "fault": fault})


@dataclass(frozen=True)
class Options:
    """The options of the target."""

    package: str = _checked(
        "", "name of the package; made from the model's name when empty", _package_fault
    )
    version: str = _checked("0.1.0", "version of the package", _version_fault)
    license: str = _checked("Apache-2.0", "license of the package", _line_fault("license"))
    maintainer: str = _checked(
        "Maintainer", "name of the package's maintainer", _line_fault("maintainer")
    )
    email: str = _checked(
        "maintainer@example.org", "e-mail address of the maintainer", _email_fault
    )
