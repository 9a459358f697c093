"""Inputs of a robot, and what is running or waits until one of them ends it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple


class Input(NamedTuple):
    """Input of a robot; `actor` is the number of its machine, -1 for all of them.

    `kind` is `end` of an activity, `time` of a delay, `inside` for an event of the robot itself,
    `outside` for one from outside of the swarm, `hear` for one of another robot, `lose` for the
    loss of the robot and `return` for its new start, and `view` if it takes another one for lost or
    hears it again.
    """

    kind: str
    actor: int
    name: str
    choice: Any = None
    near: tuple[int, ...] = ()
    """Numbers of robots that are near, in the order in which the machines ask."""

    @property
    def turn(self) -> int:
        """Turn of the input: events arrive at once, functions take longer, delays longest.

        Most runs in another order fit no times.
        """
        return _TURNS.get(self.kind, 0)


_TURNS = {"end": 1, "time": 2, "return": 2}
"""Turns of inputs that take time."""
LAST_TURN = 3


Task = tuple[str, int, str | int]
"""Task that is over some time: kind of input, machine, state or timer.

It is a running activity or delay, inner events that wait, or the absence of a robot.
"""


class Delay:
    """A running delay: its timer, its length in nanoseconds, and when it began."""

    def __init__(self, actor: int, action: Callable[[], None], length: int, began: int) -> None:
        self.actor = actor
        self.timer: Any = getattr(action, "__self__", None)
        self.length = length
        self.began = began
        self.ended: int | None = None
        """Number of the step at which it ended or was cancelled."""
        self.fired = False


class Wait:
    """A call of a function, or an event of a robot for itself, and when it began.

    `function` is None for an event.
    """

    def __init__(self, task: object, function: str | None, began: int) -> None:
        self.task = task
        self.function = function
        self.began = began
        self.ended: int | None = None
        """Number of the step at which it ended or was cancelled."""
        self.fired = False


class Absence:
    """A time in which a robot is lost: when it began, and how long it lasts."""

    def __init__(self, began: int, lasts: int) -> None:
        self.began = began
        self.lasts = lasts
        self.ended: int | None = None
        """Number of the step at which the robot started anew."""
