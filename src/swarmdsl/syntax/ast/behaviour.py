"""Nodes of behaviour.tx: state machines."""

from __future__ import annotations

from swarmdsl.base.records import dataclass, field
from swarmdsl.base.source import Span
from swarmdsl.syntax.ast.interfaces import Event, Function, Operation
from swarmdsl.syntax.ast.nodes import Documented, Node, Ref, TopLevel, TypeRef, Word
from swarmdsl.syntax.ast.values import (
    Argument,
    Expression,
    ExpressionTree,
    IndexUse,
    NameUse,
    Param,
    Variable,
)


@dataclass(slots=True, eq=False)
class ResultMapping(Node):
    """`field => variable`."""

    field: Word
    target: Expression


@dataclass(slots=True, eq=False)
class Activity(Documented):
    """`do function(...) gives (...)`.

    `owner` is the component or part that provides an operation; only the linker sets it.
    """

    function: Ref[Function | Operation]
    goal_callback: Word | None
    arguments: list[Argument]
    result_callback: Word | None
    results: list[ResultMapping]
    owner: Documented | None = field(default=None, init=False, metadata={"elsewhere": True})


@dataclass(slots=True, eq=False)
class OutcomeTrigger(Node):
    """`succeeded`, `aborted` or `preempted`."""

    outcome: str


@dataclass(slots=True, eq=False)
class DoneTrigger(Node):
    """`done`, `done.Final`, `Region.done` or `Region.done.Final`."""

    region: Ref[Region] | None
    final: Ref[FinalState] | None


@dataclass(slots=True, eq=False)
class EventTrigger(Node):
    """The name of an event."""

    event: Ref[Event]


@dataclass(slots=True, eq=False)
class TimeTrigger(Node):
    """`after delay`."""

    delay: Expression


@dataclass(slots=True, eq=False)
class MonitorTrigger(Node):
    """`monitor "topic" : Type` or `monitor "topic" : Type as Name`."""

    topic: Word
    type: TypeRef
    name: Word | None


Trigger = OutcomeTrigger | DoneTrigger | EventTrigger | TimeTrigger | MonitorTrigger


@dataclass(slots=True, eq=False)
class Address(Node):
    """`role`, `role[index]`, or a value that is the id of a robot or a role."""

    id: Expression

    @property
    def role_use(self) -> NameUse | None:
        """The name of the role; None for an address that is a value."""
        tree = self.id.tree
        base = tree.base if isinstance(tree, IndexUse) else tree
        if isinstance(base, NameUse) and base.target is None and not base.is_predefined:
            return base
        return None

    @property
    def named_role(self) -> tuple[str, Span] | None:
        """The name of the role and its place; None for an address that is a value."""
        use = self.role_use
        return (use.name, use.span) if use is not None else None

    @property
    def index(self) -> ExpressionTree | None:
        """The number of a robot in its role; None for all of them, and for a value."""
        tree = self.id.tree
        return tree.index if isinstance(tree, IndexUse) and self.role_use is not None else None


@dataclass(slots=True, eq=False)
class Send(Node):
    """`send Event(...)`, `send Event(...) to address`, either with `after delay`."""

    event: Ref[Event]
    arguments: list[Argument]
    to: Address | None
    delay: Expression | None


@dataclass(slots=True, eq=False)
class Cancel(Node):
    """`cancel Event`."""

    event: Ref[Event]


@dataclass(slots=True, eq=False)
class Assignment(Node):
    """`target = value`."""

    target: Expression
    value: Expression


@dataclass(slots=True, eq=False)
class Append(Node):
    """`append value to target`."""

    value: Expression
    target: Expression


@dataclass(slots=True, eq=False)
class Remove(Node):
    """`remove target`, an item of an array."""

    target: Expression


@dataclass(slots=True, eq=False)
class Clear(Node):
    """`clear target`."""

    target: Expression


Store = Assignment | Append | Remove | Clear
Effect = Send | Cancel | Store


@dataclass(slots=True, eq=False)
class Transition(Documented):
    """`on trigger [guard] / effects -> target`; what is not written is None or empty."""

    internal: bool
    triggers: list[Trigger]
    guard: Expression | None
    effects: list[Effect]
    target: Ref[Vertex] | None


@dataclass(slots=True, eq=False)
class DeferredEvent(Node):
    """The name of an event in `defer`."""

    event: Ref[Event]


@dataclass(slots=True, eq=False)
class Defer(Documented):
    """`defer Event, ...`."""

    events: list[DeferredEvent]


@dataclass(slots=True, eq=False)
class Entry(Documented):
    """`entry / effects`."""

    effects: list[Effect]


@dataclass(slots=True, eq=False)
class Exit(Documented):
    """`exit / effects`."""

    effects: list[Effect]


@dataclass(slots=True, eq=False)
class Initial(Documented):
    """`initial State`."""

    target: Ref[Vertex]


@dataclass(slots=True, eq=False)
class FinalState(Documented):
    """`final Name`."""

    name: Word


@dataclass(slots=True, eq=False)
class Branch(Documented):
    """`[guard] / effects -> target` or `else ... -> target` in a choice.

    `otherwise` is the word `else`, or empty.
    """

    guard: Expression | None
    otherwise: str
    effects: list[Effect]
    target: Ref[Vertex]


@dataclass(slots=True, eq=False)
class Choice(Documented):
    """`choice Name { ... }`."""

    name: Word
    branches: list[Branch]


@dataclass(slots=True, eq=False)
class State(Documented):
    """`state Name { ... }` or `state Name = Machine(param = value) { ... }`."""

    name: Word
    machine: Ref[StateMachine] | None
    bindings: list[Argument]
    items: list[Variable | Activity | Defer | Entry | Exit | Transition | Initial | Vertex]


@dataclass(slots=True, eq=False)
class Region(Documented):
    """`region Name { ... }`."""

    name: Word
    items: list[Variable | Initial | Vertex]


@dataclass(slots=True, eq=False)
class Parallel(Documented):
    """`parallel state Name { ... }`."""

    name: Word
    items: list[Variable | Region | Defer | Entry | Exit | Transition]


@dataclass(slots=True, eq=False)
class StateMachine(TopLevel):
    """`statemachine Name { ... }`."""

    endless: bool
    name: Word
    items: list[Param | Variable | Initial | Vertex]


@dataclass(slots=True, eq=False)
class History(Documented):
    """`history Name`, `history Name -> target`, or either after `deep`.

    `initial` is the target of `initial` beside a history without a target; only the linker sets it.
    """

    deep: bool
    name: Word
    target: Ref[Vertex] | None
    initial: Ref[Vertex] | None = field(default=None, init=False, metadata={"elsewhere": True})

    @property
    def default(self) -> Vertex | None:
        """The state to enter if there is nothing to restore; None if it is not known."""
        ref = self.target or self.initial
        return ref.target if ref is not None else None


Vertex = State | Parallel | Choice | History | FinalState
Container = StateMachine | State | Parallel | Region
