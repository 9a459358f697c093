"""Names that Python, SMACH or ROS cannot take."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

from swarmdsl.diagnostics import Diagnostics, Label
from swarmdsl.ir import (
    Action,
    Constant,
    Event,
    Field,
    Interface,
    Message,
    Param,
    StateMachine,
    System,
    Variable,
)
from swarmdsl.naming import is_python_name, is_ros_package_name, snake_case
from swarmdsl.source import Span

from .interfaces import parts
from .module import TARGET, fresh

# What smach.UserData has as methods cannot be read as a value.
_USERDATA = ("extract", "keys", "merge", "update")
# The ROS parameters of every node.
_OF_NODES = ("introspection", "timeouts")
_MODULES = (
    *("actions", "callbacks", "chart", "containers", "engine", "events", "node", "services"),
    "states",
)
# A package of such a name would hide what the nodes import.
_IMPORTED = (
    *("collections", "copy", "dataclasses", "enum", "heapq", "itertools", "math", "sys"),
    *("threading", "traceback", "typing"),
    *("actionlib", "actionlib_msgs", "genpy", "rospy", "smach", "smach_ros"),
)
_PACKAGE_NAMES = "it is of lower-case letters, digits and `_`, and not that of a Python module"
# The messages that ROS makes of an action.
_OF_AN_ACTION = (
    *("Action", "Goal", "Result", "Feedback"),
    *("ActionGoal", "ActionResult", "ActionFeedback"),
)
_FIELD = re.compile(r"[A-Za-z][A-Za-z0-9_]*")
_INTERFACE = re.compile(r"[A-Z][A-Za-z0-9]*")


def package_name(system: System, option: str, report: Diagnostics) -> str:
    """The name of the package: that of the option, else made from the system's."""
    name = option or f"{snake_case(system.name)}_behavior"
    if not option and package_fault(name) is not None:
        hint = "give the package a name with the option `package`"
        _bad(report, name, "a ROS package name", system.origin, help=hint)
    return name


def package_fault(name: str) -> str | None:
    """Why a package cannot have this name; None if it can."""
    if is_ros_package_name(name) and name not in _IMPORTED:
        return None
    return f"`{name}` cannot be the name of the package: {_PACKAGE_NAMES}"


def module_names(machines: Iterable[StateMachine], report: Diagnostics) -> dict[str, str]:
    """The module of each machine, by the machine's name."""
    names: dict[str, str] = {}
    owners: dict[str, StateMachine] = {}
    for machine in machines:
        module = snake_case(machine.name)
        if not is_python_name(module) or module in _MODULES:
            _bad(report, module or machine.name, "a module name", machine.origin)
        elif module in owners:
            first = owners[module].origin
            related = (Label(first, "the first is here"),) if first else ()
            use = f"the module of two machines, `{owners[module].name}` and `{machine.name}`"
            _bad(report, module, use, machine.origin, related=related)
        owners.setdefault(module, machine)
        names[machine.name] = module
    return names


def check_machine(machine: StateMachine, report: Diagnostics) -> None:
    """Check the names that become userdata keys, labels, outcomes and functions."""
    keys: list[Param | Variable] = [*machine.params, *machine.variables]
    for named in keys:
        if not is_python_name(named.name) or named.name.startswith("_") or named.name in _USERDATA:
            _bad(report, named.name, "a key of userdata", named.origin)
    for param in machine.params:
        if param.name in _OF_NODES:
            _bad(
                report, param.name, "a ROS parameter: all nodes have one of that name", param.origin
            )
    for state in machine.walk():
        activity = state.activity
        if activity is None:
            continue
        for callback in (activity.goal_callback, activity.result_callback):
            if callback is not None and not is_python_name(callback):
                _bad(report, callback, "the name of a function", activity.origin)


def check_interface_package(
    name: str, interfaces: Sequence[Interface], behavior: str, report: Diagnostics
) -> None:
    """Check the name of a package of interfaces, and the names in it."""
    at = interfaces[0].origin
    if not is_ros_package_name(name) or name in _IMPORTED:
        _bad(report, name, "the name of a ROS package", at, help=_PACKAGE_NAMES)
    elif name == behavior:
        use = "the package of its interfaces: the package with the behaviour has that name"
        _bad(report, name, use, at, help="give that one another name with the option `package`")
    owners: dict[str, Interface] = {}
    for interface in interfaces:
        _check_interface(interface, report)
        made = [interface.type.name]
        if isinstance(interface, Action):
            made += (interface.type.name + part for part in _OF_AN_ACTION)
        for name in made:
            owner = owners.setdefault(name, interface)
            if owner is not interface:
                related = (Label(owner.origin, "the first is here"),) if owner.origin else ()
                _bad(report, name, "two messages of a package", interface.origin, related=related)


def check_other_interfaces(
    system: System, defined: Iterable[str], behavior: str, report: Diagnostics
) -> None:
    """What packages elsewhere define cannot be in one that is generated."""
    generated = {behavior, *defined}
    for interface in system.interfaces:
        if interface.external and interface.type.package in generated:
            use = "a package of others: a package of that name is generated"
            _bad(report, interface.type.package, use, interface.origin)


def _check_interface(interface: Interface, report: Diagnostics) -> None:
    if not _INTERFACE.fullmatch(interface.type.name):
        hint = "a ROS interface starts with a capital letter and has letters and digits only"
        use = "the name of an interface"
        _bad(report, interface.type.name, use, interface.origin, help=hint)
    constants = interface.constants if isinstance(interface, Message) else ()
    items: list[Constant | Field] = [*constants, *(f for part in parts(interface) for f in part)]
    for item in items:
        if not _FIELD.fullmatch(item.name):
            _bad(report, item.name, "the name of a field or constant", item.origin)


def event_constants(
    events: Iterable[Event], taken: Iterable[str], report: Diagnostics
) -> dict[str, str]:
    """The Python constant of each event."""
    names: dict[str, str] = {}
    used = set(taken)
    for event in events:
        constant = snake_case(event.name).upper()
        if not is_python_name(constant):
            _bad(report, event.name, "the name of a constant", event.origin)
        names[event.name] = constant = fresh(constant, used)
        used.add(constant)
    return names


def check_callback(
    name: str, signature: str, known: dict[str, str], at: Span | None, report: Diagnostics
) -> None:
    """One callback cannot be called in two ways."""
    if known.setdefault(name, signature) != signature:
        use = f"a callback with the arguments ({known[name]}) and with ({signature})"
        _bad(report, name, use, at)


def _bad(
    report: Diagnostics,
    name: str,
    use: str,
    at: Span | None,
    *,
    related: tuple[Label, ...] = (),
    help: str | None = None,  # noqa: A002 - as `Diagnostics.report` calls it
) -> None:
    report.report(
        "bad-identifier", at, target=TARGET, name=name, use=use, related=related, help=help
    )
