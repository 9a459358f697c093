"""Checks of transitions: triggers, outcomes of activities, targets."""

from __future__ import annotations

from collections.abc import Sequence

from swarmdsl.analysis.checks.context import Context
from swarmdsl.analysis.checks.state_hierarchy import StateHierarchy
from swarmdsl.analysis.checks.structure import completes
from swarmdsl.analysis.node_kinds import kind_name
from swarmdsl.analysis.resolve.states import regions
from swarmdsl.base.diagnostics.advice import Advice
from swarmdsl.base.diagnostics.collector import Label, listed
from swarmdsl.syntax.ast import (
    Activity,
    Branch,
    Choice,
    Communication,
    DoneTrigger,
    EventTrigger,
    Function,
    OutcomeTrigger,
    Parallel,
    Region,
    State,
    StateMachine,
    Transition,
    Trigger,
    Vertex,
    nodes_of,
)


def check_transitions(machine: StateMachine, context: Context) -> None:
    """Check the transitions of all states of a machine."""
    for state, transitions in context.hierarchy(machine).transitions.items():
        for transition in transitions:
            for trigger in transition.triggers:
                _check_trigger(trigger, state, context)
        if isinstance(state, State):
            _check_outcomes(state, transitions, context)
            _check_preempted(state, transitions, context)
    _check_targets(machine, context)


def _check_trigger(trigger: Trigger, owner: State | Parallel, context: Context) -> None:
    match trigger:
        case OutcomeTrigger(outcome=outcome):
            if not _activities(owner):
                context.report.report(
                    "outcome-without-activity",
                    trigger.span,
                    state=owner.name,
                    outcome=outcome,
                    help=Advice(
                        "add `do function` to the state, or wait for `done`", "propose", "done"
                    ),
                )
        case DoneTrigger(region=region, final=final):
            of = region.target if region is not None else owner
            if of is not None and (final is None or final.target is not None):
                _check_completes(trigger, of, context)


def _check_completes(trigger: DoneTrigger, of: State | Parallel | Region, context: Context) -> None:
    """Check that the state of a `done` trigger can complete."""
    simple = isinstance(of, State) and of.machine is None and not _has_states(of)
    if simple and not _activities(of) and trigger.final is None:
        return  # an idle state completes at once
    if not simple and completes(of, context):
        return
    help_: str = Advice("add a final state to it", "insert", "final Done", of.name.span)
    related = [Label(of.name.span, "declared here")]
    if isinstance(of, Parallel):
        help_ = "a parallel state is done when each of its regions has reached a final state"
        endless = [region for region in regions(of) if not completes(region, context)]
        related = [Label(region.name.span, "this region has no final state") for region in endless]
    elif isinstance(of, State) and of.machine is not None:
        help_ = f"state machine `{of.machine.name}` has no final state"
    elif simple:
        help_ = "`succeeded` and `aborted` are the outcomes of an activity"
    context.report.report(
        "done-without-content",
        trigger.span,
        owner=f"{kind_name(of)} `{of.name}`",
        related=tuple(related),
        help=help_,
    )


def _check_outcomes(state: State, transitions: Sequence[Transition], context: Context) -> None:
    """Check that each outcome of an activity has a transition without a guard."""
    unhandled: list[str] = []
    guarded: list[Transition] = []
    for outcome in ("succeeded", "aborted"):
        handled = [
            transition
            for transition in transitions
            for trigger in transition.triggers
            if isinstance(trigger, OutcomeTrigger) and trigger.outcome == outcome
        ]
        if all(transition.guard is not None for transition in handled) and not any(
            _means_outcome(trigger, outcome) for each in transitions for trigger in each.triggers
        ):
            unhandled.append(outcome)
            guarded += handled
    # A state with two kinds of content is reported first.
    if not unhandled or state.machine is not None or _has_states(state):
        return
    for activity in _activities(state)[:1]:
        if activity.function.target is None:
            return
        context.report.report(
            "unhandled-outcome",
            activity.function.span,
            outcomes=f"outcome{'s' * (len(unhandled) - 1)} {listed(unhandled, 'and')}",
            function=activity.function.name,
            related=tuple(
                Label(transition.span, "only while its guard holds") for transition in guarded
            ),
            help=Advice(
                f"add {listed([f'on {outcome} -> ...' for outcome in unhandled], 'and')} "
                f"to state `{state.name}`",
                "add outcomes",
                *unhandled,
            ),
        )


def _means_outcome(trigger: Trigger, outcome: str) -> bool:
    """Return True for an unknown event, reported already, whose name is nearly an outcome."""
    if not isinstance(trigger, EventTrigger) or trigger.event.target is not None:
        return False
    from swarmdsl.analysis.resolve.hints import misspelled_outcome, other_outcome

    name = trigger.event.name
    return outcome in (other_outcome(name), misspelled_outcome(name))


def _check_preempted(state: State, transitions: Sequence[Transition], context: Context) -> None:
    """Report `preempted` of a service call: neither side can cancel a request."""
    calls = [call for each in _activities(state) if (call := _call_of(each)) is not None]
    if not calls or calls[0].paradigm != "service":
        return
    for transition in transitions:
        if transition.triggers and all(
            isinstance(trigger, OutcomeTrigger) and trigger.outcome == "preempted"
            for trigger in transition.triggers
        ):
            context.report.report(
                "transition-never-fires",
                transition.span,
                related=(Label(calls[0].span, "a service ends as `succeeded` or `aborted`"),),
                help=Advice(
                    "remove it: only the call of an action can be preempted", "remove transition"
                ),
            )


def _call_of(activity: Activity) -> Communication | None:
    """Communication of the called function; None for an unknown one or an operation."""
    function = activity.function.target
    items = function.items if isinstance(function, Function) else ()
    return next((item for item in items if isinstance(item, Communication)), None)


def _check_targets(machine: StateMachine, context: Context) -> None:
    """Check that no transition leads into another region of the same parallel state."""
    if not nodes_of(machine, Parallel):
        return
    hierarchy = context.hierarchy(machine)
    arrows: list[tuple[Vertex, Transition | Branch]] = [
        (state, transition) for state, all_ in hierarchy.transitions.items() for transition in all_
    ]
    choices = nodes_of(machine, Choice)
    arrows += [(choice, branch) for choice in choices for branch in choice.branches]
    for source, arrow in arrows:
        target = arrow.target.target if arrow.target is not None else None
        if arrow.target is None or target is None:
            continue
        pairs = zip(
            _regions_around(source, hierarchy), _regions_around(target, hierarchy), strict=False
        )
        for here, there in pairs:
            if here is not there and hierarchy.parent[here] is hierarchy.parent[there]:
                context.report.report(
                    "target-outside",
                    arrow.target.span,
                    target=arrow.target.name,
                    reason=f"it is in region `{there.name}`, the transition in `{here.name}`",
                    related=(Label(target.name.span, "declared here"),),
                )


def _regions_around(vertex: Vertex, hierarchy: StateHierarchy) -> list[Region]:
    """Regions around a state, the outermost first."""
    return [each for each in hierarchy.ancestors(vertex) if isinstance(each, Region)][::-1]


def _activities(state: State | Parallel | Region) -> list[Activity]:
    return [item for item in state.items if isinstance(item, Activity)]


def _has_states(state: State) -> bool:
    return any(isinstance(item, Vertex) for item in state.items)
