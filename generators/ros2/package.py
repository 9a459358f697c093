"""The package around the machines: which those are, what they use, its manifest."""

from __future__ import annotations

from collections.abc import Iterable

from lxml import etree

from swarmdsl.ir import Array, EventTrigger, Named, Send, StateMachine, System

from .options import Options


def chosen_machines(system: System) -> list[StateMachine]:
    """The machines that get a node: the behaviours there are, or all when there is none."""
    used = {member.behavior for member in system.members}
    used |= {component.behavior for component in system.components}
    used.discard(None)
    return [machine for machine in system.machines if not used or machine.name in used]


def heard_events(machine: StateMachine) -> list[str]:
    """The names of the events that a machine waits for."""
    found: dict[str, None] = {}
    for state in machine.walk():
        for transition in state.transitions:
            for trigger in transition.triggers:
                if isinstance(trigger, EventTrigger):
                    found.setdefault(trigger.event)
    return list(found)


def sent_events(machine: StateMachine) -> list[str]:
    """The names of the events that a machine sends."""
    found: dict[str, None] = {}
    for state in machine.walk():
        effects = (effect for transition in state.transitions for effect in transition.effects)
        for effect in (*state.entry, *effects, *state.exit):
            if isinstance(effect, Send):
                found.setdefault(effect.event)
    return list(found)


def called_functions(machine: StateMachine) -> list[str]:
    """The names of the functions that a machine calls."""
    called = (state.activity for state in machine.walk())
    return list(dict.fromkeys(each.function for each in called if each is not None))


def dependencies(system: System, machines: Iterable[StateMachine]) -> list[str]:
    """The packages that the nodes need."""
    found = {"action_msgs", "builtin_interfaces", "rcl_interfaces", "rclpy", "std_msgs"}
    for machine in machines:
        for variable in machine.variables:
            element = variable.type.element if isinstance(variable.type, Array) else variable.type
            if isinstance(element, Named):
                found.add(element.package)
        for name in called_functions(machine):
            found.add(system.function(name).communication.type.package)
        for name in (*heard_events(machine), *sent_events(machine)):
            type_ = system.event(name).type
            if isinstance(type_, Named):
                found.add(type_.package)
    return sorted(found)


def manifest(
    name: str,
    doc: str,
    depends: Iterable[tuple[str, str]],
    build_type: str,
    options: Options,
    groups: Iterable[str] = (),
) -> str:
    """The text of package.xml, format 3 (REP 149); each dependency with its tag."""
    root = etree.Element("package", format="3")
    _child(root, "name", name)
    _child(root, "version", options.version)
    _child(root, "description", " ".join(doc.split()))
    _child(root, "maintainer", options.maintainer, email=options.email)
    _child(root, "license", options.license)
    for tag, package in depends:
        _child(root, tag, package)
    for group in groups:
        _child(root, "member_of_group", group)
    _child(etree.SubElement(root, "export"), "build_type", build_type)
    text = etree.tostring(root, pretty_print=True, encoding="unicode")
    return f'<?xml version="1.0"?>\n{text}'


def _child(parent: etree._Element, tag: str, text: str, **attributes: str) -> None:
    child = etree.SubElement(parent, tag, attributes)
    child.text = text
