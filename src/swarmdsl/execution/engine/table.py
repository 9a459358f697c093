"""State machines as plain data: what the engine runs.

A `Machine` is made of `State`s and `Transition`s, in the vocabulary of SCXML 1.0, and shared by
all its instances. What is done (guards, effects) are callables in it.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from enum import Enum
from functools import cached_property
from itertools import combinations
from typing import Any, Callable, NamedTuple, Protocol  # noqa: UP035 - for Python 3.8


class Origin(Protocol):
    """A delay or a run of an activity that sends an event to its own instance."""

    over: bool


class Event:
    """Name and data of something that happened; immutable.

    `origin` is the delay or activity of the instance that sent the event, if any.
    """

    __slots__ = ("data", "name", "origin")

    def __init__(self, name: str, data: Any = None, origin: Origin | None = None) -> None:
        self.name = name
        self.data = data
        self.origin = origin


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

    def holds(self, guard: Guard, event: Event) -> bool:
        """Return True if a guard holds."""

    def receive(self, event: Event) -> None:
        """Process an event from outside."""

    def raise_event(self, event: Event) -> None:
        """Append an event to the internal queue."""

    def send_after(self, event: Event, delay: int, id_: str = "") -> None:
        """Send an event to this instance after a delay in nanoseconds."""

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
"""Executable content, done as a whole: where it fails, the rest of it is not done."""


class Kind(Enum):
    """What a state is. Which of the first two it is does not matter where it has no children."""

    STATE = "state"
    PARALLEL = "parallel"
    FINAL = "final"
    HISTORY = "history"
    DEEP_HISTORY = "deep history"


class Transition(NamedTuple):
    """From the state that holds it to `targets`, ids; it leads nowhere without them.

    `events` are names of events, any of which triggers it: `a.b` itself, `a.b.*` also all that
    begin with `a.b.`, `*` all there are. Without events it is eventless.
    """

    events: tuple[str, ...] = ()
    targets: tuple[str, ...] = ()
    guard: Guard | None = None
    effect: Effect | None = None
    internal: bool = False
    origin: object = None
    """Where it comes from, for a person who reads a trace."""
    around: int | None = None
    """What a region does for the parallel state around it: which transition of that one it is."""


@dataclass(frozen=True, eq=False)
class Activity:
    """What a state does while it is active, on a server outside of the machine.

    `goal` makes the arguments when it starts. `finalize` sees the event of its success before
    any transition does: it stores the result. `events` are its outcomes and the names of the
    events that they are. `refused` is its outcome where a service responds, in a field `success`,
    that it has not done what was asked for.
    """

    name: str
    server: str
    events: Mapping[str, str]
    goal: Callable[[InstanceLike], Any] | None = None
    finalize: Effect | None = None
    refused: str = "aborted"


class State(NamedTuple):
    """A state and what is inside it.

    `initial` leads to what is entered with a state that has children: ids, or a transition with
    an effect of its own; the first child where there is none. A history has one transition, to
    its default. `donedata` makes the data of the event of a final state.
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


class TableError(ValueError):
    """A table that is no state machine; `id` is the state that is wrong."""

    def __init__(self, message: str, state: str) -> None:
        super().__init__(message)
        self.id = state


class Edge:
    """A transition with its states as numbers."""

    __slots__ = ("events", "guard", "source", "table", "targets")

    def __init__(self, source: int, targets: tuple[int, ...], table: Transition) -> None:
        self.source = source
        self.targets = targets
        self.table = table
        self.guard = table.guard
        self.events = table.events

    def matches(self, name: str) -> bool:
        """Whether an event of that name triggers it; the empty name stands for no event."""
        if not name or not self.events:
            return not name and not self.events
        return name in self.events or any(
            f"{name}.".startswith(event[:-1]) for event in self.events if event[-1] == "*"
        )


class Machine:
    """A state machine, to be run by any number of instances.

    States have numbers in document order, 0 is the machine itself; a set of states is a whole
    number, with the bit of each. `data` makes the data that an instance begins with, `setup` is
    done with them when it is started.

    `limit` is how many steps may follow from one event before it counts as a loop.

    Raises TableError where the states are no state machine.
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
    ) -> None:
        self.name = name
        self.data = data
        self.setup = setup
        self.limit = limit
        root = State("", Kind.STATE, tuple(states), initial)
        self.states: list[State] = []
        self.parents: list[int] = []
        self.inside: list[int] = []
        """All states inside each one."""
        self.children: list[list[int]] = []
        self.histories: list[list[int]] = []
        self.numbers: dict[str, int] = {}
        self._add(root, 0)
        self.entries: list[Edge | None] = [None] * len(self.states)
        """The initial transition of each state with children, the default one of each history."""
        self.edges: list[tuple[Edge, ...]] = [()] * len(self.states)
        self.eventless = 0
        """The states with a transition that waits for no event."""
        for number, state in enumerate(self.states):
            self._link(number, state)
        self.blank = (0,) * sum(map(len, self.histories))
        """What the histories of an instance hold at first: nothing."""
        self.configurations: dict[tuple[int, tuple[int, ...]], Any] = {}
        """Cache of `configuration.Configuration`, by active states and histories."""
        self.cached = 0
        """Number of decisions and steps in the cache."""

    def _add(self, state: State, parent: int) -> None:
        number = len(self.states)
        if state.id in self.numbers:
            raise TableError(f"two states are called `{state.id}`", state.id)
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
                raise TableError(f"history `{state.id}` needs one transition", state.id)
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
            raise TableError(f"there is no state `{missing.args[0]}`", state.id) from None
        if len(targets) > 1 and not self.compatible(targets):
            names = " and ".join(f"`{target}`" for target in transition.targets)
            raise TableError(f"{names} cannot be active together", state.id)
        return Edge(source, targets, transition)

    def compatible(self, targets: Sequence[int]) -> bool:
        """Whether states can be entered together: each two are in regions side by side."""
        # A history stands for what it leads to, which is anywhere in the state around it.
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
        """What a trace calls a transition: `A.B->0` is the first of state `A.B`."""
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
        """The states around one, from the inside out, the machine itself left out."""
        number = self.parents[number]
        while number:
            yield number
            number = self.parents[number]


def members(states: int) -> list[int]:
    """The numbers in a set of states, in document order."""
    found = []
    while states:
        lowest = states & -states
        found.append(lowest.bit_length() - 1)
        states ^= lowest
    return found
