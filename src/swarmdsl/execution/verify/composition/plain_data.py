"""A swarm of some size as plain data, to be printed for other model checkers.

It is made of the automata that the engine has run for the verifier: printers add no meaning.
"""

from __future__ import annotations

from collections.abc import Mapping

from swarmdsl.base.records import dataclass
from swarmdsl.base.source import Span
from swarmdsl.execution.verify.swarm.propositions import Combined, Number, Reading

SETTLED, VIOLATED = -1, -2
"""States of a watch: it cannot be violated any more; it is violated."""

__all__ = [
    "SETTLED",
    "VIOLATED",
    "Combined",
    "Composition",
    "Letter",
    "Local",
    "Number",
    "Reading",
    "Rule",
    "Team",
    "Turn",
    "Watch",
]


@dataclass(frozen=True)
class Letter:
    """Message between robots; `data` are its fields that decide on anything, as text."""

    event: str
    data: str
    to: str
    sender: str
    reliable: bool
    origin: Span | None


@dataclass(frozen=True)
class Local:
    """State of a robot: its active states, and variables that decide on anything.

    `holds` are the terms of the watched property that hold in it.
    """

    names: tuple[str, ...]
    values: str
    ended: bool
    holds: frozenset[int]


@dataclass(frozen=True)
class Turn:
    """Step of a robot between two states, by their numbers.

    `hears` is the number of a letter that it takes out of its inbox, `sends` are those that it
    puts into others. `moments` are the terms that hold one after the other, None if that does
    not change. `inputs` say what leads to the step, in the words of traces.
    """

    source: int
    target: int
    hears: int | None
    sends: tuple[int, ...]
    moments: tuple[frozenset[int], ...] | None
    inputs: tuple[str, ...]
    origin: Span | None


@dataclass(frozen=True)
class Team:
    """Robots that nothing tells apart; they start in the same state, with the same inbox.

    `late` has the states in which a letter stays in the inbox, because the robot defers one.
    """

    role: str
    robots: tuple[str, ...]
    first: int
    inbox: tuple[int, ...]
    locals: tuple[Local, ...]
    turns: tuple[Turn, ...]
    late: Mapping[int, frozenset[int]]


@dataclass(frozen=True)
class Rule:
    """Step of a watch to another state if claims are true or false, by their numbers."""

    source: int
    when: tuple[tuple[int, bool], ...]
    target: int


@dataclass(frozen=True)
class Watch:
    """Property with the automaton that watches it.

    `terms` are facts, each true for a number of robots; `claims` are conditions on these numbers,
    with their texts. The automaton has `states`, and SETTLED and VIOLATED; where no rule applies,
    it stays. With `forgets`, steps that change no fact count, too. `me` is the number of the
    team of the robot that the property is about.
    """

    name: str
    text: str
    robot: str | None
    me: int | None
    terms: tuple[str, ...]
    claims: tuple[tuple[str, Reading], ...]
    start: int
    states: int
    rules: tuple[Rule, ...]
    forgets: bool


@dataclass(frozen=True)
class Composition:
    """A swarm of some size, perhaps with a property to watch.

    `receivers` are the teams that get a letter from a robot of a team; the sender is none of
    them. Of more than `capacity` letters of an event in an inbox, the rest is lost.
    """

    name: str
    subject: str
    size: str
    origin: Span | None
    letters: tuple[Letter, ...]
    teams: tuple[Team, ...]
    receivers: Mapping[tuple[int, int], tuple[int, ...]]
    capacity: int
    lossy: bool
    conditions: tuple[str, ...]
    watch: Watch | None = None

    @property
    def robots(self) -> int:
        """Number of robots."""
        return sum(len(team.robots) for team in self.teams)
