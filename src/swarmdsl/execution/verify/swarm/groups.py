"""Groups of robots that nothing tells apart, and their steps."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

from swarmdsl.base.records import dataclass
from swarmdsl.execution.simulate.machines.actors import Actor
from swarmdsl.execution.verify.automata.clock_classes import ClockClasses
from swarmdsl.execution.verify.automata.clocks import ClockedAutomaton
from swarmdsl.execution.verify.automata.labels import Move
from swarmdsl.execution.verify.automata.quotient import Quotient
from swarmdsl.execution.verify.robot.tasks import LAST_TURN

Clocked = ClockedAutomaton | ClockClasses
"""Automaton of robots with clocks."""
Local = Quotient | Clocked
"""Automaton of the robots of a group."""


@dataclass(frozen=True)
class Group:
    """Robots that nothing tells apart."""

    automaton: Local
    robots: tuple[str | None, ...]

    @property
    def role(self) -> str:
        """Role of the robots."""
        return self.automaton.whole.kind.role

    def cast(self, robot: str | None) -> Sequence[Actor]:
        """Return the machines of a robot of the group."""
        return self.automaton.whole.kind.robots[robot]

    def hears(self, message: int, sender: Group) -> bool:
        """Return True if a robot of the group can get a message of another one."""
        if self is sender and len(self.robots) == 1:
            return False
        if not self.automaton.whole.listens(message):
            return False
        to = self.automaton.whole.alphabet.messages[message].event.envelope.to
        return to is None or to == self.role or to in self.robots


class Place(NamedTuple):
    """State of a robot in its group, with the messages on their way to it."""

    group: int
    state: int
    bag: tuple[int, ...]


class Step(NamedTuple):
    """A step of one robot at a place; without a move, a message is lost."""

    place: int
    move: Move | None
    target: int
    lost: int | None = None

    @property
    def turn(self) -> int:
        """Turn of the input of the robot; time passes when nothing else is left."""
        if self.place < 0:
            return LAST_TURN
        return 0 if self.move is None else self.move.given.turn


TICK = Step(-1, None, -1)
"""Step of all robots with clocks: time passes."""


def without(bag: tuple[int, ...], message: int) -> tuple[int, ...]:
    """Return a bag without one of its messages."""
    at = bag.index(message)
    return (*bag[:at], *bag[at + 1 :])
