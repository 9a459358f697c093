"""Kinds of robots: what they run, what comes from outside, and whether they can be lost."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from swarmdsl.base.records import dataclass, field
from swarmdsl.execution.engine import Event
from swarmdsl.execution.simulate.machines.actors import Actor
from swarmdsl.execution.simulate.network.members import DEPARTED
from swarmdsl.execution.verify.robot.body import Body
from swarmdsl.execution.verify.robot.environment import Arrivals, Ends
from swarmdsl.execution.verify.robot.membership import Crew
from swarmdsl.execution.verify.robot.tasks import Input
from swarmdsl.ir import Count, Fact


@dataclass
class Kind:
    """Robots with the same automaton: what they run, and what comes from outside."""

    role: str
    cast: Sequence[Actor]
    facts: Sequence[Fact | Count]
    outside: Arrivals
    ends: Mapping[str, Ends] = field(default_factory=dict)
    """Ends of the functions that it calls."""
    crew: Crew | None = None
    """Robots of the swarm, if some can be lost, or if this one asks who is there."""
    losses: int = 0
    """Number of robots that can be lost, as far as such a robot can tell."""
    can_be_lost: bool = False
    absences: Sequence[int] = ()
    """Lengths of its absences; empty if it does not come back."""
    others: int = 0
    """Number of other robots of the swarm."""
    robots: dict[str | None, Sequence[Actor]] = field(default_factory=dict)
    """Machines of each robot of the kind; `cast` are those of the first one."""

    @property
    def silent(self) -> frozenset[str]:
        """Functions that may never answer."""
        return frozenset(name for name, ends in self.ends.items() if ends.is_silent)

    @property
    def is_deaf(self) -> bool:
        """True if other robots are taken for lost some time, since no heartbeat arrives."""
        return self.crew is not None and self.crew.is_deaf

    @property
    def has_heartbeat(self) -> bool:
        """True if other robots notice when one of them is lost."""
        return self.crew is not None and self.crew.tells

    def listens(self, event: str) -> bool:
        """Return True if a machine gets an event."""
        if event == DEPARTED:
            return self.crew is not None and any(map(self.crew.observes, self.cast))
        return any(actor.listens(event) for actor in self.cast)

    def choices(self, given: Input) -> Iterator[Input]:
        """Yield an input, or each end of an activity with its outcome and result."""
        if given.kind != "end":
            yield given
            return
        state = given.choice
        ends = self.ends[given.name]
        for index in range(len(ends.results)):
            yield given._replace(choice=(state, "succeeded", index))
        for outcome in ends.others:
            yield given._replace(choice=(state, outcome, None))

    def departure(self, body: Body, event: Event, *, by_name: bool) -> Event | None:
        """Return an event that gives up a robot, None if there is none left to give up.

        It is about the robot of the event if they are told apart `by_name`, else about any other
        one of its role that is not missed yet.
        """
        assert self.crew is not None
        assert body.roster is not None
        if body.missed >= self.losses:
            return None
        wanted = event.data["id" if by_name else "role"]
        for robot in self.crew.robots:
            is_meant = (robot.name if by_name else robot.role) == wanted
            is_other = robot.name != self.cast[0].robot.name
            if is_meant and is_other and not body.roster.misses(robot):
                return Event(DEPARTED, {"id": robot.name or "", "role": robot.role})
        return None
