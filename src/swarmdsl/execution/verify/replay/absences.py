"""Times of a run in which robots are lost, and nobody misses them or loses sight of others."""

from __future__ import annotations

from collections.abc import Iterator

from swarmdsl.execution.verify.replay.copies import Robot
from swarmdsl.execution.verify.replay.times import Constraint, limits
from swarmdsl.ir import Heartbeat


def absences(robot: Robot, heartbeat: Heartbeat | None, last: int) -> Iterator[Constraint]:
    """Yield the constraints of a robot that is lost for some times, up to a last step."""
    at, crew = robot.moments, robot.body.crew
    for absence in robot.body.absences:
        began = at[absence.began]
        ended = at[absence.ended] if absence.ended is not None else last
        bounds = (absence.lasts, absence.lasts)
        yield from limits(bounds, began, ended, is_over=absence.ended is not None)
        if crew is not None and crew.guesses and heartbeat is not None:
            # It was last heard a period before, and is heard again a period later.
            yield began, ended, 2 * heartbeat.period - heartbeat.timeout
    if crew is not None and crew.is_deaf and heartbeat is not None:
        yield 0, last, 1 - heartbeat.timeout
