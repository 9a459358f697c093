"""Virtual clock."""

from __future__ import annotations

from collections.abc import Callable
from heapq import heappop, heappush


class Alarm:
    """Scheduled action, None once it was cancelled."""

    __slots__ = ("action",)

    def __init__(self, action: Callable[[], None]) -> None:
        self.action: Callable[[], None] | None = action


class Clock:
    """Time in nanoseconds from 0; deterministic, advanced explicitly.

    Actions at the same time run in the order of scheduling.
    """

    def __init__(self) -> None:
        self.now = 0
        self._alarms: list[tuple[int, int, Alarm]] = []
        self._count = 0

    def schedule(self, delay: int, action: Callable[[], None]) -> Alarm:
        """Schedule a call of `action` after a delay in nanoseconds."""
        self._count += 1
        alarm = Alarm(action)
        # The number is unique: alarms are never compared.
        heappush(self._alarms, (self.now + max(delay, 0), self._count, alarm))
        return alarm

    def unschedule(self, alarm: Alarm) -> None:
        """Cancel a scheduled action."""
        alarm.action = None

    @property
    def next(self) -> int | None:
        """Time of the next action; None if there is none."""
        alarms = self._alarms
        while alarms and alarms[0][2].action is None:
            heappop(alarms)
        return alarms[0][0] if alarms else None

    def step(self) -> bool:
        """Advance to the next action and execute it; return False if there is none."""
        if self.next is None:
            return False
        self.now, _, alarm = heappop(self._alarms)
        assert alarm.action is not None
        alarm.action()
        return True

    def advance(self, duration: int) -> None:
        """Advance the time and execute all actions that become due."""
        end = self.now + duration
        while (due := self.next) is not None and due <= end:
            self.step()
        self.now = end
