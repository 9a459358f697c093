"""What connectors mean for the nodes of a member: the topics that its ports are on.

A component names a port's topic as its node does. Where a connector puts the port on another
one, the node is started with a remapping.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from swarmdsl.analysis.port_nets import Net, Pin, PortTopic, nets
from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.naming import snake_case
from swarmdsl.base.records import dataclass
from swarmdsl.ir import Connector, Member, Port, PortRef, System

Remaps = tuple[tuple[str, str], ...]
"""Topics as a node names them, each with the topic that it is to be."""


@dataclass(frozen=True)
class Wiring:
    """The topics of the ports of a member's parts, and of its own."""

    member: Member
    ports: Mapping[Pin, Port]
    nets: tuple[Net, ...]

    def topic(self, part: str | None, port: Port) -> str:
        """The topic that a port is on."""
        for net in self.nets:
            if (part, port.name) in net.pins:
                return net.topic
        return port.topic

    def remaps(self, part: str) -> Remaps:
        """How the topics of a part's node are to be called, where that is not how it calls them."""
        made = {
            port.topic: self.topic(part, port)
            for (owner, _), port in self.ports.items()
            if owner == part
        }
        return tuple((name, topic) for name, topic in made.items() if name != topic)


def member_wiring(member: Member, system: System) -> Wiring:
    """The wiring of a member."""
    components = {component.name: component for component in system.components}
    ports: dict[Pin, Port] = {(None, port.name): port for port in member.ports}
    for part in member.parts:
        for port in components[part.component].ports:
            ports[part.name, port.name] = port
    topics = {
        pin: PortTopic(
            port.topic,
            pin[0] is None or port.topic != snake_case(port.name),
            port.direction != "in",
        )
        for pin, port in ports.items()
    }
    joined = ((_pin(each.source), _pin(each.target)) for each in member.connectors)
    return Wiring(member, ports, tuple(nets(topics, joined)))


def check_wiring(wired: Wiring, target: str, report: Diagnostics) -> None:
    """Report connectors that remappings of topics cannot make."""
    for connector, construct, hint in _impossible(wired):
        report.report(
            "unsupported-construct", connector.origin, target=target, construct=construct, help=hint
        )


def _impossible(wired: Wiring) -> Iterator[tuple[Connector, str, str]]:
    tied: dict[tuple[str, str], tuple[str, Port]] = {}
    for (part, _), port in wired.ports.items():
        if part is None:
            continue
        topic = wired.topic(part, port)
        other_topic, other = tied.setdefault((part, port.topic), (topic, port))
        if other_topic != topic:
            connector = _at(wired, (part, port.name)) or _at(wired, (part, other.name))
            assert connector is not None
            construct = (
                f"a connector that parts `{part}.{other.name}` from `{part}.{port.name}`, "
                f"which are on one topic, `{port.topic}`"
            )
            yield connector, construct, "give the ports topics of their own"
    for net in wired.nets:
        shown = [wired.ports[pin] for pin in net.pins if pin[0] is None]
        own = {port.topic: port for port in reversed(shown)}
        if len(own) > 1:
            *_, second, first = own.values()
            connector = _at(wired, (None, second.name))
            assert connector is not None
            construct = (
                f"a connection of the member's ports `{first.name}` and `{second.name}`, "
                f"which are on the topics `{first.topic}` and `{second.topic}`"
            )
            yield connector, construct, "give them one topic, or a component between them"


def _at(wired: Wiring, pin: Pin) -> Connector | None:
    """The first connector at a port."""
    for connector in wired.member.connectors:
        if pin in (_pin(connector.source), _pin(connector.target)):
            return connector
    return None


def _pin(end: PortRef) -> Pin:
    return end.part, end.port
