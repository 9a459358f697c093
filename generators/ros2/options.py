"""Options of the generated package."""

from __future__ import annotations

from swarmdsl.codegen import dataclass, option
from swarmdsl.codegen.ros import PackageOptions, copyright_fault, packages_fault

from .names import NAMES
from .network_options import domain_option, lease_option, network_option, peers_option


@dataclass(frozen=True)
class Options(PackageOptions):
    """The options of the target."""

    package: str = option(
        "", "name of the package; from the name of the model when empty", check=NAMES.option_fault
    )
    interfaces: str = option(
        "",
        "third-party packages to write from the model, separated by commas",
        check=packages_fault,
    )
    copyright: str = option(
        "", "year and holder of the copyright, for the header of each file", check=copyright_fault
    )
    monitors: bool = option(
        False, "a node for each swarm that watches properties and tells measures"
    )
    systemd: bool = option(False, "units for systemd: the robot of a computer, and monitors")
    compose: bool = option(
        False, "`compose.yaml` and a container file, with a service for each robot"
    )
    lifecycle: bool = option(False, "managed nodes: configured and activated from outside")
    network: str = network_option()
    peers: str = peers_option()
    domain: int = domain_option()
    lease: int = lease_option()


@dataclass(frozen=True)
class NodeOptions(Options):
    """The options of target `ros2`, whose nodes need no library that has one machine a process."""

    composed: bool = option(False, "launch the robots of a computer in one process")
