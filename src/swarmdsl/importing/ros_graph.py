"""Import functions and events from the graph of a running ROS 2.

The graph is read by a Python that has rclpy, which need not be that of swarmdsl.
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from collections.abc import Iterable, Iterator

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.errors import UsageError
from swarmdsl.base.records import dataclass, field
from swarmdsl.importing.names import type_names, value_names
from swarmdsl.importing.ros import import_ros
from swarmdsl.ir import Communication, Event, Function, Interface, Named, System
from swarmdsl.project.rosidl.installed import installed_package
from swarmdsl.syntax.types import Array

PARTS = ("fields", "request", "response", "goal", "result", "feedback")
# Services and topics that ROS itself has in each node.
_OF_ROS = {"lifecycle_msgs", "rcl_interfaces", "type_description_interfaces"}
_KINDS = ("actions", "services", "topics", "every_topic")
_TIMEOUT = 60
_NO_RCLPY = 3
# Reads the graph until nothing new has been seen for a while.
_READ = """
import json, sys, time
try:
    import rclpy
    from rclpy.action import get_action_names_and_types
except ImportError:
    sys.exit(3)
rclpy.init()
node = rclpy.create_node('swarmc_import', enable_rosout=False, start_parameter_services=False)
found, since, quiet = None, time.monotonic(), float(sys.argv[1])
while time.monotonic() - since < quiet:
    there = node.get_topic_names_and_types()
    sent = [[name, types] for name, types in there if node.count_publishers(name)]
    every = [[name, [type_]] for name, types in there for type_ in types]
    now = [get_action_names_and_types(node), node.get_service_names_and_types(), sent, every]
    if now != found:
        found, since = now, time.monotonic()
    time.sleep(0.05)
own = node.get_fully_qualified_name() + '/'
kinds = ('actions', 'services', 'topics', 'every_topic')
print(json.dumps({
    kind: [[name, types[0]] for name, types in sorted(each) if not name.startswith(own)]
    for kind, each in zip(kinds, found)
}))
node.destroy_node()
rclpy.shutdown()
"""


@dataclass(frozen=True)
class Graph:
    """Actions, services and topics with publishers: each a name with its type.

    `every_topic` has topics without publishers, too, and each of the types of a topic.
    """

    actions: tuple[tuple[str, Named], ...] = field(default=())
    services: tuple[tuple[str, Named], ...] = field(default=())
    topics: tuple[tuple[str, Named], ...] = field(default=())
    every_topic: tuple[tuple[str, Named], ...] = field(default=())


def read_graph(quiet: float) -> Graph:
    """Read the graph until nothing new is found for `quiet` seconds; raise UsageError."""
    for python in _pythons():
        command = [python, "-c", _READ, str(quiet)]
        try:
            done = subprocess.run(command, capture_output=True, text=True, timeout=_TIMEOUT + quiet)
        except (OSError, subprocess.TimeoutExpired) as error:
            raise UsageError(f"{python} cannot read the graph of ROS 2: {error}") from None
        if done.returncode == _NO_RCLPY:
            continue
        if done.returncode != 0:
            said = done.stderr.strip().rpartition("\n")[2]
            raise UsageError(f"{python} cannot read the graph of ROS 2: {said}")
        data = json.loads(done.stdout)
        return Graph(*(tuple(_typed(data[kind])) for kind in _KINDS))
    raise UsageError(
        "no Python has rclpy: source the setup file of ROS 2 (`. /opt/ros/DISTRO/setup.sh`)"
    )


def _pythons() -> Iterable[str]:
    pythons = (shutil.which("python3"), sys.executable, shutil.which("python3", path=os.defpath))
    return dict.fromkeys(filter(None, pythons))


def _typed(found: Iterable[tuple[str, str]]) -> Iterator[tuple[str, Named]]:
    """Yield what is not of ROS itself, with its type."""
    for name, type_ in found:
        package, _, interface = type_.split("/")
        is_hidden = any(part.startswith("_") for part in name.split("/"))
        if not is_hidden and package not in _OF_ROS:
            yield name, Named(package, interface)


def import_graph(
    graph: Graph, namespace: str, name: str, report: Diagnostics
) -> tuple[System, int]:
    """Return a system with the functions and events in a namespace, and their number.

    Names there are relative to the namespace, as for a robot of a swarm.
    """
    around = f"/{namespace.strip('/')}/".replace("//", "/")
    functions: list[Function] = []
    events: list[Event] = []
    of_functions, of_events = value_names(), type_names()
    for paradigm, found in (("action", graph.actions), ("service", graph.services)):
        for full, type_ in found:
            if not full.startswith(around):
                continue
            server = full.removeprefix(around)
            # Checkers take the names of both paradigms for any strings.
            call = Communication(paradigm, server, type_)  # type: ignore[arg-type]
            functions.append(Function(of_functions.new(server), "abstraction", call, (), ()))
    for full, type_ in graph.topics:
        if full.startswith(around):
            topic = full.removeprefix(around)
            events.append(Event(of_events.new(topic), type_, topic, swarm=False))
    used = [each.communication.type for each in functions]
    used += [each.type for each in events if isinstance(each.type, Named)]
    interfaces = _interfaces(used, report)
    system = System(name, tuple(interfaces), events=tuple(events), functions=tuple(functions))
    return system, len(functions) + len(events)


def _interfaces(used: Iterable[Named], report: Diagnostics) -> list[Interface]:
    """Return the interfaces of installed packages that are used, with those in their fields."""
    known: dict[str, dict[Named, Interface]] = {}
    found: dict[Named, Interface] = {}
    waiting = list(used)
    while waiting:
        type_ = waiting.pop(0)
        if type_.package not in known:
            folder = installed_package(type_.package)
            system = import_ros([folder], "", {}, report)[0] if folder is not None else System("")
            known[type_.package] = {each.type: each for each in system.interfaces}
        interface = known[type_.package].get(type_)
        if interface is not None and type_ not in found:
            found[type_] = interface
            waiting += _inside(interface)
    return list(found.values())


def _inside(interface: Interface) -> Iterator[Named]:
    for part in PARTS:
        for each in getattr(interface, part, ()):
            element = each.type.element if isinstance(each.type, Array) else each.type
            if isinstance(element, Named):
                yield element
