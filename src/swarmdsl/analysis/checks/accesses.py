"""What the parts of a state machine read and write, in the order in which they do."""

from __future__ import annotations

from collections.abc import Iterator

from swarmdsl.base.records import dataclass
from swarmdsl.base.source import Span
from swarmdsl.syntax.ast import (
    Activity,
    Assignment,
    Effect,
    Entry,
    Exit,
    Expression,
    NameUse,
    Node,
    OutcomeTrigger,
    Parallel,
    ResultMapping,
    Send,
    State,
    StateMachine,
    TimeTrigger,
    Transition,
    Trigger,
    Value,
    Variable,
    Vertex,
    nodes_of,
    walk,
)


@dataclass(frozen=True, slots=True)
class Read:
    """A variable is read; `test` says that it is in a guard."""

    variable: Variable
    span: Span
    test: bool = False


@dataclass(frozen=True, slots=True)
class Write:
    """A variable, or a field of it, is written."""

    variable: Variable


Step = Read | Write


def stores_of(machine: StateMachine) -> list[Assignment | ResultMapping]:
    """What stores a value in a variable."""
    return [*nodes_of(machine, Assignment), *nodes_of(machine, ResultMapping)]


def while_active(vertex: Vertex) -> list[Step]:
    """What is read as soon as a state is entered: its goal, its params and its delays."""
    if not isinstance(vertex, (State, Parallel)):
        return []
    arguments = list(vertex.bindings) if isinstance(vertex, State) else []
    values: list[Expression] = []
    for item in vertex.items:
        match item:
            case Activity():
                arguments += item.arguments
            case Transition():
                values += [each.delay for each in item.triggers if isinstance(each, TimeTrigger)]
    values += [argument.value for argument in arguments]
    return [step for value in values for step in reads(value)]


def results(trigger: Trigger | None, state: State | Parallel) -> list[Step]:
    """What the end of an activity stores before its transition is looked at."""
    if not isinstance(trigger, OutcomeTrigger) or trigger.outcome != "succeeded":
        return []
    return [
        Write(variable)
        for item in state.items
        if isinstance(item, Activity)
        for result in item.results
        for variable in _variables(result.target.tree)
    ]


def on(kind: type[Entry] | type[Exit], state: State | Parallel) -> list[Step]:
    """What a state does when it is entered, or left."""
    return [
        step for item in state.items if isinstance(item, kind) for step in in_order(item.effects)
    ]


def in_order(effects: list[Effect]) -> list[Step]:
    """The steps of effects; a variable that is counted on from its own value starts as zero."""
    found: list[Step] = []
    for effect in effects:
        match effect:
            case Send(arguments=arguments):
                found += [step for argument in arguments for step in reads(argument.value)]
            case Assignment(target=target, value=value):
                stored = _variables(target.tree)
                found += [step for step in reads(value) if step.variable not in stored]
                found += [Write(variable) for variable in stored]
    return found


def reads(value: Expression | None, *, test: bool = False) -> Iterator[Read]:
    """What an expression reads."""
    if value is None or isinstance(value.tree, Value):
        return
    for use in walk(value):
        if isinstance(use, NameUse) and isinstance(use.target, Variable):
            yield Read(use.target, use.span, test)


def _variables(target: Node | None) -> list[Variable]:
    """The variable that an assignment stores in."""
    uses = walk(target) if target is not None else ()
    return [
        use.target for use in uses if isinstance(use, NameUse) and isinstance(use.target, Variable)
    ]
