"""Settling: a machine comes to a state in which it waits for something."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from swarmdsl.analysis.checks.context import Context
from swarmdsl.analysis.checks.guard_satisfiability import certain
from swarmdsl.analysis.resolve.states import regions
from swarmdsl.base.diagnostics.collector import Label
from swarmdsl.base.graphs import cycles
from swarmdsl.syntax.ast import (
    Activity,
    Branch,
    Choice,
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

# What leads on to another state without waiting.
Step = Transition | Branch | Initial | History


class Settling:
    """What a machine does without waiting for anything.

    `immediate` are by state the transitions that are taken as soon as it is entered, `circles`
    the steps that lead back to a state, and `endless` those of all circles.
    """

    def __init__(self, machine: StateMachine, context: Context) -> None:
        self._outline = outline = context.outline(machine)
        self._context = context
        self.immediate: dict[State | Parallel, list[Transition]] = {}
        for state, transitions in outline.transitions.items():
            found = [each for each in transitions if _immediate(each, state, context)]
            if found:
                self.immediate[state] = found
        self.circles: Sequence[tuple[Vertex, list[Step]]] = ()
        # Initial states lead inward only.
        others = [*nodes_of(machine, Choice), *nodes_of(machine, History)]
        if self.immediate or others:
            self.circles = list(cycles(outline.vertices, self._steps))
        self.endless = {step for _, steps in self.circles for step in steps}

    def _steps(self, vertex: Vertex) -> Iterator[tuple[Step, Vertex]]:
        """The steps that lead on from a state, and where to."""
        for step in self._steps_from(vertex):
            if step.target is not None and step.target.target is not None:
                yield step, step.target.target

    def _steps_from(self, vertex: Vertex) -> Iterator[Step]:
        match vertex:
            case Choice(branches=branches):
                yield from (branch for branch in branches if _certain(branch, self._context))
            case History(target=default) if isinstance(default.target, History):
                yield vertex
            case State() | Parallel():
                yield from self.immediate.get(vertex, ())
                for region in regions(vertex):
                    yield from self._outline.initials[region]
                if self._outline.inside[vertex]:
                    yield from self._outline.initials[vertex]


def check_settling(machine: StateMachine, settling: Settling, context: Context) -> None:
    """Report circles of steps that wait for nothing, and those that only guards may end."""
    for vertex, steps in settling.circles:
        help_ = "let one of the states on the way wait for something"
        _report("endless-steps", vertex, steps, help_, context)
    for state, transitions in settling.immediate.items():
        _check_stays(state, transitions, context)
    choices = nodes_of(machine, Choice)
    for choice, branches in cycles(choices, lambda choice: _branches(choice, context)):
        if any(not _certain(branch, context) for branch in branches):
            help_ = "lead through a state that waits for something"
            _report("choice-circle", choice, branches, help_, context)


def _check_stays(
    state: State | Parallel, transitions: Sequence[Transition], context: Context
) -> None:
    for transition in transitions:
        if transition.target is None:
            context.report.report(
                "endless-steps",
                transition.span,
                name=state.name,
                label="done again and again: the state is not left",
                help="let it lead to another state, or put the effects behind `entry /`",
            )


def _immediate(transition: Transition, state: State | Parallel, context: Context) -> bool:
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
