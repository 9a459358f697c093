"""Facts that checks gather about declarations: conditions, exchanged events, reuse."""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Mapping, Sequence

from swarmdsl.analysis.checks.value_sets import Values
from swarmdsl.analysis.usage import UsageCache
from swarmdsl.base.records import dataclass, field
from swarmdsl.syntax.ast import (
    Declaration,
    EventTrigger,
    MonitorTrigger,
    Ref,
    Send,
    StateMachine,
)


@dataclass(frozen=True)
class Atom:
    """Condition that the value of a term is one of `values`; `range` are its possible values."""

    term: Hashable
    values: Values
    range: Values


@dataclass(frozen=True)
class Combined:
    """Conjunction of conditions (`every`) or disjunction."""

    every: bool
    parts: tuple[Condition, ...] = ()


Condition = Atom | Combined
# A conjunction without parts holds; a disjunction without parts does not.
ALWAYS = Combined(every=True)


@dataclass
class Exchange:
    """Events that machines that hear each other send and wait for, by topic.

    Each topic has its first place. An exchange is not `complete` if a name was not resolved
    or a part could not be parsed: an event that seems to be missing may be there.
    """

    name: str = ""
    machines: set[StateMachine] = field(default_factory=set)
    sent: dict[str, Send] = field(default_factory=dict)
    awaited: dict[str, EventTrigger | MonitorTrigger] = field(default_factory=dict)
    complete: bool = True

    def add(self, others: Iterable[Exchange | None]) -> Exchange:
        """Add other exchanges; None stands for a machine that was not resolved."""
        for other in others:
            if other is None:
                self.complete = False
                continue
            self.machines |= other.machines
            for topic, send in other.sent.items():
                self.sent.setdefault(topic, send)
            for topic, trigger in other.awaited.items():
                self.awaited.setdefault(topic, trigger)
            self.complete = self.complete and other.complete
        return self


@dataclass
class Reuse:
    """Submachines of a machine.

    `uses` are the references to them with their targets, `own` is the number of the states and
    regions of the machine itself, `levels` their depth with all submachines, once computed.
    """

    uses: Sequence[tuple[Ref[StateMachine], StateMachine]]
    own: int
    levels: int | None = None


@dataclass
class FactCache:
    """Facts about single declarations from the passes over a project.

    They stay valid for the next check: a declaration that changed, or that uses a changed one,
    is another node then. `reused` are the machines that are submachines of others.
    """

    reuse: Mapping[StateMachine, Reuse] = field(default_factory=dict)
    reused: frozenset[StateMachine] = frozenset()
    exchanges: dict[Declaration | None, Exchange] = field(default_factory=dict)
    usage: UsageCache = field(default_factory=UsageCache)

    def forget(self, declarations: Iterable[Declaration]) -> None:
        """Drop the facts of declarations whose references were bound again."""
        for each in declarations:
            self.usage.pop(each, None)
            self.exchanges.pop(each, None)
