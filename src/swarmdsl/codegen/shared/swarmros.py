"""Configuration of swarmros, the bridge of CPSwarm's library, for each member.

The bridge forwards what is published on the topics of its `outgoingEvents` to the swarm, and
publishes what arrives, its `incomingEvents`, on `bridge/events/<suffix>`. Its files are
libconfig (https://hyperrealm.github.io/libconfig/), its keys those that its `main.cpp` reads.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.naming import incoming_topic, snake_case
from swarmdsl.codegen.api import OutputFile
from swarmdsl.codegen.shared.constants import Value, constant
from swarmdsl.codegen.shared.envelopes import BRIDGE_HEADER, envelopes_of
from swarmdsl.codegen.shared.topic_uses import Use, uses
from swarmdsl.ir import CommunicationSettings, Event, Member, Message, System

_TECHNOLOGY = "zyre"
_PARAMETERS = ("ifname", "port")
_SPECIAL = re.compile(r'["\\\x00-\x1f\x7f]')

Group = dict[str, Value]


def bridge_files(system: System, report: Diagnostics) -> Iterator[OutputFile]:
    """Return one file for each member that sends or receives over the bridge."""
    around = envelopes_of(system)
    wires = {system.event(name).topic: str(message.type) for name, message in around.items()}
    used = {member.name: list(uses(member, system)) for member in system.members}
    bridged = _bridged(system, [use for found in used.values() for use in found])
    crossed = {_suffix(use) for found in used.values() for use in found}
    _report_deliveries((each for each in system.events if each.topic in crossed), report)
    for member in system.members:
        crossing = [use for use in used[member.name] if _suffix(use) in bridged]
        crossing = [use for use in crossing if _can_cross(use, system, report)]
        if crossing or member.communication is not None:
            text = "\n".join(_file(member, crossing, wires, report)) + "\n"
            yield OutputFile(f"{snake_case(member.name)}.cfg", text, origin=member.origin)


def _report_deliveries(events: Iterable[Event], report: Diagnostics) -> None:
    """Report the events whose delivery the configuration has no words for."""
    for event in events:
        if event.delivery is not None:
            report.report(
                "no-place",
                event.delivery.origin,
                target="swarmros",
                what=f"the delivery of event `{event.name}`",
                notes=("the bridge sends each event once, to the robots that it is connected to",),
            )


def _bridged(system: System, used: Iterable[Use]) -> set[str]:
    """Return the topics of swarm events, and those with subscribers after the bridge."""
    declared = {event.topic for event in system.events if event.swarm}
    return declared | {_suffix(use) for use in used if use.heard and _suffix(use) != use.topic}


def _suffix(use: Use) -> str:
    """Return the topic at the sender, without the prefix of incoming events."""
    if not use.heard:
        return use.topic
    return use.topic.removeprefix(incoming_topic("", swarm=True))


def _can_cross(use: Use, system: System, report: Diagnostics) -> bool:
    """Return True if the bridge takes the message; report it otherwise."""
    if use.heard and _suffix(use) == use.topic:
        return False  # a topic of the robot itself
    message = system.interface(use.type)
    if not isinstance(message, Message) or any(f.type == BRIDGE_HEADER for f in message.fields):
        return True
    report.report(
        "no-place",
        use.origin,
        target="swarmros",
        what=f"topic `{_suffix(use)}`",
        notes=(f"`{use.type}` has no field of type `{BRIDGE_HEADER}`, which the bridge reads",),
        help=f"give its message a field `swarmio : {BRIDGE_HEADER}`",
    )
    return False


def _file(
    member: Member, crossing: list[Use], wires: Mapping[str, str], report: Diagnostics
) -> Iterator[str]:
    """Yield the lines of a configuration; `wires` are the envelopes of topics that have one."""
    settings = _settings(member, report)
    parameters = {name: value for name, value in settings.items() if name in _PARAMETERS}
    yield from (f"# {line}".rstrip() for line in member.doc.splitlines())
    yield "endpoint = {"
    yield from _items(
        {
            "name": settings.get("name", member.name),
            "deviceClass": settings.get("device_class", member.name),
            "type": _TECHNOLOGY,
        },
        "    ",
    )
    yield "    parameters = {"
    yield from _items(parameters, "        ")
    yield "    }"
    yield "}"
    yield "services = {"
    yield from _list("telemetryTopics", [])
    sent = {use.topic: str(use.type) for use in crossing if not use.heard}
    heard = {_suffix(use): str(use.type) for use in crossing if use.heard}
    for types in (sent, heard):
        types.update((topic, wires[topic]) for topic in types.keys() & wires.keys())
    yield from _list(
        "outgoingEvents", [{"message": type_, "source": topic} for topic, type_ in sent.items()]
    )
    # The sender uses the topic as the event's name.
    yield from _list(
        "incomingEvents",
        [{"suffix": topic, "message": type_, "name": topic} for topic, type_ in heard.items()],
    )
    yield from _list("publishedParameters", [])
    yield from _list("bridgedParameters", [])
    yield "}"


def _settings(member: Member, report: Diagnostics) -> Group:
    communication: CommunicationSettings | None = member.communication
    if communication is None:
        return {}
    if communication.technology != _TECHNOLOGY:
        report.report(
            "no-place",
            communication.origin,
            target="swarmros",
            what=f"technology `{communication.technology}`",
            notes=(f"the bridge supports `{_TECHNOLOGY}` only, which is written",),
        )
    values = {name: constant(value, {}) for name, value in communication.values}
    return {name: value for name, value in values.items() if value is not None}


def _list(name: str, groups: list[Group]) -> Iterator[str]:
    yield f"    {name} = ("
    for number, group in enumerate(groups, 1):
        yield "        {"
        yield from _items(group, "            ")
        yield "        }" + ("," if number < len(groups) else "")
    yield "    )"


def _items(group: Group, indent: str) -> Iterator[str]:
    for name, value in group.items():
        yield f"{indent}{name} = {_text(value) if isinstance(value, str) else value}"


def _text(text: str) -> str:
    """Return a quoted string, with special characters by number."""
    return '"' + _SPECIAL.sub(lambda found: f"\\x{ord(found[0]):02x}", text) + '"'
