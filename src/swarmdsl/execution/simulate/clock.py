"""A clock that goes on when it is told to."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from heapq import heappop, heappush


@dataclass(order=True, slots=True)
class Alarm:
    """Something to do at a time; of those at the same time the first that was scheduled."""

    time: int
    number: int
    action: Callable[[], None] | None = field(compare=False)


class Clock:
    """Time in nanoseconds from 0; nothing happens on its own, and all in a fixed order."""

    def __init__(self) -> None:
        self.now = 0
        self._alarms: list[Alarm] = []
        self._count = 0

    def schedule(self, delay: int, action: Callable[[], None]) -> Alarm:
        """Have `action` called in so many nanoseconds."""
        self._count += 1
        alarm = Alarm(self.now + max(delay, 0), self._count, action)
        heappush(self._alarms, alarm)
        return alarm

    def unschedule(self, alarm: Alarm) -> None:
        """Do not have it called any more."""
        alarm.action = None

    @property
    def next(self) -> int | None:
        """The time of the next thing to do; None when there is none."""
        while self._alarms and self._alarms[0].action is None:
            heappop(self._alarms)
        return self._alarms[0].time if self._alarms else None

    def step(self) -> bool:
        """Go on to the next thing and do it; whether there was one."""
        if self.next is None:
            return False
        alarm = heappop(self._alarms)
        self.now = alarm.time
        assert alarm.action is not None
        alarm.action()
        return True

    def advance(self, duration: int) -> None:
        """Let time pass, and do on the way all that is to be done."""
        end = self.now + duration
        while self.next is not None and self.next <= end:
            self.step()
        self.now = end
