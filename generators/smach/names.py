"""Names that Python, SMACH or ROS cannot take."""

from __future__ import annotations

import re
from collections.abc import Iterable

from swarmdsl.diagnostics import Diagnostics, Label
from swarmdsl.ir import Param, StateMachine, System, Variable
from swarmdsl.naming import is_python_name, is_ros_package_name, snake_case
from swarmdsl.source import Span

from .module import PREEMPTED, TARGET

# What smach.UserData has as methods cannot be read as a value.
_USERDATA = ("extract", "keys", "merge", "update")
_MODULES = ("callbacks", "containers", "events", "states")
_INTERFACE = re.compile(r"[A-Z][A-Za-z0-9]*")


def package_name(system: System, option: str, report: Diagnostics) -> str:
    """The name of the package: that of the option, else made from the system's."""
    name = option or f"{snake_case(system.name)}_behavior"
    if not is_ros_package_name(name):
        if option:
            fault = f"`{option}` is no ROS package name: lower-case letters, digits and `_`"
            report.report("bad-option", target=TARGET, fault=fault)
        else:
            hint = "give the package a name with the option `package`"
            _bad(report, name, "a ROS package name", system.origin, help=hint)
    return name


def module_names(machines: Iterable[StateMachine], report: Diagnostics) -> dict[str, str]:
    """The module of each machine, by the machine's name."""
    names: dict[str, str] = {}
    owners: dict[str, StateMachine] = {}
    for machine in machines:
        module = snake_case(machine.name)
        if not is_python_name(module) or module in _MODULES:
            _bad(report, module, "a module name", machine.origin)
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
    for state in machine.walk():
        if state.name == PREEMPTED:
            _bad(report, state.name, "the name of a state", state.origin)
        activity = state.activity
        if activity is None:
            continue
        for callback in (activity.goal_callback, activity.result_callback):
            if callback is not None and not is_python_name(callback):
                _bad(report, callback, "the name of a function", activity.origin)


def check_interfaces(system: System, report: Diagnostics) -> None:
    """Check the names of the interfaces that the package defines."""
    owners: dict[str, Span | None] = {}
    for interface in system.interfaces:
        if interface.external:
            continue
        name = interface.type.name
        if not _INTERFACE.fullmatch(name):
            hint = "a ROS interface starts with a capital letter and has letters and digits only"
            _bad(report, name, "the name of an interface", interface.origin, help=hint)
        elif name in owners:
            first = owners[name]
            related = (Label(first, "the first is here"),) if first else ()
            _bad(report, name, "two interfaces of a package", interface.origin, related=related)
        owners.setdefault(name, interface.origin)


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
