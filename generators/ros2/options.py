"""Options of the generated package."""

from __future__ import annotations

from swarmdsl.codegen import dataclass, option
from swarmdsl.codegen.ros import PackageOptions, copyright_fault, packages_fault

from .names import NAMES
from .network_faults import NETWORKS, domain_fault, lease_fault, peers_fault


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
    systemd: bool = option(False, "a unit for systemd that starts the robot of a computer")
    compose: bool = option(
        False, "`compose.yaml` and a container file, with a service for each robot"
    )
    lifecycle: bool = option(False, "managed nodes: configured and activated from outside")
    network: str = option(
        "none",
        "settings for the radio between robots: DDS profiles, a domain for each robot, or Zenoh",
        choices=NETWORKS,
    )
    peers: str = option(
        "",
        "addresses of the robots' computers, separated by commas; `uav-0` of `uav[0]` when empty",
        check=peers_fault,
    )
    domain: int = option(
        10,
        "domain in which the swarm meets; the robots have the next ones",
        check=domain_fault,
        only="network=domains",
    )
    lease: int = option(
        600,
        "seconds for which events wait for a robot that is out of reach",
        check=lease_fault,
        only="network=wifi",
    )
