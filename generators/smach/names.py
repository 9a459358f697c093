"""Names that Python, SMACH or ROS cannot take."""

from __future__ import annotations

from collections.abc import Iterable

from swarmdsl.diagnostics import Diagnostics, Label
from swarmdsl.interface_files import bad_names
from swarmdsl.interface_packages import InterfacePackage, check_order
from swarmdsl.ir import (
    Action,
    Event,
    Interface,
    Param,
    StateMachine,
    System,
    Variable,
)
from swarmdsl.naming import is_python_name, is_ros_package_name, snake_case
from swarmdsl.source import Span

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


def check_interfaces(
    system: System, packages: Iterable[InterfacePackage], behavior: str, report: Diagnostics
) -> None:
    """Check the packages of interfaces beside the package `behavior`, and the names in them."""
    for package in packages:
        _check_package(package, behavior, report)
    # What packages elsewhere define cannot be in one that is generated.
    generated = {behavior, *(package.name for package in packages)}
    for interface in system.interfaces:
        if interface.external and interface.type.package in generated:
            use = "a package of others: a package of that name is generated"
            _bad(report, interface.type.package, use, interface.origin)
    check_order(packages, TARGET, report)


def _check_package(package: InterfacePackage, behavior: str, report: Diagnostics) -> None:
    name, at = package.name, package.interfaces[0].origin
    if not is_ros_package_name(name) or name in _IMPORTED:
        _bad(report, name, "the name of a ROS package", at, help=_PACKAGE_NAMES)
    elif name == behavior:
        use = "the package of its interfaces: the package with the behaviour has that name"
        _bad(report, name, use, at, help="give that one another name with the option `package`")
    owners: dict[str, Interface] = {}
    for interface in package.interfaces:
        for wrong, use, hint, place in bad_names(interface, 1):
            _bad(report, wrong, use, place, help=hint)
        for made in _made_of(interface):
            owner = owners.setdefault(made, interface)
            if owner is not interface:
                related = (Label(owner.origin, "the first is here"),) if owner.origin else ()
                _bad(report, made, "two messages of a package", interface.origin, related=related)


def _made_of(interface: Interface) -> list[str]:
    """The names of the messages that ROS makes of an interface."""
    name = interface.type.name
    suffixes = _OF_AN_ACTION if isinstance(interface, Action) else ()
    return [name, *(f"{name}{suffix}" for suffix in suffixes)]


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
