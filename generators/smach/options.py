"""Options of the generated package."""

from __future__ import annotations

from swarmdsl.codegen import dataclass, option
from swarmdsl.codegen.ros import PackageOptions, copyright_fault, packages_fault

from ..ros2.network_options import domain_option, lease_option, network_option, peers_option
from .names import NAMES


def _package_fault(name: str) -> str | None:
    # Checked for ROS 1 and 2, because the check of an option does not see option `ros`. So a valid
    # name stays valid when a package moves to ROS 2.
    from ..ros2.names import NAMES as OF_ROS_2

    return NAMES.option_fault(name) or OF_ROS_2.option_fault(name)


def _seconds_fault(value: int) -> str | None:
    return None if value > 0 else f"`{value}` is not a valid timeout: use at least 1 (second)"


@dataclass(frozen=True)
class Options(PackageOptions):
    """The options of the target."""

    ros: int = option(1, "version of ROS that the nodes run on", choices=("1", "2"))
    package: str = option(
        "", "name of the package; from the name of the model when empty", check=_package_fault
    )
    interfaces: str = option(
        "",
        "third-party packages to write from the model, separated by commas",
        check=packages_fault,
    )
    simulation: bool = option(
        False,
        "write launch files for Gazebo, with the worlds of the environments",
        only="ros=1",
    )
    components: bool = option(
        False,
        "start components in launch files too, with the package that target skeleton "
        "writes; true if it is built as well",
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
        "seconds without status of a goal, or an answer of the node of a service, "
        "until the call counts as aborted",
        check=_seconds_fault,
        only="ros=1",
    )
    cancel: int = option(
        5, "seconds to wait for the end of a cancelled goal", check=_seconds_fault, only="ros=1"
    )

    copyright: str = option(
        "",
        "year and holder of the copyright, for the header of each file",
        check=copyright_fault,
        only="ros=2",
    )
    monitors: bool = option(
        False, "a node for each swarm that watches properties and tells measures", only="ros=2"
    )
    systemd: bool = option(
        False, "units for systemd: the robot of a computer, and monitors", only="ros=2"
    )
    compose: bool = option(
        False, "`compose.yaml` and a container file, with a service for each robot", only="ros=2"
    )
    lifecycle: bool = option(
        False, "managed nodes: configured and activated from outside", only="ros=2"
    )
    network: str = network_option(only="ros=2")
    peers: str = peers_option(only="ros=2")
    domain: int = domain_option()
    lease: int = lease_option()

    @property
    def timeouts(self) -> dict[str, int]:
        """Timeouts of nodes in seconds, by the names of their ROS parameters."""
        return {
            "missing_server": self.missing_server,
            "dead_server": self.dead_server,
            "cancel": self.cancel,
        }
