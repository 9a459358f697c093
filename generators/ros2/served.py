"""Nodes with servers of functions: they are generated whole, and take nothing from a person.

The interface of a function says that it has such a node: no other package publishes its actions.
"""

from __future__ import annotations

import ast
from collections.abc import Iterable
from functools import cache
from pathlib import Path

from swarmdsl.codegen import Diagnostics, Label, Span, dataclass, snake_case
from swarmdsl.ir import Function, FunctionPort, Named, System

from .names import TARGET
from .readme import Rows

INTERFACES = "px4_offboard_msgs"
"""Package of these actions, which is written with each package that has the node."""
OFFBOARD = "px4_offboard"
MODULES = ("offboard_flight", "offboard_frames", "offboard_node", "offboard_vehicle")
_PX4 = "px4_msgs"
_ACTIONS = ("TakeOff", "GoTo", "Hold", "Land", "ReturnToLaunch")
_TOPICS = {
    "VehicleStatus": "fmu/out/vehicle_status_v1",
    "VehicleLocalPosition": "fmu/out/vehicle_local_position",
    "VehicleLandDetected": "fmu/out/vehicle_land_detected",
    "VehicleCommandAck": "fmu/out/vehicle_command_ack",
    "OffboardControlMode": "fmu/in/offboard_control_mode",
    "TrajectorySetpoint": "fmu/in/trajectory_setpoint",
    "VehicleCommand": "fmu/in/vehicle_command",
}
_RUNTIME = Path(__file__).parent / "runtime"


@dataclass(frozen=True)
class ServedNode:
    """A node with servers of functions, each with its goal, its action and its name."""

    executable: str
    servers: tuple[tuple[str, str, str], ...]
    topics: tuple[tuple[str, str], ...]
    tables: tuple[tuple[str, str, Rows], ...]
    origin: Span | None

    @property
    def actions(self) -> list[str]:
        """The actions of the servers."""
        return sorted({action for _, action, _ in self.servers})


def is_served(function: Function) -> bool:
    """Return True if a node that is generated whole has the server of a function."""
    type_ = function.communication.type
    return type_.package == INTERFACES and type_.name in _ACTIONS


def served_nodes(system: System, report: Diagnostics) -> tuple[ServedNode, ...]:
    """Return the nodes with servers of functions of a system."""
    functions = [each for each in system.functions if is_served(each)]
    if not functions:
        return ()
    calls = [each.communication for each in functions]
    servers = dict.fromkeys((snake_case(c.type.name), c.type.name, c.name) for c in calls)
    topics = _topics(functions, report)
    tables = (
        (
            "Servers",
            "name | type |",
            tuple(
                (name, f"{INTERFACES}/{action} (action)", goal) for goal, action, name in servers
            ),
        ),
        (
            "Topics of PX4",
            "topic | type |",
            tuple(
                (topic, f"{_PX4}/{name}", "hears" if "/out/" in topic else "sends")
                for name, topic in topics
            ),
        ),
        ("Parameters", "name | default |", _parameters()),
    )
    return (ServedNode(OFFBOARD, tuple(servers), topics, tables, functions[0].origin),)


def served_packages(system: System) -> list[str]:
    """Return the packages that such nodes of a system need besides those of the machines."""
    used = any(map(is_served, system.functions))
    return [_PX4, INTERFACES, "geometry_msgs"] if used else []


def _topics(functions: Iterable[Function], report: Diagnostics) -> tuple[tuple[str, str], ...]:
    """Return the topics by the names of their messages, as the functions say.

    Report functions that give one message different topics.
    """
    said: dict[str, FunctionPort] = {}
    ports = (port for function in functions for port in function.ports)
    for port in ports:
        if isinstance(port.type, Named) and port.type.package == _PX4:
            first = said.setdefault(port.type.name, port)
            if first.topic != port.topic:
                _report_topics(first, port, report)
    return tuple(
        (name, said[name].topic if name in said else topic) for name, topic in _TOPICS.items()
    )


def _report_topics(first: FunctionPort, other: FunctionPort, report: Diagnostics) -> None:
    topics = f"`{first.topic}` and `{other.topic}`"
    related = (Label(first.origin, "another topic here"),) if first.origin is not None else ()
    report.report(
        "unsupported-construct",
        other.origin,
        target=TARGET,
        construct=f"two topics of `{other.type}`, {topics}",
        related=related,
        notes=(f"one node, `{OFFBOARD}`, has the servers of all these functions",),
        help="give all functions the same topic",
    )


@cache
def _parameters() -> Rows:
    """Return the parameters of the node with their defaults and documentation."""
    tree = ast.parse((_RUNTIME / "offboard_node.py").read_text(encoding="utf-8"))
    calls = next(
        each.value
        for each in tree.body
        if isinstance(each, ast.Assign) and ast.unparse(each.targets[0]) == "PARAMETERS"
    )
    assert isinstance(calls, ast.Tuple)
    rows = []
    for call in calls.elts:
        assert isinstance(call, ast.Call)
        name, _, default, doc = map(ast.literal_eval, call.args)
        rows.append((name, str(default), doc))
    return tuple(rows)
