"""Options that describe the network of a swarm, for each target that has nodes of ROS 2."""

from __future__ import annotations

import re
from typing import Any

from swarmdsl.codegen import option

# Domains above it use ports that Linux gives to other programs.
LAST_DOMAIN = 101
NETWORKS = ("none", "wifi", "domains", "zenoh")
_HOST = re.compile(r"[A-Za-z0-9]([A-Za-z0-9.-]*[A-Za-z0-9])?")


def _peers_fault(value: str) -> str | None:
    """Return the fault of a list of hosts."""
    for host in value.split(",") if value else ():
        if not _HOST.fullmatch(host.strip()):
            return f"`{host.strip()}` is no IPv4 address and no host name"
    return None


def _domain_fault(value: int) -> str | None:
    """Return the fault of a domain."""
    return None if 0 <= value < LAST_DOMAIN else f"a domain is from 0 to {LAST_DOMAIN - 1}"


def _lease_fault(value: int) -> str | None:
    """Return the fault of a lease."""
    # Robots announce themselves every 2 s.
    return None if value >= 5 else "a lease is at least 5 s"


def network_option(only: str = "") -> Any:
    """Return the option with the kind of network."""
    return option(
        "none",
        "settings for the radio between robots: DDS profiles, a domain for each robot, or Zenoh",
        choices=NETWORKS,
        only=only,
    )


def peers_option(only: str = "") -> Any:
    """Return the option with the addresses of robots."""
    return option(
        "",
        "addresses of the robots' computers, separated by commas; `uav-0` of `uav[0]` when empty",
        check=_peers_fault,
        only=only,
    )


def domain_option() -> Any:
    """Return the option with the domain of the swarm."""
    return option(
        10,
        "domain in which the swarm meets; the robots have the next ones",
        check=_domain_fault,
        only="network=domains",
    )


def lease_option() -> Any:
    """Return the option with the time for which robots out of reach are waited for."""
    return option(
        600,
        "seconds for which events wait for a robot that is out of reach",
        check=_lease_fault,
        only="network=wifi",
    )
