"""A composed swarm as the variables, automata and edges of a JANI model."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any

from swarmdsl.codegen import FreshNames, Span, dataclass

from ..composed.view import Change, LetterView, Loss, Sent, SwarmView, TeamView, TurnView
from .expressions import (
    Expression,
    all_of,
    binary,
    claim,
    either,
    increased,
    negated,
    total,
)


@dataclass(frozen=True)
class Variable:
    """Global variable: a number up to `most`, or a truth value if that is None."""

    name: str
    most: int | None
    first: int | bool
    text: str

    @property
    def kind(self) -> Expression:
        """The type."""
        if self.most is None:
            return "bool"
        return {"kind": "bounded", "base": "int", "lower-bound": 0, "upper-bound": self.most}


@dataclass(frozen=True)
class Edge:
    """Edge of an automaton with its origin in the model."""

    content: dict[str, Any]
    origin: Span | None


@dataclass(frozen=True)
class Automaton:
    """Robot."""

    name: str
    team: TeamView
    edges: tuple[Edge, ...]


class Document:
    """Model of a swarm."""

    def __init__(self, swarm: SwarmView) -> None:
        self._swarm = swarm
        names, variables = FreshNames(), FreshNames()
        self._robots = {
            team.name: [names.new(f"{team.name}_{number}") for number in range(team.size)]
            for team in swarm.teams
        }
        self._arriving = {team.name: self._arriving_at(team) for team in swarm.teams}
        self._inboxes: dict[tuple[str, str], Variable] = {}
        self._ended: dict[str, Variable] = {}
        for team in swarm.teams:
            for robot in self._robots[team.name]:
                for number, letter in self._arriving[team.name]:
                    name = variables.new(f"inbox_{robot}_{letter.name}")
                    self._inboxes[robot, letter.name] = Variable(
                        name, swarm.capacity, team.inbox[number], f"{letter.text} on its way"
                    )
                if team.ended and self._arriving[team.name]:
                    name = variables.new(f"ended_{robot}")
                    self._ended[robot] = Variable(name, None, team.start in team.ended, "")

        self.automata = tuple(self._automata())
        """The robots."""
        every = tuple(self._variables())
        assigned = {
            assignment["ref"]
            for robot in self.automata
            for edge in robot.edges
            for destination in edge.content["destinations"]
            for assignment in destination.get("assignments", ())
        }
        self.variables = tuple(each for each in every if each.name in assigned)
        # Storm takes 0 for the first value of a variable that nothing assigns.
        self.constants = tuple(each for each in every if each.name not in assigned)

    def _variables(self) -> Iterator[Variable]:
        yield from self._inboxes.values()
        yield from self._ended.values()
        watch = self._swarm.watch
        if watch is None:
            return
        yield Variable("watch", watch.violated, watch.start, "state of the watch of the property")
        for number, (text, first) in enumerate(zip(watch.terms, watch.first, strict=True)):
            yield Variable(f"count_{number}", self._swarm.robots, first, f"robots: {text}")
        for number, first in zip(watch.mine, watch.first_mine, strict=True):
            text = f"the robot of the property: {watch.terms[number]}"
            yield Variable(f"my_count_{number}", 1, first, text)

    def _automata(self) -> Iterator[Automaton]:
        for team in self._swarm.teams:
            for robot in self._robots[team.name]:
                turns = [self._turn(robot, team, turn) for turn in team.turns]
                losses = [edge for each in team.losses for edge in self._losses(robot, team, each)]
                yield Automaton(robot, team, (*turns, *losses))

    def is_violated(self) -> Expression:
        """Return the condition that the property is violated."""
        watch = self._swarm.watch
        return watch is not None and binary("=", "watch", watch.violated)

    def _arriving_at(self, team: TeamView) -> list[tuple[int, LetterView]]:
        """Return the letters that a robot of a team may get, with their numbers."""
        heard = {turn.hears.name for turn in team.turns if turn.hears is not None}
        sent = {each.letter.name for each in self._swarm.sent if team.name in each.receivers}
        return [
            (number, letter)
            for number, letter in enumerate(self._swarm.letters)
            if letter.name in heard | sent or team.inbox[number]
        ]

    def _turn(self, robot: str, team: TeamView, turn: TurnView) -> Edge:
        steps = _Steps()
        guard = None
        if turn.ends:
            for _, letter in self._arriving[team.name]:
                steps.add(0, self._inboxes[robot, letter.name].name, 0)
            if robot in self._ended:
                steps.add(0, self._ended[robot].name, True)
        if turn.hears is not None:
            inbox = self._inboxes[robot, turn.hears.name].name
            guard = binary("≤", 1, inbox)
            if not turn.ends:
                steps.add(0, inbox, increased(inbox, -1))
        for number, each in enumerate(turn.sends):
            self._send(steps, number, robot, each)
        for number, look in enumerate(turn.looks):
            self._count(steps, number, look.changes)
            steps.add(number + 1, "watch", self._look())
        self._count(steps, len(turn.looks), turn.last)
        return _edge(turn.source, turn.target, guard, steps, turn.text, turn.origin)

    def _send(self, steps: _Steps, index: int, me: str, sent: Sent) -> None:
        """Put a letter into the inboxes of all that get it and have room for it."""
        letter = sent.letter
        for team in self._swarm.teams:
            same = [each for _, each in self._arriving[team.name] if each.event == letter.event]
            for robot in self._robots[team.name] if team.name in sent.receivers else ():
                if robot == me:
                    continue
                ended = self._ended.get(robot)
                waiting = [self._inboxes[robot, each.name].name for each in same]
                room = binary("≤", total(waiting), self._swarm.capacity - 1)
                inbox = self._inboxes[robot, letter.name].name
                gets = all_of([*([negated(ended.name)] if ended is not None else []), room])
                steps.add(index, inbox, either(gets, increased(inbox, 1), inbox))

    def _losses(self, robot: str, team: TeamView, loss: Loss) -> Iterator[Edge]:
        inbox = self._inboxes[robot, loss.letter.name].name
        for state in team.states:
            if state.name not in loss.waits and state.name not in team.ended:
                steps = _Steps()
                steps.add(0, inbox, increased(inbox, -1))
                guard = binary("≤", 1, inbox)
                text = f"{loss.letter.text} is lost"
                yield _edge(state.name, state.name, guard, steps, text, loss.letter.origin)

    def _count(self, steps: _Steps, index: int, changes: Iterable[Change]) -> None:
        watch = self._swarm.watch
        for each in changes:
            names = [f"count_{each.term}"]
            if each.mine and watch is not None and each.term in watch.mine:
                names.append(f"my_count_{each.term}")
            for name in names:
                steps.add(index, name, increased(name, 1 if each.more else -1))

    def _look(self) -> Expression:
        """Return the next state of the watch."""
        watch = self._swarm.watch
        following: Expression = "watch"
        for rule in reversed(watch.rules if watch is not None else ()):
            assert watch is not None
            conditions = [binary("=", "watch", rule.source)]
            for number, truth in rule.when:
                holds = claim(watch.claims[number][1])
                conditions.append(holds if truth else negated(holds))
            following = either(all_of(conditions), rule.target, following)
        return following


class _Steps:
    """Assignments of an edge, which are made in the order of their indices."""

    def __init__(self) -> None:
        self.made: list[dict[str, Any]] = []

    def add(self, index: int, name: str, value: Expression) -> None:
        """Assign a value; assignments with the same index are made at once."""
        self.made.append({"ref": name, "value": value, **({"index": index} if index else {})})


def _edge(
    source: str,
    target: str,
    guard: Expression | None,
    steps: _Steps,
    text: str,
    origin: Span | None,
) -> Edge:
    made: dict[str, Any] = {"location": source, "comment": text}
    if guard is not None:
        made["guard"] = {"exp": guard}
    destination: dict[str, Any] = {"location": target}
    if steps.made:
        destination["assignments"] = steps.made
    return Edge({**made, "destinations": [destination]}, origin)
