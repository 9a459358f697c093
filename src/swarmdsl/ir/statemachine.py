"""State machines in SCXML's vocabulary, all references by id.

A state's `id` is its path in the machine (`Flying.TakeOff`), unique there. Submachines
are expanded: a state that reuses another machine is a composite state with `submachine`.
"""

from __future__ import annotations

from collections.abc import Iterator
from enum import Enum

from swarmdsl.base.records import dataclass
from swarmdsl.base.records import field as dataclass_field
from swarmdsl.base.source import Span
from swarmdsl.ir.docs import Docs
from swarmdsl.ir.expressions import Expression
from swarmdsl.ir.interfaces import Param
from swarmdsl.syntax.types import Type


class StateKind(Enum):
    """Kind of a state; a region is a composite state inside a parallel one."""

    SIMPLE = "simple"
    COMPOSITE = "composite"
    PARALLEL = "parallel"
    REGION = "region"
    FINAL = "final"
    CHOICE = "choice"
    HISTORY = "history"


@dataclass(frozen=True, slots=True)
class EventTrigger:
    """Event of the system, by name; heartbeats raise a `predefined` one."""

    event: str
    origin: Span | None = dataclass_field(default=None, compare=False, repr=False)
    predefined: bool = dataclass_field(default=False, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class OutcomeTrigger:
    """Activity of `state` ended with `outcome` (succeeded, aborted, preempted)."""

    state: str
    outcome: str
    origin: Span | None = dataclass_field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class DoneTrigger:
    """State `state` is complete: in final state `final`, or in any when None.

    For a parallel state: all its regions are.
    """

    state: str
    final: str | None
    origin: Span | None = dataclass_field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class TimeTrigger:
    """The state has been active for `delay`, a duration."""

    delay: Expression
    origin: Span | None = dataclass_field(default=None, compare=False, repr=False)


Trigger = EventTrigger | OutcomeTrigger | DoneTrigger | TimeTrigger


@dataclass(frozen=True, slots=True)
class Assignment:
    """Assignment to a variable or to a field of one (`path` below it)."""

    variable: str
    path: tuple[str, ...]
    value: Expression
    origin: Span | None = dataclass_field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Address:
    """Receivers of a swarm event: a role, one robot of it, or what `id` has as its value.

    The value is the id of a robot, or a role. A role of a machine that several swarms run may
    be in any of them.
    """

    role: str = ""
    index: Expression | None = None
    id: Expression | None = None
    origin: Span | None = dataclass_field(default=None, compare=False, repr=False)

    @property
    def values(self) -> tuple[Expression, ...]:
        """The expressions in it."""
        return tuple(each for each in (self.index, self.id) if each is not None)


@dataclass(frozen=True, slots=True)
class Send:
    """Sending of an event with fields of its message; others keep their defaults.

    Without an address, a swarm event is for all other robots. With a delay, a duration, it is
    sent later, with the values and the address of now.
    """

    event: str
    arguments: tuple[tuple[str, Expression], ...]
    to: Address | None = None
    delay: Expression | None = None
    origin: Span | None = dataclass_field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Cancel:
    """Cancellation of the delayed sends of an event that are pending."""

    event: str
    origin: Span | None = dataclass_field(default=None, compare=False, repr=False)


Effect = Assignment | Send | Cancel


@dataclass(frozen=True, slots=True)
class Transition:
    """Transition from the state that holds it to `target`, an id; None to stay.

    Without triggers it is taken as soon as its guard holds: a branch of a choice, the
    default of a history (both without a guard as well), or an eventless transition.
    An internal one does not leave the state that holds it.
    """

    triggers: tuple[Trigger, ...]
    guard: Expression | None
    effects: tuple[Effect, ...]
    target: str | None
    internal: bool = False
    doc: str = ""
    origin: Span | None = dataclass_field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class ResultMapping:
    """Store of field `field` of the result in a variable or in a field of one."""

    field: str
    variable: str
    path: tuple[str, ...]
    origin: Span | None = dataclass_field(default=None, compare=False, repr=False)


class Policy(Enum):
    """Source of the content of a goal, request, result or response (D5.4, 5.2)."""

    EMPTY = "empty"
    FIXED = "fixed"
    USERDATA = "userdata"
    CALLBACK = "callback"


@dataclass(frozen=True, slots=True)
class Activity:
    """Call of a function while the state is active.

    `arguments` fill the goal or request by field name, `results` store fields of the
    result or response; a callback does either in code of the user.
    """

    function: str
    arguments: tuple[tuple[str, Expression], ...] = ()
    goal_callback: str | None = None
    results: tuple[ResultMapping, ...] = ()
    result_callback: str | None = None
    doc: str = ""
    origin: Span | None = dataclass_field(default=None, compare=False, repr=False)

    @property
    def judges_response(self) -> bool:
        """True if the model itself reads field `success` of a response.

        Otherwise a service whose response says that it failed counts as aborted.
        """
        return any(result.field == "success" for result in self.results)


@dataclass(frozen=True, slots=True)
class State:
    """Vertex of the machine, with its content.

    `initial` is the id of the child entered first (composite state, region). While the state is
    active, the events of `deferred` are kept, unless it or a state inside it handles them.
    `submachine` names the machine that is expanded here. `deep` is for a history.
    """

    id: str
    name: str
    kind: StateKind
    initial: str | None = None
    states: tuple[State, ...] = ()
    transitions: tuple[Transition, ...] = ()
    activity: Activity | None = None
    entry: tuple[Effect, ...] = ()
    exit: tuple[Effect, ...] = ()
    deferred: tuple[EventTrigger, ...] = ()
    submachine: str | None = None
    deep: bool = False
    doc: str = ""
    docs: Docs = ()
    origin: Span | None = dataclass_field(default=None, compare=False, repr=False)

    def walk(self) -> Iterator[State]:
        """Yield the state and all inside it, in document order."""
        yield self
        for child in self.states:
            yield from child.walk()


@dataclass(frozen=True, slots=True)
class Variable:
    """Data of a running machine; `initial` None means the type's default.

    `name` is unique in the machine. A variable of a state, or of a machine that a state reuses, has
    the id of that state as `owner`, and its name in the model as `local`.
    """

    name: str
    type: Type
    initial: Expression | None
    doc: str = ""
    origin: Span | None = dataclass_field(default=None, compare=False, repr=False)
    owner: str = dataclass_field(default="", compare=False, repr=False)
    local: str = dataclass_field(default="", compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class StateMachine:
    """Behaviour. `initial` is the id of the state entered first."""

    name: str
    initial: str
    states: tuple[State, ...]
    variables: tuple[Variable, ...] = ()
    params: tuple[Param, ...] = ()
    endless: bool = False
    doc: str = ""
    docs: Docs = ()
    origin: Span | None = dataclass_field(default=None, compare=False, repr=False)

    def walk(self) -> Iterator[State]:
        """Yield all states in document order."""
        for state in self.states:
            yield from state.walk()
