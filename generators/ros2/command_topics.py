"""Command topics of a robot that several of its nodes publish at once."""

from __future__ import annotations

from collections.abc import Container, Iterator

from swarmdsl.codegen import Diagnostics, Label, Span
from swarmdsl.codegen.shared import behavior_nodes, member_wiring
from swarmdsl.ir import Member, System

from .package import called_functions, sent_events
from .served import OFFBOARD, is_served

Publisher = tuple[str, str, Span | None]
"""Topic, node that publishes there, and the place that says so."""


def check_command_topics(member: Member, system: System, report: Diagnostics) -> None:
    """Report topics on which an actuator hears more than one node.

    Functions that a behaviour calls count as that behaviour, which calls them in turn, unless
    their node publishes between the calls, too.
    """
    components = system.components_by_name
    wired = member_wiring(member, system)
    heard = {
        wired.topic(ref): ref
        for ref, port in wired.ports.items()
        if ref.part is not None
        and port.direction != "out"
        and components[_component(member, ref.part)].kind == "actuator"
    }
    publishers: dict[str, dict[str, Span | None]] = {topic: {} for topic in heard}
    for topic, node, origin in _publishers(member, system):
        if topic in heard:
            publishers[topic].setdefault(node, origin)
    for topic, nodes in publishers.items():
        if len(nodes) < 2:
            continue
        (_, first), *_, (last, origin) = nodes.items()
        related = (Label(first, "another node publishes here"),) if first is not None else ()
        report.report(
            "several-publishers",
            origin,
            topic=topic,
            nodes=" and ".join(f"`{node}`" for node in nodes),
            related=related,
            notes=(f"`{heard[topic]}` of `{member.name}` does what it has heard last",),
            help=_way_out(last, nodes),
        )


def _way_out(last: str, nodes: Container[str]) -> str:
    if OFFBOARD in nodes:
        return "let the functions of offboard control do all, or machines that send commands"
    return (
        f"let one node decide: put a component between `{last}` and the actuator, with an"
        " input for each, such as `twist_mux`"
    )


def _component(member: Member, part: str) -> str:
    return next(each.component for each in member.parts if each.name == part)


def _publishers(member: Member, system: System) -> Iterator[Publisher]:
    for node in behavior_nodes(member, system):
        remaps = dict(node.remaps)
        for name in sent_events(node.machine):
            event = system.event(name)
            if not event.swarm:
                yield remaps.get(event.topic, event.topic), node.name, event.origin
        for name in called_functions(node.machine):
            function = system.function(name)
            server = OFFBOARD if is_served(function) else node.name
            for port in function.ports:
                if port.direction != "in":
                    yield remaps.get(port.topic, port.topic), server, port.origin
    wired = member_wiring(member, system)
    for ref, out in wired.ports.items():
        if ref.part is not None and out.direction != "in":
            yield wired.topic(ref), ref.part, out.origin
