"""What a person can choose about the generated package."""

from __future__ import annotations

from swarmdsl.codegen import dataclass, option
from swarmdsl.codegen.ros import PackageOptions, copyright_fault, packages_fault

from .names import NAMES


def _package_fault(name: str) -> str | None:
    # For both, whatever `ros` is: a check of an option sees no other one, and only what it finds is
    # shown where the option stands. A name that passes stays when a package moves to ROS 2.
    from ..ros2.names import NAMES as OF_ROS_2

    return NAMES.option_fault(name) or OF_ROS_2.option_fault(name)


def _seconds_fault(value: int) -> str | None:
    return None if value > 0 else f"`{value}` is no time to wait: at least 1 (second)"


@dataclass(frozen=True)
class Options(PackageOptions):
    """The options of the target."""

    ros: int = option(1, "generation of ROS that the nodes run on", choices=("1", "2"))
    package: str = option(
        "", "name of the package; made from the model's name when empty", check=_package_fault
    )
    interfaces: str = option(
        "",
        "packages of others to write too, with commas, from what the model says of them",
        check=packages_fault,
    )
    simulation: bool = option(
        False,
        "whether to write launch files for Gazebo, with the worlds of the environments",
        only="ros=1",
    )
    components: bool = option(
        False,
        "whether launch files start the components, too, by the package that target skeleton "
        "writes; true where that is built with it",
        beside="skeleton.ros=1",
        only="ros=1",
    )
    missing_server: int = option(
        10,
        "seconds to wait for the server of an action or service",
        check=_seconds_fault,
        only="ros=1",
    )
    dead_server: int = option(
        5,
        "seconds without a sign of life until a goal counts as aborted",
        check=_seconds_fault,
        only="ros=1",
    )
    cancel: int = option(
        5, "seconds to wait for the end of a cancelled goal", check=_seconds_fault, only="ros=1"
    )

    copyright: str = option(
        "",
        "year and holder of the copyright, for the head of each file",
        check=copyright_fault,
        only="ros=2",
    )
    lifecycle: bool = option(
        False, "managed nodes: configured and activated from outside", only="ros=2"
    )

    @property
    def timeouts(self) -> dict[str, int]:
        """How long nodes wait, in seconds, by the names of their ROS parameters."""
        return {
            "missing_server": self.missing_server,
            "dead_server": self.dead_server,
            "cancel": self.cancel,
        }
