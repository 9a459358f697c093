"""Moves of a robot and its states, as far as findings and properties can see them."""

from __future__ import annotations

from typing import NamedTuple

from swarmdsl.execution.verify.robot.tasks import Input, Task


class Moment(NamedTuple):
    """Part of a line of a trace that findings and properties are about.

    `holding` are the facts that hold for the robot then, as a set of bits.
    """

    actor: int
    event: str | None
    taken: tuple[str, ...]
    entered: tuple[str, ...]
    holding: int
    ignored: bool
    started: tuple[str, ...]
    sent: tuple[str, ...]
    failures: tuple[str, ...]
    loops: bool


class Slot(NamedTuple):
    """Place of a running activity or delay in a state of a robot.

    `key` is the number of the state of an activity or the name of the timer of a delay, `name` that
    of the function, and `order` the number among delays of the same timer.
    """

    kind: str
    actor: int
    key: int | str
    name: str
    order: int = 0


class Carried(NamedTuple):
    """A slot after a move: that from which its task comes, or the length of a new delay.

    Both are None for an activity that begins.
    """

    source: int | None
    length: int | None


class Move(NamedTuple):
    """A step of a robot: its input, what it shows, the messages that it sends, its target.

    `ended` are the tasks that are over after it, `carried` the slots of its target.
    """

    given: Input
    moments: tuple[Moment, ...]
    sends: tuple[int, ...]
    target: int
    ended: frozenset[Task] = frozenset()
    carried: tuple[Carried, ...] = ()

    @property
    def supposes(self) -> bool:
        """True if it supposes what is open: who is near, or who is taken for lost."""
        return any(self.given.near) or self.given.kind == "view"

    @property
    def idle(self) -> bool:
        """True if the robot ignores the input."""
        return all(each.ignored for each in self.moments) and not self.sends


class Look(NamedTuple):
    """State of a robot, as far as findings and properties can see it.

    `holding` are its facts, `held` those of each machine. `innermost` are the active states with
    the numbers of their machines. In a `quiet` state nothing is running: it waits for events.
    """

    ended: bool
    holding: int
    innermost: tuple[tuple[int, str], ...]
    quiet: bool
    held: tuple[int, ...]
