"""Virtual clock."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from heapq import heappop, heappush


@dataclass(order=True, slots=True)
class Alarm:
    """Scheduled action; actions at the same time run in the order of scheduling."""

    time: int
    number: int
    action: Callable[[], None] | None = field(compare=False)


class Clock:
    """Time in nanoseconds from 0; deterministic, advanced explicitly."""

    def __init__(self) -> None:
        self.now = 0
        self._alarms: list[Alarm] = []
        self._count = 0

    def schedule(self, delay: int, action: Callable[[], None]) -> Alarm:
        """Schedule a call of `action` after a delay in nanoseconds."""
        self._count += 1
        alarm = Alarm(self.now + max(delay, 0), self._count, action)
        heappush(self._alarms, alarm)
        return alarm

    def unschedule(self, alarm: Alarm) -> None:
        """Cancel a scheduled action."""
        alarm.action = None

    @property
    def next(self) -> int | None:
        """Time of the next action; None if there is none."""
        while self._alarms and self._alarms[0].action is None:
            heappop(self._alarms)
        return self._alarms[0].time if self._alarms else None

    def step(self) -> bool:
        """Advance to the next action and execute it; return False if there is none."""
        if self.next is None:
            return False
        alarm = heappop(self._alarms)
        self.now = alarm.time
        assert alarm.action is not None
        alarm.action()
        return True

    def advance(self, duration: int) -> None:
        """Advance the time and execute all actions that become due."""
        end = self.now + duration
        while self.next is not None and self.next <= end:
            self.step()
        self.now = end
