"""The package around the machines: what it depends on, its events and its manifest."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from lxml import etree

from swarmdsl.ir import (
    Action,
    Array,
    EventTrigger,
    Interface,
    Named,
    Send,
    StateMachine,
    System,
    Type,
)

from .imports import RosTypes
from .interfaces import field_packages
from .options import Options

_BASE = ("rospy", "smach", "smach_ros")


@dataclass(frozen=True)
class Dependencies:
    """What package.xml and CMakeLists.txt say of other packages.

    `fields` are those whose messages are in the interfaces of this package, `run` all that
    the nodes need.
    """

    run: tuple[str, ...]
    fields: tuple[str, ...]
    generates: bool


def chosen_machines(system: System) -> list[StateMachine]:
    """The machines that get a node: those that members use, all when no member uses any."""
    used = {member.behavior for member in system.members if member.behavior is not None}
    return [machine for machine in system.machines if not used or machine.name in used]


def used_events(machines: Iterable[StateMachine]) -> list[str]:
    """The names of the events that the machines wait for or send, each once."""
    found: dict[str, None] = {}
    for machine in machines:
        for state in machine.walk():
            for transition in state.transitions:
                for item in (*transition.triggers, *transition.effects):
                    if isinstance(item, (EventTrigger, Send)):
                        found.setdefault(item.event)
    return list(found)


def used_types(system: System, machines: Iterable[StateMachine]) -> list[tuple[Named, str]]:
    """The interfaces that the machines use, as `msg`, `srv` or `action`."""
    found: list[tuple[Named, str]] = []
    for machine in machines:
        for variable in machine.variables:
            found += ((type_, "msg") for type_ in _named(variable.type))
        for state in machine.walk():
            if state.activity is not None:
                call = system.function(state.activity.function).communication
                found.append((call.type, "srv" if call.paradigm == "service" else "action"))
    for name in used_events(machines):
        found += ((type_, "msg") for type_ in _named(system.event(name).type))
    return list(dict.fromkeys(found))


def _named(type_: Type) -> Iterator[Named]:
    if isinstance(type_, Array):
        yield from _named(type_.element)
    elif isinstance(type_, Named):
        yield type_


def dependencies(
    used: Sequence[tuple[Named, str]], own: Sequence[Interface], types: RosTypes
) -> Dependencies:
    """The packages whose types are used and defined."""
    packages = {types.ros_package(type_) for type_, _ in used} - {types.package}
    fields = set(field_packages(own, types))
    if any(isinstance(interface, Action) for interface in own):
        fields.add("actionlib_msgs")
    if any(kind == "action" for _, kind in used):
        packages |= {"actionlib", "actionlib_msgs"}
    run = tuple(sorted({*_BASE, *packages} - fields))
    return Dependencies(run, tuple(sorted(fields)), bool(own))


def manifest(package: str, doc: str, depends: Dependencies, options: Options) -> str:
    """The text of package.xml."""
    root = etree.Element("package", format="2")
    _child(root, "name", package)
    _child(root, "version", options.version)
    _child(root, "description", " ".join(doc.split()))
    _child(root, "maintainer", options.maintainer, email=options.email)
    _child(root, "license", options.license)
    _child(root, "buildtool_depend", "catkin")
    _child(root, "buildtool_depend", "python3-setuptools")
    if depends.generates:
        _child(root, "build_depend", "message_generation")
    for name in depends.fields:
        _child(root, "depend", name)
    for name in depends.run:
        _child(root, "exec_depend", name)
    if depends.generates:
        _child(root, "exec_depend", "message_runtime")
    text = etree.tostring(root, pretty_print=True, encoding="unicode")
    return f'<?xml version="1.0"?>\n{text}'


def _child(parent: etree._Element, tag: str, text: str, **attributes: str) -> None:
    child = etree.SubElement(parent, tag, attributes)
    child.text = text
