"""What a person can choose about the generated package."""

from __future__ import annotations

from dataclasses import dataclass

from swarmdsl.generator import option


@dataclass(frozen=True)
class Options:
    """The options of the target."""

    package: str = option("", "name of the package; made from the model's name when empty")
    version: str = option("0.1.0", "version of the package")
    license: str = option("Apache-2.0", "license of the package")
    maintainer: str = option("Maintainer", "name of the package's maintainer")
    email: str = option("maintainer@example.org", "e-mail address of the maintainer")
