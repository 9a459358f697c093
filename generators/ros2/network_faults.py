"""Faults of options that describe the network of a swarm."""

from __future__ import annotations

import re

# Domains above it use ports that Linux gives to other programs.
LAST_DOMAIN = 101
NETWORKS = ("none", "wifi", "domains", "zenoh")
_HOST = re.compile(r"[A-Za-z0-9]([A-Za-z0-9.-]*[A-Za-z0-9])?")


def peers_fault(value: str) -> str | None:
    """Return the fault of a list of hosts."""
    for host in value.split(",") if value else ():
        if not _HOST.fullmatch(host.strip()):
            return f"`{host.strip()}` is no IPv4 address and no host name"
    return None


def domain_fault(value: int) -> str | None:
    """Return the fault of a domain."""
    return None if 0 <= value < LAST_DOMAIN else f"a domain is from 0 to {LAST_DOMAIN - 1}"


def lease_fault(value: int) -> str | None:
    """Return the fault of a lease."""
    # Robots announce themselves every 2 s.
    return None if value >= 5 else "a lease is at least 5 s"
