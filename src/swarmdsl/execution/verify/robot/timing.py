"""Least and greatest times of functions and events, as in a scenario."""

from __future__ import annotations

from swarmdsl.base.records import dataclass
from swarmdsl.execution.simulate.scenario.scenario import EVERY_FUNCTION, Robot, Scenario

Bounds = tuple[int, int | None]
"""The least and the greatest time; None is no limit."""
AT_ONCE: Bounds = (0, 0)


@dataclass(frozen=True)
class Timing:
    """Times of a scenario, in nanoseconds; if `lossy`, any event between robots may be lost."""

    scenario: Scenario
    lossy: bool = False
    silent: tuple[str, ...] = ()
    """Functions that may never answer."""

    def function(self, name: str, robot: Robot) -> Bounds:
        """Return the times after which a function of a robot can end."""
        behavior = self.scenario.behavior(name, robot)
        least, most = behavior.duration.bounds
        falls_silent = any(
            fault.function in (name, EVERY_FUNCTION) for fault in self.scenario.faults
        )
        is_sure = not (behavior.never or falls_silent or name in self.silent)
        return least, most if is_sure else None

    def message(self, *, repeats: bool) -> Bounds:
        """Return the times after which an event can arrive at another robot.

        One that `repeats` is sent again if it is lost, or waits for a robot out of reach.
        """
        least, most = self.scenario.latency.bounds
        may_be_lost = self.lossy or self.scenario.loss > 0
        may_be_lost |= any(fault.apart for fault in self.scenario.faults)
        return least, None if repeats and may_be_lost else most

    def stops_late(self, name: str, robot: Robot) -> bool:
        """Return True if a cancelled function of a robot takes time to stop."""
        return self.scenario.behavior(name, robot).stopping.bounds != AT_ONCE
