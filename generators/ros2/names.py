"""Names that Python or ROS 2 cannot take."""

from __future__ import annotations

import re
from collections.abc import Iterable

from swarmdsl.diagnostics import Diagnostics, Label
from swarmdsl.interface_files import bad_names
from swarmdsl.interface_packages import InterfacePackage, check_order
from swarmdsl.ir import (
    Action,
    Interface,
    Param,
    Service,
    StateMachine,
    System,
    Variable,
)
from swarmdsl.naming import camel_case, is_python_name, is_ros_package_name, snake_case
from swarmdsl.source import Span

TARGET = "ros2"
MODULES = (
    *("alarms", "callbacks", "diagnostics", "engine", "functions", "host", "node", "parameters"),
    *("topics", "tracing", "values"),
)
# A package of such a name would hide what the nodes import.
_IMPORTED = (
    *("array", "collections", "copy", "heapq", "importlib", "itertools", "json", "math", "re"),
    *("signal", "sys", "threading", "traceback", "typing"),
    *("action_msgs", "builtin_interfaces", "rcl_interfaces", "rclpy", "std_msgs"),
)
# What ROS declares in every node.
_PARAMETERS = ("use_sim_time", "start_type_description_service")
_PACKAGE_NAMES = "it is of lower-case letters, digits and `_`, and not that of a Python module"
_OF_AN_ACTION = ("Goal", "Result", "Feedback", "SendGoal", "GetResult", "FeedbackMessage")
_OF_A_SERVICE = ("Request", "Response", "Event")
_INTERFACE = re.compile(r"[A-Z][A-Za-z0-9]*")
_FIELD = re.compile(r"[a-z](_?[a-z0-9])*")
_TOPIC = re.compile(r"(~/|/)?[A-Za-z_][A-Za-z0-9_]*(/[A-Za-z_][A-Za-z0-9_]*)*")


def package_name(system: System, option: str, report: Diagnostics) -> str:
    """The name of the package: that of the option, else made from the system's."""
    name = option or f"{snake_case(system.name)}_behavior"
    if not option and package_fault(name) is not None:
        hint = "give the package a name with the option `package`"
        bad(report, name, "a ROS package name", system.origin, help=hint)
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
        if not is_python_name(module) or module in MODULES:
            bad(report, module or machine.name, "a module name", machine.origin)
        elif module in owners:
            first = owners[module].origin
            related = (Label(first, "the first is here"),) if first else ()
            use = f"the module of two machines, `{owners[module].name}` and `{machine.name}`"
            bad(report, module, use, machine.origin, related=related)
        owners.setdefault(module, machine)
        names[machine.name] = module
    return names


def check_machine(machine: StateMachine, report: Diagnostics) -> None:
    """Check the names that become attributes, parameters and functions."""
    attributes: list[Param | Variable] = [*machine.params, *machine.variables]
    for named in attributes:
        if not is_python_name(named.name):
            bad(report, named.name, "an attribute of Python", named.origin)
    for param in machine.params:
        if param.name in _PARAMETERS:
            bad(report, param.name, "a parameter: every node has one called so", param.origin)
    for state in machine.walk():
        activity = state.activity
        if activity is None:
            continue
        for callback in (activity.goal_callback, activity.result_callback):
            if callback is not None and not is_python_name(callback):
                bad(report, callback, "the name of a function", activity.origin)


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
            bad(report, interface.type.package, use, interface.origin)
    check_order(packages, TARGET, report)


def _check_package(package: InterfacePackage, behavior: str, report: Diagnostics) -> None:
    name, at = package.name, package.interfaces[0].origin
    if not is_ros_package_name(name) or name in _IMPORTED:
        bad(report, name, "the name of a ROS package", at, help=_PACKAGE_NAMES)
    elif name == behavior:
        use = "the package of its interfaces: the package with the behaviour has that name"
        bad(report, name, use, at, help="give that one another name with the option `package`")
    owners: dict[str, Interface] = {}
    for interface in package.interfaces:
        for wrong, use, hint, place in bad_names(interface, 2):
            bad(report, wrong, use, place, help=hint)
        for made in _made_of(interface):
            owner = owners.setdefault(made, interface)
            if owner is not interface:
                related = (Label(owner.origin, "the first is here"),) if owner.origin else ()
                bad(report, made, "two types of a package", interface.origin, related=related)


def _made_of(interface: Interface) -> list[str]:
    """The names of the types that ROS makes of an interface."""
    name = interface.type.name
    suffixes: tuple[str, ...] = ()
    if isinstance(interface, Action):
        suffixes = _OF_AN_ACTION
    elif isinstance(interface, Service):
        suffixes = _OF_A_SERVICE
    return [name, *(f"{name}_{suffix}" for suffix in suffixes)]


def check_callback(
    name: str, signature: str, known: dict[str, str], at: Span | None, report: Diagnostics
) -> None:
    """One callback cannot be called in two ways."""
    if known.setdefault(name, signature) != signature:
        use = f"a callback with the arguments ({known[name]}) and with ({signature})"
        bad(report, name, use, at)


def bad(
    report: Diagnostics,
    name: str,
    use: str,
    at: Span | None,
    *,
    related: tuple[Label, ...] = (),
    help: str | None = None,  # noqa: A002 - as `Diagnostics.report` calls it
) -> None:
    """Report a name that the target cannot take."""
    report.report(
        "bad-identifier", at, target=TARGET, name=name, use=use, related=related, help=help
    )


def type_name(name: str) -> str:
    """The name of an interface of others in ROS 2, which does not take all that ROS 1 does."""
    return name if _INTERFACE.fullmatch(name) else camel_case(name)


def field_name(name: str) -> str:
    """The name of a field of others in ROS 2: in lower case."""
    return name if _FIELD.fullmatch(name) else snake_case(name)


def fresh(name: str, used: Iterable[str]) -> str:
    """The name, with a number behind it where it is used already."""
    taken = set(used)
    made, number = name, 2
    while made in taken:
        made, number = f"{name}_{number}", number + 1
    return made


def check_topic(name: str, at: Span | None, report: Diagnostics, *, of_swarm: bool = False) -> None:
    """Check the name of a topic, a service or an action."""
    if of_swarm and name.startswith("~"):
        hint = "a topic of the swarm is in no node"
        bad(report, name, "the name of a topic of the swarm", at, help=hint)
    elif not _TOPIC.fullmatch(name):
        hint = "ROS 2 wants letters, digits and `_`, not first a digit, divided by single `/`"
        bad(report, name, "the name of a topic, service or action", at, help=hint)
