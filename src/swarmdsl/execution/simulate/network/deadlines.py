"""Deadlines within which a robot hears the next event of a sender."""

from __future__ import annotations

from collections.abc import Callable

from swarmdsl.execution.simulate.network.packets import Packet
from swarmdsl.execution.simulate.scenario.clock import Alarm, Clock
from swarmdsl.execution.simulate.scenario.scenario import Robot


class Deadlines:
    """Alarms by sender, receiver and event; `missed(name, receiver)` is called for a late event."""

    def __init__(self, clock: Clock, missed: Callable[[str, Robot], None]) -> None:
        self._clock = clock
        self._missed = missed
        self._alarms: dict[tuple[Robot, Robot, str], Alarm] = {}

    def arrived(self, packet: Packet) -> None:
        """Expect the next event of a sender within its deadline, if it has one."""
        deadline = packet.declared.delivery.deadline if packet.declared.delivery else None
        if deadline is None:
            return
        key = source, target, name = packet.source, packet.target, packet.event.name
        before = self._alarms.pop(key, None)
        if before is not None:
            self._clock.unschedule(before)

        def miss() -> None:
            del self._alarms[source, target, name]
            self._missed(name, target)

        self._alarms[key] = self._clock.schedule(deadline, miss)

    def leave(self, robot: Robot) -> None:
        """Expect nothing more of a robot that is lost, and nothing for it."""
        for (source, target, name), alarm in list(self._alarms.items()):
            if robot in (source, target):
                self._clock.unschedule(alarm)
                del self._alarms[source, target, name]
