"""Manifest of ROS packages, and the options that all of them share."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
from typing import Literal

from swarmdsl.base.naming import is_ros_package_name
from swarmdsl.base.records import dataclass
from swarmdsl.base.xml_writer import Element, document
from swarmdsl.codegen.api import option

# Patterns that catkin_pkg requires.
_VERSION = r"[0-9]+\.[0-9]+\.[0-9]+"
_COPYRIGHT = r"[0-9]{4}(-[0-9]{4})? \S.*"
_EMAIL = r"[a-zA-Z0-9._%+-]+@[a-zA-Z0-9._%+-]+\.[a-zA-Z]{2,6}"


def _version_fault(value: str) -> str | None:
    if re.fullmatch(_VERSION, value):
        return None
    return f"`{value}` is not a version: expected three numbers, such as `1.2.0`"


def _email_fault(value: str) -> str | None:
    return None if re.fullmatch(_EMAIL, value) else f"`{value}` is not an e-mail address"


def package_fault(value: str) -> str | None:
    """Return the error in the name of a package, which may be empty, or None."""
    if not value or is_ros_package_name(value):
        return None
    return f"`{value}` is not a valid ROS package name"


def packages_fault(value: str) -> str | None:
    """Return the error in comma-separated package names, or None."""
    wrong = [name for name in value.split(",") if value and not is_ros_package_name(name)]
    return f"`{wrong[0]}` is not a valid ROS package name" if wrong else None


def copyright_fault(value: str) -> str | None:
    """Return the error in a copyright (year and holder, or empty), or None."""
    if not value or (re.fullmatch(_COPYRIGHT, value) and value.isprintable()):
        if re.search("coding[:=]", value):  # PEP 263: Python would take it for the encoding
            return f"`{value}` names an encoding for Python"
        return None
    return f"`{value}` is not a year and a name, such as `2026 Example Robotics`"


def _line_fault(name: str) -> Callable[[str], str | None]:
    fault = f"option `{name}` needs a text on one line"
    return lambda value: None if value.strip() and value.isprintable() else fault


@dataclass(frozen=True)
class PackageOptions:
    """Options of every target that writes ROS packages."""

    version: str = option("0.1.0", "version of the package", check=_version_fault)
    license: str = option("Apache-2.0", "license of the package", check=_line_fault("license"))
    maintainer: str = option(
        "Maintainer", "name of the package's maintainer", check=_line_fault("maintainer")
    )
    email: str = option(
        "maintainer@example.org", "e-mail address of the maintainer", check=_email_fault
    )


def manifest(
    name: str,
    doc: str,
    depends: Iterable[tuple[str, str]],
    options: PackageOptions,
    *,
    format_: Literal[2, 3],
    build_type: str = "",
    region: str = "",
) -> str:
    """Return package.xml, of format 2 (REP 140, ROS 1) or 3 (REP 149, ROS 2).

    `depends` are tags and their values, in order. `region`, if given, names the lines that belong
    to the user (`swarmdsl.output.user_regions`).
    """
    root = Element("package", {"format": str(format_)})
    if region:
        root.comment("Lines between the two marks below are yours.")
    root.add("name", text=name)
    root.add("version", text=options.version)
    root.add("description", text=" ".join(doc.split()))
    root.add("maintainer", {"email": options.email}, options.maintainer)
    root.add("license", text=options.license)
    for tag, package in depends:
        root.add(tag, text=package)
    if region:
        root.comment(f"swarmc:begin {region}")
        root.comment(f"swarmc:end {region}")
    if build_type:
        root.add("export").add("build_type", text=build_type)
    return document(root, '<?xml version="1.0"?>')
