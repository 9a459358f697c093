"""What a person can choose about the generated package."""

from __future__ import annotations

from dataclasses import dataclass

from swarmdsl.generator import option
from swarmdsl.ros_package import PackageOptions, packages_fault

from .names import NAMES


def _seconds_fault(value: int) -> str | None:
    return None if value > 0 else f"`{value}` is no time to wait: at least 1 (second)"


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
    simulation: bool = option(
        False, "whether to write launch files for Gazebo, with the worlds of the environments"
    )
    components: bool = option(
        False,
        "whether launch files start the components, too, by the package that target skeleton "
        "writes; true where that is built with it",
        beside="skeleton.ros=1",
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
