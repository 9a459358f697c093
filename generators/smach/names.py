"""Names that are invalid in Python, SMACH or ROS."""

from __future__ import annotations

from collections.abc import Iterable

from swarmdsl.codegen import Diagnostics, FreshNames, is_python_name, snake_case, stays_inside
from swarmdsl.codegen.ros import PackageNames
from swarmdsl.ir import Action, Environment, Event, Param, StateMachine, Variable

from .module import TARGET

# Methods of smach.UserData cannot be read as values.
_USERDATA = ("extract", "keys", "merge", "update")
# ROS parameters that every node has.
_OF_NODES = ("introspection", "timeouts")
_MODULES = (
    *("actions", "callbacks", "chart", "containers", "engine", "events", "identity", "node"),
    *("services", "states", "topics"),
)
# A package with such a name would hide a module that the nodes import.
_IMPORTED = (
    *("collections", "copy", "dataclasses", "enum", "heapq", "itertools", "math", "sys"),
    *("threading", "traceback", "typing"),
    *("actionlib", "actionlib_msgs", "genpy", "rospy", "smach", "smach_ros"),
)
_MADE_OF: dict[type, tuple[str, ...]] = {
    Action: (
        *("Action", "Goal", "Result", "Feedback"),
        *("ActionGoal", "ActionResult", "ActionFeedback"),
    )
}

NAMES = PackageNames(TARGET, 1, _MODULES, _IMPORTED, _MADE_OF)


def check_machine(machine: StateMachine, report: Diagnostics) -> None:
    """Check the names that become userdata keys, labels, outcomes and functions."""
    keys: list[Param | Variable] = [*machine.params, *machine.variables]
    for named in keys:
        if not is_python_name(named.name) or not _is_key(named.name):
            NAMES.bad(report, named.name, "a key of userdata", named.origin)
    for param in machine.params:
        if param.name in _OF_NODES:
            NAMES.bad(
                report,
                param.name,
                "a ROS parameter: every node already has one with this name",
                param.origin,
            )
    NAMES.check_callbacks(machine, report)


def check_world(environment: Environment, file: str, report: Diagnostics) -> None:
    """Check the name of a file that launch files name, in which `$(` begins a substitution."""
    if not file.isprintable() or not stays_inside(file) or "$(" in file:
        hint = "use letters, digits, `_`, `-` and `.`"
        NAMES.bad(report, file, "the name of a world file", environment.origin, help=hint)


def check_keys(machine: StateMachine, report: Diagnostics) -> None:
    """Check names of params and variables that userdata rejects."""
    keys: list[Param | Variable] = [*machine.params, *machine.variables]
    for named in keys:
        if not _is_key(named.name):
            NAMES.bad(report, named.name, "a key of userdata", named.origin)


def _is_key(name: str) -> bool:
    return not name.startswith("_") and name not in _USERDATA


def event_constants(
    events: Iterable[Event], taken: Iterable[str], report: Diagnostics
) -> dict[str, str]:
    """Return the Python constant of each event."""
    names: dict[str, str] = {}
    constants = FreshNames(taken)
    for event in events:
        constant = snake_case(event.name).upper()
        if not is_python_name(constant):
            NAMES.bad(report, event.name, "the name of a constant", event.origin)
        names[event.name] = constants.new(constant)
    return names
