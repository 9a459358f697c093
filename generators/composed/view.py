"""Views of a composed swarm that the templates of all languages print."""

from __future__ import annotations

from swarmdsl.codegen import Span, dataclass
from swarmdsl.execution.verify.composition import Reading, Rule


@dataclass(frozen=True)
class LetterView:
    """Message between robots; `event` names those of the same event."""

    name: str
    event: str
    text: str
    reliable: bool
    origin: Span | None


@dataclass(frozen=True)
class StateView:
    """State of a robot."""

    name: str
    text: str


@dataclass(frozen=True)
class Sent:
    """A letter from a robot of a team, and the teams that get it."""

    name: str
    letter: LetterView
    team: str
    receivers: tuple[str, ...]


@dataclass(frozen=True)
class Change:
    """Change of the number of robots for which a term holds; `mine` if it is for me, too."""

    term: int
    more: bool
    mine: bool


@dataclass(frozen=True)
class Look:
    """Changes, after which the watch looks at the numbers."""

    changes: tuple[Change, ...]


@dataclass(frozen=True)
class TurnView:
    """Step of a robot; `looks` and then the `last` changes follow each other."""

    source: str
    target: str
    hears: LetterView | None
    sends: tuple[Sent, ...]
    looks: tuple[Look, ...]
    last: tuple[Change, ...]
    ends: bool
    text: str
    origin: Span | None


@dataclass(frozen=True)
class Loss:
    """Loss of a letter on its way, but not in states in which it waits until it is not deferred."""

    letter: LetterView
    waits: tuple[str, ...]


@dataclass(frozen=True)
class TeamView:
    """Robots that nothing tells apart, with the numbers of the first and the last one.

    `inbox` has for each letter how many are on their way to each robot at first.
    """

    name: str
    title: str
    first: int
    last: int
    start: str
    inbox: tuple[int, ...]
    states: tuple[StateView, ...]
    ended: tuple[str, ...]
    turns: tuple[TurnView, ...]
    losses: tuple[Loss, ...]

    @property
    def size(self) -> int:
        """Number of robots."""
        return self.last - self.first + 1


@dataclass(frozen=True)
class WatchView:
    """Automaton that watches a property.

    `first` are the numbers of the terms at first. Of the terms `mine`, it counts if they hold for
    the robot of the property; `first_mine` says so at first.
    """

    name: str
    text: str
    terms: tuple[str, ...]
    mine: tuple[int, ...]
    first: tuple[int, ...]
    first_mine: tuple[int, ...]
    claims: tuple[tuple[str, Reading], ...]
    start: int
    settled: int
    violated: int
    rules: tuple[Rule, ...]


@dataclass(frozen=True)
class SwarmView:
    """A composed swarm."""

    name: str
    title: str
    place: str
    origin: Span | None
    capacity: int
    lossy: bool
    robots: int
    conditions: tuple[str, ...]
    letters: tuple[LetterView, ...]
    teams: tuple[TeamView, ...]
    sent: tuple[Sent, ...]
    watch: WatchView | None
