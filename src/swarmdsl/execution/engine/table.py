"""State machine tables: the plain data that the engine runs.

A `Machine` has `State`s and `Transition`s, as in SCXML 1.0, and is shared by all its instances.
Guards and effects are callables in it.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from enum import Enum
from functools import cached_property
from itertools import combinations
from typing import Any, Callable, NamedTuple, Protocol  # noqa: UP035 - for Python 3.8


class Origin(Protocol):
    """Delay or activity run that sends an event to its own instance."""

    over: bool


class Envelope(NamedTuple):
    """Facts about an event between robots: who sent it, when, and the address.

    `sender` is empty for events from outside of the swarm. The time is in nanoseconds. `to` is the
    id of a robot or a role, or None for all other robots.
    """

    sender: str = ""
    sent: int = 0
    to: str | None = None


NO_ENVELOPE = Envelope()


class Event:
    """Event with its name and data; immutable.

    `origin` is the delay or activity of the instance that sent the event, if any.
    """

    __slots__ = ("data", "envelope", "name", "origin")

    def __init__(
        self,
        name: str,
        data: Any = None,
        origin: Origin | None = None,
        envelope: Envelope = NO_ENVELOPE,
    ) -> None:
        self.name = name
        self.data = data
        self.origin = origin
        self.envelope = envelope


class ActiveStates(Protocol):
    """Active states of an instance: a `Configuration`."""

    @property
    def ids(self) -> list[str]:
        """Ids of the active states, in document order."""

    @property
    def innermost(self) -> list[str]:
        """Ids of the active states without active children."""


class InstanceLike(Protocol):
    """The part of an `Instance` that guards, effects, observers and worlds use."""

    data: Any
    running: bool

    @property
    def time(self) -> int:
        """The time in nanoseconds, from any zero; delays pass in it."""

    @property
    def machine(self) -> Machine:
        """The machine that runs."""

    @property
    def configuration(self) -> ActiveStates:
        """The active states, between two steps."""

    @property
    def final(self) -> str | None:
        """Id of the final state in which the machine ended."""

    @property
    def observer(self) -> Logger | None:
        """Receiver of log lines."""

    def active(self, state: str) -> bool:
        """Return True if a state is active."""

    def elapsed(self, state: str) -> int:
        """Return for how long an active, timed state has been active, in nanoseconds."""

    def holds(self, guard: Guard, event: Event) -> bool:
        """Return True if a guard holds."""

    def receive(self, event: Event) -> None:
        """Process an event from outside."""

    def raise_event(self, event: Event) -> None:
        """Append an event to the internal queue."""

    def send_after(self, event: Event, delay: int, id_: str = "") -> None:
        """Send an event to this instance after a delay in nanoseconds."""

    def emit_after(self, event: Event, delay: int, id_: str = "") -> None:
        """Send an event to the world after a delay in nanoseconds."""

    def cancel(self, id_: str) -> None:
        """Cancel the delayed events with an id."""

    def fail(self, error: Exception) -> None:
        """Report an error to the world and raise `error.execution`."""

    def emit(self, event: Event) -> None:
        """Send an event to the world."""


class Logger(Protocol):
    """Receiver of log lines: an `Observer`."""

    def logged(self, instance: InstanceLike, text: str) -> None:
        """Take a line that an effect wrote."""


Guard = Callable[[InstanceLike, Event], Any]
Effect = Callable[[InstanceLike, Event], object]
"""Executable content as a unit: an error skips the rest of it."""


class Kind(Enum):
    """Kind of a state; STATE and PARALLEL are the same without children."""

    STATE = "state"
    PARALLEL = "parallel"
    FINAL = "final"
    HISTORY = "history"
    DEEP_HISTORY = "deep history"


class Transition(NamedTuple):
    """Transition to the states with the ids `targets`; targetless without them.

    Each of `events` triggers it: `a.b` is an exact name, `a.b.*` a prefix, `*` any event. Without
    events it is eventless.
    """

    events: tuple[str, ...] = ()
    targets: tuple[str, ...] = ()
    guard: Guard | None = None
    effect: Effect | None = None
    internal: bool = False
    origin: object = None
    """Source of the transition, for traces."""
    around: int | None = None
    """Index of the transition of the parallel parent that a region implements."""


@dataclass(frozen=True, eq=False)
class Activity:
    """Activity of an active state, on a server outside of the machine.

    `goal` creates the goal at the start. `finalize` processes the event of success before any
    transition is selected: it stores the result. `events` maps outcomes to event names. `refused`
    is the outcome if a service responds with a false field `success`.
    """

    name: str
    server: str
    events: Mapping[str, str]
    goal: Callable[[InstanceLike], Any] | None = None
    finalize: Effect | None = None
    refused: str = "aborted"


class State(NamedTuple):
    """State with its content.

    `initial` has the ids to enter by default in a compound state, or is a transition with an
    effect; the first child by default. A history has one transition, to its default. `donedata`
    creates the data of the `done.state` event of a final state. Events of `deferred`, which are
    written like those of a transition, are kept until a state that does not defer them. Guards and
    effects can ask for how long a `timed` state has been active.
    """

    id: str
    kind: Kind = Kind.STATE
    states: tuple[State, ...] = ()
    initial: Transition | tuple[str, ...] = ()
    transitions: tuple[Transition, ...] = ()
    entry: tuple[Effect, ...] = ()
    exit: tuple[Effect, ...] = ()
    activity: Activity | None = None
    donedata: Callable[[InstanceLike, Event], Any] | None = None
    origin: object = None
    deferred: tuple[str, ...] = ()
    timed: bool = False


class TableError(ValueError):
    """Invalid table; `id` is the invalid state."""

    def __init__(self, message: str, state: str) -> None:
        super().__init__(message)
        self.id = state


class Edge:
    """Transition with states as numbers."""

    __slots__ = ("events", "guard", "source", "table", "targets")

    def __init__(self, source: int, targets: tuple[int, ...], table: Transition) -> None:
        self.source = source
        self.targets = targets
        self.table = table
        self.guard = table.guard
        self.events = table.events

    def matches(self, name: str) -> bool:
        """Return True if an event name triggers it; the empty name means no event."""
        if not name or not self.events:
            return not name and not self.events
        return matches(self.events, name)


def matches(events: tuple[str, ...], name: str) -> bool:
    """Return True if an event name is among exact names, `a.b`, and prefixes, `a.b.*`."""
    return name in events or any(
        f"{name}.".startswith(event[:-1]) for event in events if event[-1] == "*"
    )


class Machine:
    """State machine, shared by any number of instances.

    States are numbered in document order, 0 is the machine itself; a set of states is an int with
    one bit per state. `data` creates the initial data of an instance, `setup` initializes them at
    the start.

    `limit` is the number of steps per event that counts as an endless loop, `most_deferred` the
    number of deferred events that an instance keeps.

    Raises TableError for invalid states.
    """

    def __init__(
        self,
        name: str,
        states: Sequence[State],
        initial: Transition | tuple[str, ...] = (),
        *,
        data: Callable[[], Any] = dict,
        setup: tuple[Effect, ...] = (),
        limit: int = 10_000,
        most_deferred: int = 100,
    ) -> None:
        self.name = name
        self.data = data
        self.setup = setup
        self.limit = limit
        self.most_deferred = most_deferred
        root = State("", Kind.STATE, tuple(states), initial)
        self.states: list[State] = []
        self.parents: list[int] = []
        self.inside: list[int] = []
        """Descendants of each state."""
        self.children: list[list[int]] = []
        self.histories: list[list[int]] = []
        self.numbers: dict[str, int] = {}
        self._add(root, 0)
        self.entries: list[Edge | None] = [None] * len(self.states)
        """Initial transition of each compound state, default transition of each history."""
        self.edges: list[tuple[Edge, ...]] = [()] * len(self.states)
        self.eventless = 0
        """States with an eventless transition."""
        for number, state in enumerate(self.states):
            self._link(number, state)
        self.every_history = tuple(each for around in self.histories for each in around)
        self.blank = (0,) * len(self.every_history)
        """Initial content of the histories."""
        self.configurations: dict[tuple[int, tuple[int, ...]], Any] = {}
        """Cache of `configuration.Configuration`, by active states and histories."""
        self.cached = 0
        """Number of cached decisions and steps."""

    def _add(self, state: State, parent: int) -> None:
        number = len(self.states)
        if state.id in self.numbers:
            raise TableError(f"duplicate state `{state.id}`", state.id)
        self.numbers[state.id] = number
        self.states.append(state)
        self.parents.append(parent)
        self.inside.append(0)
        children: list[int] = []
        self.children.append(children)
        histories: list[int] = []
        self.histories.append(histories)
        for child in state.states:
            remembers = child.kind in (Kind.HISTORY, Kind.DEEP_HISTORY)
            (histories if remembers else children).append(len(self.states))
            self._add(child, number)
        if len(self.states) > number + 1:
            self.inside[number] = (1 << len(self.states)) - (2 << number)

    def _link(self, number: int, state: State) -> None:
        if state.kind in (Kind.HISTORY, Kind.DEEP_HISTORY):
            if len(state.transitions) != 1:
                raise TableError(f"history `{state.id}` must have one transition", state.id)
            self.entries[number] = self._edge(self.parents[number], state.transitions[0], state)
            return
        if state.transitions:
            self.edges[number] = tuple([self._edge(number, t, state) for t in state.transitions])
            if () in [each.events for each in state.transitions]:
                self.eventless |= 1 << number
        if self.children[number] and state.kind is not Kind.PARALLEL:
            initial = state.initial or (self.states[self.children[number][0]].id,)
            if not isinstance(initial, Transition):
                initial = Transition(targets=initial)
            edge = self._edge(number, initial, state)
            for target in edge.targets:
                if not self.inside[number] >> target & 1:
                    raise TableError(f"`{initial.targets[0]}` is not in `{state.id}`", state.id)
            self.entries[number] = edge

    def _edge(self, source: int, transition: Transition, state: State) -> Edge:
        try:
            targets = tuple(map(self.numbers.__getitem__, transition.targets))
        except KeyError as missing:
            raise TableError(f"unknown state `{missing.args[0]}`", state.id) from None
        if len(targets) > 1 and not self.compatible(targets):
            names = " and ".join(f"`{target}`" for target in transition.targets)
            raise TableError(f"{names} cannot be active together", state.id)
        return Edge(source, targets, transition)

    def compatible(self, targets: Sequence[int]) -> bool:
        """Return True if states can be active together: they are in orthogonal regions."""
        # A history stands for states anywhere inside its parent.
        entered = [
            self.parents[each]
            if self.states[each].kind in (Kind.HISTORY, Kind.DEEP_HISTORY)
            else each
            for each in targets
        ]
        return all(self._side_by_side(one, other) for one, other in combinations(entered, 2))

    def _side_by_side(self, one: int, other: int) -> bool:
        if one == other or (self.inside[one] >> other | self.inside[other] >> one) & 1:
            return False
        meeting = next(a for a in (*self.ancestors(one), 0) if self.inside[a] >> other & 1)
        return self.states[meeting].kind is Kind.PARALLEL

    def called(self, transition: Transition) -> str:
        """Return the trace name of a transition: `A.B->0` is the first one of state `A.B`."""
        return self._called[id(transition)]

    @cached_property
    def _called(self) -> dict[int, str]:
        called = {}
        for state, parent in enumerate(self.parents):
            for number, each in enumerate(self.states[state].transitions):
                owner, at = (state, number) if each.around is None else (parent, each.around)
                called[id(each)] = f"{self.states[owner].id}->{at}"
        return called

    def ancestors(self, number: int) -> Iterator[int]:
        """Yield the ancestors of a state, innermost first, without the machine itself."""
        number = self.parents[number]
        while number:
            yield number
            number = self.parents[number]


def members(states: int) -> list[int]:
    """Return the numbers in a set of states, in document order."""
    found = []
    while states:
        lowest = states & -states
        found.append(lowest.bit_length() - 1)
        states ^= lowest
    return found
