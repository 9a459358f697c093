"""Other robots as one robot sees them: events of heartbeats, or guesses where these are lost."""

from __future__ import annotations

from collections.abc import Iterator

from swarmdsl.execution.engine import Event
from swarmdsl.execution.simulate.network.members import DEPARTED, JOINED
from swarmdsl.execution.verify.abstraction.alphabet import Alphabet
from swarmdsl.execution.verify.robot.body import Body
from swarmdsl.execution.verify.robot.robot_kind import Kind
from swarmdsl.execution.verify.robot.tasks import Input


class Presence:
    """Events by which a robot of a kind follows who is there."""

    def __init__(self, kind: Kind, alphabet: Alphabet) -> None:
        self._kind = kind
        self._alphabet = alphabet

    def departure(self, body: Body, event: Event) -> Event | None:
        """Return the event that gives up one more robot, None if there is none left."""
        return self._kind.departure(body, event, by_name=self._by_name)

    def guesses(self, body: Body) -> Iterator[Input]:
        """Yield each way in which a robot may take another one for lost, or hear one again.

        They are told apart by their names if these count, else by their roles.
        """
        crew = body.crew
        if crew is None or not crew.guesses or body.roster is None or not body.running:
            return
        found: dict[Input, None] = {}
        for robot in crew.robots:
            if robot.name != body.cast[0].robot.name:
                name = JOINED if body.roster.misses(robot) else DEPARTED
                by_name = self._alphabet.demands.identity
                choice = robot.name if by_name else robot.role
                found[Input("view", -1, name, choice)] = None
        yield from found

    def guessed(self, body: Body, given: Input) -> Event:
        """Return the event of a guess."""
        assert body.crew is not None
        assert body.roster is not None
        for robot in body.crew.robots:
            is_meant = given.choice in (robot.name, robot.role)
            is_other = robot.name != body.cast[0].robot.name
            if is_meant and is_other and body.roster.misses(robot) == (given.name == JOINED):
                return Event(given.name, {"id": robot.name or "", "role": robot.role})
        raise AssertionError("a robot is meant")

    @property
    def _by_name(self) -> bool:
        """True if it counts which robot is lost."""
        return any(path[:1] in ((), ("id",)) for path in self._alphabet.demands.fields(DEPARTED))
