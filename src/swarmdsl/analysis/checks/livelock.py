"""Livelock: cycles of steps on which a state machine waits for no event."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from swarmdsl.analysis.checks.context import Context
from swarmdsl.analysis.checks.guard_satisfiability import guard_value
from swarmdsl.analysis.checks.state_hierarchy import StateHierarchy
from swarmdsl.analysis.resolve.states import regions
from swarmdsl.base.diagnostics.collector import Label
from swarmdsl.base.graphs import cycles
from swarmdsl.syntax.ast import (
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

# A step to another state that waits for no event.
Step = Transition | Branch | Initial | History


class EventlessSteps:
    """Steps of a machine that wait for no event.

    `immediate` are, by state, the transitions that are taken as soon as the state is entered,
    `cycles` the cycles of steps, each with a state on it, and `endless` the steps of all cycles.
    """

    def __init__(self, machine: StateMachine, context: Context) -> None:
        hierarchy = context.hierarchy(machine)
        self.immediate: dict[State | Parallel, list[Transition]] = {}
        for state, transitions in hierarchy.transitions.items():
            found = [each for each in transitions if _is_immediate(each, state, hierarchy, context)]
            if found:
                self.immediate[state] = found

        def successors(vertex: Vertex) -> Iterator[tuple[Step, Vertex]]:
            for step in self._steps_from(vertex, hierarchy, context):
                target = _target(step)
                if target is not None:
                    yield step, target

        self.cycles: Sequence[tuple[Vertex, list[Step]]] = ()
        # Initial states alone make no cycle: they lead inwards only.
        others = [*nodes_of(machine, Choice), *nodes_of(machine, History)]
        if self.immediate or others:
            self.cycles = list(cycles(hierarchy.vertices, successors))
        self.endless = {step for _, steps in self.cycles for step in steps}

    def _steps_from(
        self, vertex: Vertex, hierarchy: StateHierarchy, context: Context
    ) -> Iterator[Step]:
        match vertex:
            case Choice(branches=branches):
                yield from (branch for branch in branches if _is_always_taken(branch, context))
            case History(default=History()):
                yield vertex
            case State() | Parallel():
                yield from self.immediate.get(vertex, ())
                for region in regions(vertex):
                    yield from hierarchy.initials[region]
                if hierarchy.children[vertex]:
                    yield from hierarchy.initials[vertex]


def _target(step: Step) -> Vertex | None:
    if isinstance(step, History):
        return step.default
    return step.target.target if step.target is not None else None


def check_livelock(machine: StateMachine, context: Context) -> None:
    """Report cycles of steps that wait for no event, and cycles that only guards may end."""
    eventless = context.analysis(EventlessSteps, machine)
    for vertex, steps in eventless.cycles:
        help_ = "let one of the states in the cycle wait for an event"
        _report("endless-steps", vertex, steps, help_, context)
    for state, transitions in eventless.immediate.items():
        _check_internal(state, transitions, context)
    choices = nodes_of(machine, Choice)
    for choice, branches in cycles(choices, lambda choice: _branches(choice, context)):
        if any(not _is_always_taken(branch, context) for branch in branches):
            help_ = "lead through a state that waits for an event"
            _report("choice-circle", choice, branches, help_, context)


def _check_internal(
    state: State | Parallel, transitions: Sequence[Transition], context: Context
) -> None:
    """Report immediate transitions without a target: they are taken again and again."""
    for transition in transitions:
        if transition.target is None:
            context.report.report(
                "endless-steps",
                transition.span,
                name=state.name,
                label="repeated without end: the state is not left",
                help="let it lead to another state, or put the effects after `entry /`",
            )


def _is_immediate(
    transition: Transition, state: State | Parallel, hierarchy: StateHierarchy, context: Context
) -> bool:
    """Return True if a transition is always taken as soon as its state is entered."""
    triggers = transition.triggers
    at_entry = not triggers or any(completes_at_once(each, state, hierarchy) for each in triggers)
    return at_entry and guard_value(transition, context) is True


def completes_at_once(trigger: Trigger, state: State | Parallel, hierarchy: StateHierarchy) -> bool:
    """Return True for `done` of an idle state, which completes as soon as it is entered."""
    return isinstance(trigger, DoneTrigger) and trigger.region is None and state in hierarchy.idle


def _branches(choice: Choice, context: Context) -> Iterator[tuple[Branch, Choice]]:
    """Yield the branches to other choices; branches that are always taken come first."""
    for branch in sorted(choice.branches, key=lambda branch: not _is_always_taken(branch, context)):
        if isinstance(branch.target.target, Choice):
            yield branch, branch.target.target


def _is_always_taken(branch: Branch, context: Context) -> bool:
    return bool(branch.otherwise) or guard_value(branch, context) is True


def _report(name: str, at: Vertex, steps: Sequence[Step], help_: str, context: Context) -> None:
    *earlier, last = (step.target.span for step in steps if step.target is not None)
    context.report.report(
        name,
        last,
        name=at.name,
        related=tuple(Label(span, "through this transition") for span in earlier),
        help=help_,
    )
