"""Names that are invalid in Python or ROS 2."""

from __future__ import annotations

import re

from swarmdsl.codegen import Diagnostics, Span, camel_case, is_python_name, snake_case
from swarmdsl.codegen.ros import PackageNames
from swarmdsl.ir import Action, Param, Service, StateMachine, Variable

TARGET = "ros2"
MODULES = (
    *("alarms", "callbacks", "container", "diagnostics", "engine", "functions", "host"),
    *("identity", "launched_nodes", "launching", "lease", "members", "model", "models", "node"),
    *("offboard_flight", "offboard_frames", "offboard_node", "offboard_vehicle", "parameters"),
    *(
        "property_monitors",
        "px4_offboard",
        "robot_lines",
        "robots",
        "swarm_measures",
        "swarm_monitor",
    ),
    *("swarm_verdicts", "swarm_watch", "topics", "tracing", "values", "watchdog"),
)
# A package with such a name would hide a module that the nodes import.
_IMPORTED = (
    *("array", "collections", "copy", "functools", "heapq", "importlib", "itertools", "json"),
    *("math", "operator", "re", "signal", "sys", "threading", "traceback", "typing"),
    *("action_msgs", "builtin_interfaces", "rcl_interfaces", "rclpy", "std_msgs"),
)
# Parameters that ROS or its host declares in every node.
_PARAMETERS = ("use_sim_time", "start_type_description_service", "member", "stay", "swarm")
_MADE_OF: dict[type, tuple[str, ...]] = {
    Action: ("_Goal", "_Result", "_Feedback", "_SendGoal", "_GetResult", "_FeedbackMessage"),
    Service: ("_Request", "_Response", "_Event"),
}
_INTERFACE = re.compile(r"[A-Z][A-Za-z0-9]*")
_FIELD = re.compile(r"[a-z](_?[a-z0-9])*")
_TOPIC = re.compile(r"(~/|/)?[A-Za-z_][A-Za-z0-9_]*(/[A-Za-z_][A-Za-z0-9_]*)*")

NAMES = PackageNames(TARGET, 2, MODULES, _IMPORTED, _MADE_OF)


def check_machine(machine: StateMachine, report: Diagnostics) -> None:
    """Check the names that become attributes, parameters and functions."""
    attributes: list[Param | Variable] = [*machine.params, *machine.variables]
    for named in attributes:
        if not is_python_name(named.name):
            NAMES.bad(report, named.name, "an attribute of Python", named.origin)
    for param in machine.params:
        if param.name in _PARAMETERS:
            NAMES.bad(
                report,
                param.name,
                "a parameter: every node already has one with this name",
                param.origin,
            )
    NAMES.check_callbacks(machine, report)


def type_name(name: str) -> str:
    """Return the valid ROS 2 name of a third-party interface with a name of ROS 1."""
    return name if _INTERFACE.fullmatch(name) else camel_case(name)


def field_name(name: str) -> str:
    """Return the name of a third-party field in ROS 2, which is in lower case."""
    return name if _FIELD.fullmatch(name) else snake_case(name)


def check_topic(name: str, at: Span | None, report: Diagnostics, *, of_swarm: bool = False) -> None:
    """Check the name of a topic, a service or an action."""
    if of_swarm and name.startswith("~"):
        hint = "remove `~`: topics of the swarm are outside nodes"
        NAMES.bad(report, name, "the name of a topic of the swarm", at, help=hint)
    elif not _TOPIC.fullmatch(name):
        hint = "join parts of letters, digits and `_` with `/`; none starts with a digit"
        NAMES.bad(report, name, "the name of a topic, service or action", at, help=hint)
