"""Files of the network of a swarm: profiles of DDS, bridges between domains, and Zenoh."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator

from swarmdsl.codegen import MappedText

from .networks import Network
from .options import Options

_DEPTH = 1000
"""Messages of an event that wait in a bridge."""
_OF_NODES = "For the nodes of state machines, which speak to other robots."
_OF_FUNCTIONS = "For the servers of functions, which speak to no other robot."
# Fast DDS renamed the element at version 3, and refuses the other one.
_HEARTBEATS = {"fastdds": "heartbeatPeriod", "fastdds3": "heartbeat_period"}

Fill = Callable[..., MappedText]


def network_files(
    network: Network, options: Options, header: str, fill: Fill
) -> Iterator[tuple[str, MappedText]]:
    """Yield the name and the text of each file for the network that the options ask for."""
    match options.network:
        case "wifi":
            yield from _profiles(network, options, header, fill)
        case "domains":
            for computer in network.computers:
                yield (
                    f"{computer.name}.domain_bridge.yaml",
                    fill(
                        "package/network/domain_bridge.yaml",
                        computer=computer,
                        domain=network.domain,
                        depth=_DEPTH,
                        header=header,
                    ),
                )
        case "zenoh":
            given = {"hosts": network.hosts, "header": header}
            yield "zenoh_router.json5", fill("package/network/zenoh_router.json5", **given)
            for computer in (*network.computers, network.ground):
                text = fill("package/network/zenoh_bridge.json5", computer=computer, **given)
                yield f"{computer.name}.zenoh_bridge.json5", text


def _profiles(
    network: Network, options: Options, header: str, fill: Fill
) -> Iterator[tuple[str, MappedText]]:
    # No comment of XML has two hyphens, but the name of a file may.
    header = re.sub("-(?=-)", "- ", header)
    nodes = {
        "profile": "nodes",
        "hosts": network.hosts,
        "lease": options.lease,
        "about": _OF_NODES,
    }
    functions = {"profile": "functions", "hosts": (), "lease": 20, "about": _OF_FUNCTIONS}
    for suffix, values in (("", nodes), ("_functions", functions)):
        for name, heartbeat in _HEARTBEATS.items():
            text = fill("package/network/fastdds.xml", heartbeat=heartbeat, header=header, **values)
            yield f"{name}{suffix}.xml", text
        text = fill("package/network/cyclonedds.xml", header=header, **values)
        yield f"cyclonedds{suffix}.xml", text
