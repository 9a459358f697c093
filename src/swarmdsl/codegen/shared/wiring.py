"""Topics of the ports of a member, as its connectors put them.

A component names a port's topic as its node does. Where a connector puts the port on another
topic, the node is started with a remapping.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from functools import cached_property

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.records import dataclass
from swarmdsl.ir import Connector, Member, Port, PortRef, System

Remaps = tuple[tuple[str, str], ...]
"""Topics as a node names them, each with the topic that replaces it."""


@dataclass(frozen=True)
class Wiring:
    """The ports of a member and of its parts, with their topics."""

    member: Member
    ports: Mapping[PortRef, Port]

    def topic(self, port: PortRef) -> str:
        """Return the topic of a port."""
        return self._connected[port] if port in self._connected else self.ports[port].topic

    def remaps(self, part: str) -> Remaps:
        """Return the remappings of a part's node."""
        made = {self.ports[ref].topic: self.topic(ref) for ref in self._of_parts.get(part, ())}
        return tuple((name, topic) for name, topic in made.items() if name != topic)

    @cached_property
    def _connected(self) -> Mapping[PortRef, str]:
        """Topics of connected ports; of several groups with a port the first counts."""
        groups = reversed(self.member.port_groups)
        return {port: group.topic for group in groups for port in group.ports}

    @cached_property
    def _of_parts(self) -> Mapping[str | None, Sequence[PortRef]]:
        """Ports of each part."""
        found: dict[str | None, list[PortRef]] = {}
        for ref in self.ports:
            found.setdefault(ref.part, []).append(ref)
        return found


def member_wiring(member: Member, system: System) -> Wiring:
    """Return the wiring of a member."""
    components = system.components_by_name
    ports = {PortRef(None, port.name): port for port in member.ports}
    for part in member.parts:
        for port in components[part.component].ports:
            ports[PortRef(part.name, port.name)] = port
    return Wiring(member, ports)


def check_wiring(wired: Wiring, target: str, report: Diagnostics) -> None:
    """Report connectors that remappings of topics cannot express."""
    for connector, construct, hint in _impossible(wired):
        report.report(
            "unsupported-construct", connector.origin, target=target, construct=construct, help=hint
        )


def _impossible(wired: Wiring) -> Iterator[tuple[Connector, str, str]]:
    """Yield each such connector with the construct and a hint."""
    tied: dict[tuple[str, str], tuple[str, PortRef]] = {}
    for ref, port in wired.ports.items():
        if ref.part is None:
            continue
        topic = wired.topic(ref)
        other_topic, other = tied.setdefault((ref.part, port.topic), (topic, ref))
        if other_topic != topic:
            connector = _connector_at(wired, ref) or _connector_at(wired, other)
            assert connector is not None
            construct = (
                f"a connector that separates `{other}` from `{ref}`, "
                f"which are on one topic, `{port.topic}`"
            )
            yield connector, construct, "give the ports topics of their own"
    for group in wired.member.port_groups:
        shown = [wired.ports[ref] for ref in group.ports if ref.part is None]
        own = {port.topic: port for port in reversed(shown)}
        if len(own) > 1:
            *_, second, first = own.values()
            connector = _connector_at(wired, PortRef(None, second.name))
            assert connector is not None
            construct = (
                f"a connection of the member's ports `{first.name}` and `{second.name}`, "
                f"which are on the topics `{first.topic}` and `{second.topic}`"
            )
            yield connector, construct, "give them one topic, or a component between them"


def _connector_at(wired: Wiring, port: PortRef) -> Connector | None:
    """Return the first connector at a port."""
    for connector in wired.member.connectors:
        if port in (connector.source, connector.target):
            return connector
    return None
