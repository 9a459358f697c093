"""Settling: a machine comes to a state in which it waits for something."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from swarmdsl.diagnostics import Label
from swarmdsl.graph import cycles
from swarmdsl.link_machines import regions, vertices
from swarmdsl.syntax import (
    Activity,
    Branch,
    Choice,
    Container,
    DoneTrigger,
    History,
    Initial,
    Parallel,
    State,
    StateMachine,
    Transition,
    Trigger,
    Vertex,
    nodes_of,
)
from swarmdsl.validate.conditions import certain
from swarmdsl.validate.context import Context

# What leads on to another state without waiting.
Step = Transition | Branch | Initial | History
# Each by a state on it and the steps from there.
Circles = Sequence[tuple[Vertex, list[Step]]]


def check_settling(machine: StateMachine, circles: Circles, context: Context) -> None:
    """Report circles of steps that wait for nothing, and those that only guards may end."""
    for state, steps in circles:
        help_ = "let one of the states on the way wait for something"
        _report("endless-steps", state, steps, help_, context)
    for state in context.outline(machine).states:
        _check_stays(state, context)
    choices = nodes_of(machine, Choice)
    for choice, branches in cycles(choices, lambda choice: _branches(choice, context)):
        if any(not _certain(branch, context) for branch in branches):
            help_ = "lead through a state that waits for something"
            _report("choice-circle", choice, branches, help_, context)


def _check_stays(state: State | Parallel, context: Context) -> None:
    for transition in transitions_of(state):
        if transition.target is None and immediate(transition, state, context):
            context.report.report(
                "endless-steps",
                transition.span,
                name=state.name,
                label="done again and again: the state is not left",
                help="let it lead to another state, or put the effects behind `entry /`",
            )


def endless(circles: Circles) -> set[Step]:
    """The steps of all circles in which nothing is waited for."""
    return {step for _, steps in circles for step in steps}


def immediate(transition: Transition, state: State | Parallel, context: Context) -> bool:
    """Whether a transition is taken as soon as its state is entered, whatever happens."""
    triggers = transition.triggers
    at_entry = not triggers or any(at_once(trigger, state) for trigger in triggers)
    return at_entry and certain(transition, context) is True


def at_once(trigger: Trigger, state: State | Parallel) -> bool:
    """Whether it is the completion of a state that does nothing and has nothing in it."""
    return isinstance(trigger, DoneTrigger) and trigger.region is None and is_idle(state)


def is_idle(state: State | Parallel) -> bool:
    """Whether a state does nothing and has nothing in it."""
    return (
        isinstance(state, State)
        and state.machine is None
        and not any(isinstance(item, (Activity, Vertex)) for item in state.items)
    )


def transitions_of(state: State | Parallel) -> list[Transition]:
    """The transitions that a state holds."""
    return [item for item in state.items if isinstance(item, Transition)]


def circles_of(machine: StateMachine, context: Context) -> Circles:
    """The circles of steps in which nothing is waited for."""

    def steps(vertex: Vertex) -> Iterator[tuple[Step, Vertex]]:
        for step in _steps(vertex, context):
            if step.target is not None and step.target.target is not None:
                yield step, step.target.target

    return list(cycles(context.outline(machine).vertices, steps))


def _steps(vertex: Vertex, context: Context) -> Iterator[Step]:
    match vertex:
        case Choice(branches=branches):
            yield from (branch for branch in branches if _certain(branch, context))
        case History(target=default) if isinstance(default.target, History):
            yield vertex
        case State() | Parallel():
            yield from (t for t in transitions_of(vertex) if immediate(t, vertex, context))
            containers: list[Container] = [*regions(vertex)]
            if isinstance(vertex, State) and any(vertices(vertex)):
                containers.append(vertex)
            for container in containers:
                yield from (item for item in container.items if isinstance(item, Initial))


def _branches(choice: Choice, context: Context) -> Iterator[tuple[Branch, Choice]]:
    """The branches that lead to choices; those first that are part of endless circles."""
    for branch in sorted(choice.branches, key=lambda branch: not _certain(branch, context)):
        if isinstance(branch.target.target, Choice):
            yield branch, branch.target.target


def _certain(branch: Branch, context: Context) -> bool:
    return bool(branch.otherwise) or certain(branch, context) is True


def _report(name: str, at: Vertex, steps: Sequence[Step], help_: str, context: Context) -> None:
    *way, last = (step.target.span for step in steps if step.target is not None)
    context.report.report(
        name,
        last,
        name=at.name,
        related=tuple(Label(span, "by way of this transition") for span in way),
        help=help_,
    )
