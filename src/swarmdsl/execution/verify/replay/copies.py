"""Named robots of a run, and the copies of messages on their way to them."""

from __future__ import annotations

from swarmdsl.base.records import dataclass, field
from swarmdsl.execution.engine import Event
from swarmdsl.execution.verify.robot.body import Body
from swarmdsl.execution.verify.swarm.groups import Group


@dataclass(eq=False)
class Copy:
    """A message on its way to one robot."""

    number: int
    event: Event
    topic: str
    order: int
    line: int | None
    """Number of the line on which it was sent; None for the loss of a robot that has ended."""
    sent: int
    """Number of the step at which it was sent."""
    source: Robot


@dataclass(eq=False)
class Robot:
    """A robot of a run: its state in the automaton, and what is on its way to it."""

    name: str | None
    group: Group
    state: int
    body: Body
    bag: list[Copy] = field(default_factory=list)
    late: list[Copy] = field(default_factory=list)
    """Messages beyond the capacity of the network: they do not arrive in the run."""
    moments: list[int] = field(default_factory=list)
    """Numbers of the steps of the run at which it did something."""

    @property
    def order(self) -> tuple[str, int]:
        """Order of the robots of a run: by their roles and numbers."""
        role, _, number = (self.name or "").partition("[")
        return role, int(number[:-1]) if number else 0

    def is_at(self, state: int, bag: tuple[int, ...]) -> bool:
        """Return True if it is at a place of the network."""
        mine = tuple(sorted(copy.number for copy in self.bag))
        return self.group.automaton.classes[self.state] == state and mine == bag


def precedes(one: Copy, other: Copy) -> bool:
    """Return True if a message was sent before another one on the same channel."""
    senders = (each.event.envelope.sender for each in (one, other))
    return one.order < other.order and one.topic == other.topic and len(set(senders)) == 1
