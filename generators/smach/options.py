"""What a person can choose about the generated package."""

from __future__ import annotations

import re
from dataclasses import dataclass

from swarmdsl.diagnostics import Diagnostics
from swarmdsl.generator import option

from .module import TARGET

# What catkin demands of them.
_VERSION = re.compile(r"[0-9]+\.[0-9]+\.[0-9]+")
_EMAIL = re.compile(r"[a-zA-Z0-9._%+-]+@[a-zA-Z0-9._%+-]+\.[a-zA-Z]{2,6}")


@dataclass(frozen=True)
class Options:
    """The options of the target."""

    package: str = option("", "name of the package; made from the model's name when empty")
    version: str = option("0.1.0", "version of the package")
    license: str = option("Apache-2.0", "license of the package")
    maintainer: str = option("Maintainer", "name of the package's maintainer")
    email: str = option("maintainer@example.org", "e-mail address of the maintainer")


def check_options(options: Options, report: Diagnostics) -> None:
    """Report what package.xml cannot hold; the name of the package is checked with names."""
    faults = []
    if not _VERSION.fullmatch(options.version):
        faults.append(f"`{options.version}` is no version: three numbers, as in `1.2.0`")
    if not _EMAIL.fullmatch(options.email):
        faults.append(f"`{options.email}` is no e-mail address")
    for name in ("maintainer", "license"):
        value = getattr(options, name)
        if not value.strip() or not value.isprintable():
            faults.append(f"option `{name}` needs a text on one line")
    for fault in faults:
        report.report("bad-option", target=TARGET, fault=fault)
