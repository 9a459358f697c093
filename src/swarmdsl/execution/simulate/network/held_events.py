"""Events that are held on their way to a robot, until a test lets them arrive or loses them."""

from __future__ import annotations

from swarmdsl.execution.simulate.network.packets import Packet
from swarmdsl.execution.simulate.scenario.scenario import Robot


class HeldEvents:
    """Events that wait for a step of a test, in the order of sending."""

    def __init__(self) -> None:
        self.names: set[tuple[str, str | None]] = set()
        """Events and receivers that are held at present."""
        self._packets: list[Packet] = []

    def add(self, packet: Packet) -> None:
        """Let an event wait."""
        self._packets.append(packet)

    def release(self, event: str, target: str | None) -> list[Packet]:
        """Stop holding an event on its way to a robot; return those that have waited."""
        self.names.remove((event, target))
        return self._remove([each for each in self._packets if _is_of(each, event, target)])

    def leave(self, robot: Robot) -> list[Packet]:
        """Return the events that have waited for a robot that is lost."""
        return self._remove([each for each in self._packets if each.target is robot])

    def take(
        self, event: str, target: str | None, source: str | None, *, arrives: bool
    ) -> Packet | str:
        """Return the first event that waits, with a `source` that of this robot.

        Return the reason if there is none, or if it is to arrive and an earlier event of the same
        channel waits.
        """
        waiting = [each for each in self._packets if _is_of(each, event, target)]
        packet = next((p for p in waiting if source in (None, p.source.name)), None)
        if packet is None:
            return "it is not on its way"
        first = next(each for each in self._packets if each.channel == packet.channel)
        if arrives and first is not packet:
            return f"`{first.event.name}` of the same sender arrives before it"
        self._packets.remove(packet)
        return packet

    def _remove(self, packets: list[Packet]) -> list[Packet]:
        for packet in packets:
            self._packets.remove(packet)
        return packets


def _is_of(packet: Packet, event: str, target: str | None) -> bool:
    return packet.event.name == event and packet.target.name == target
