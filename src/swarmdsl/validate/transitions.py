"""Transitions: what triggers them, whether they can fire, where they may lead."""

from __future__ import annotations

from collections.abc import Hashable, Iterator

from swarmdsl.diagnostics import Label, listed
from swarmdsl.expressions import UNITS
from swarmdsl.graph import cycles
from swarmdsl.link_machines import regions
from swarmdsl.scopes import bare, kind_of
from swarmdsl.source import Span
from swarmdsl.syntax import (
    Activity,
    Branch,
    Choice,
    Container,
    DoneTrigger,
    EventTrigger,
    MonitorTrigger,
    OutcomeTrigger,
    Parallel,
    Ref,
    Region,
    State,
    StateMachine,
    TimeTrigger,
    Transition,
    Trigger,
    Value,
    Vertex,
    walk,
)
from swarmdsl.topics import awaited, heard_on
from swarmdsl.validate.context import Context
from swarmdsl.validate.structure import completes


def check_transitions(machine: StateMachine, context: Context) -> None:
    """Check the transitions of all states of a machine."""
    for node in walk(machine):
        match node:
            case State() | Parallel():
                transitions = [item for item in node.items if isinstance(item, Transition)]
                _check_shadowed(transitions, context)
                for transition in transitions:
                    for trigger in transition.triggers:
                        _check_trigger(trigger, node, context)
                if isinstance(node, State):
                    _check_outcomes(node, transitions, context)
            case Choice():
                _check_branches(node, context)
    _check_targets(machine, context)
    _check_endless_steps(machine, context)


def _check_trigger(trigger: Trigger, owner: State | Parallel, context: Context) -> None:
    match trigger:
        case OutcomeTrigger(outcome=outcome):
            if not _activities(owner):
                context.report.report(
                    "outcome-without-activity",
                    trigger.span,
                    state=owner.name,
                    outcome=outcome,
                    help="add `do function` to the state, or wait for `done`",
                )
        case DoneTrigger(region=region):
            of = region.target if region is not None else owner
            if of is not None:
                _check_completes(trigger, of, context)


def _check_completes(trigger: DoneTrigger, of: State | Parallel | Region, context: Context) -> None:
    """A state without content is never done, nor is content without a final state."""
    simple = isinstance(of, State) and of.machine is None and not _has_states(of)
    if simple and not _activities(of) and trigger.final is None:
        return  # a state that does nothing is done at once
    if not simple and completes(of, context):
        return
    help_ = "add a final state to it"
    if isinstance(of, Parallel):
        help_ = "a parallel state is done when each of its regions has reached a final state"
    elif isinstance(of, State) and of.machine is not None:
        help_ = f"state machine `{of.machine.name}` has no final state"
    elif simple:
        help_ = "`succeeded` and `aborted` are the ends of an activity"
    context.report.report(
        "done-without-content",
        trigger.span,
        owner=f"{bare(kind_of(of))} `{of.name}`",
        related=(Label(of.name.span, "declared here"),),
        help=help_,
    )


def _check_outcomes(state: State, transitions: list[Transition], context: Context) -> None:
    """Each end of the activity needs a transition that is taken without condition."""
    unhandled: list[str] = []
    guarded: list[Transition] = []
    for outcome in ("succeeded", "aborted"):
        handled = [
            transition
            for transition in transitions
            for trigger in transition.triggers
            if isinstance(trigger, OutcomeTrigger) and trigger.outcome == outcome
        ]
        if all(transition.guard is not None for transition in handled):
            unhandled.append(outcome)
            guarded += handled
    # Which of its contents a state keeps is to be decided first.
    if not unhandled or state.machine is not None or _has_states(state):
        return
    for activity in _activities(state)[:1]:
        context.report.report(
            "unhandled-outcome",
            activity.function.span,
            outcomes=f"outcome{'s' * (len(unhandled) - 1)} {listed(unhandled, 'and')}",
            function=activity.function.name,
            related=tuple(
                Label(transition.span, "only while its guard holds") for transition in guarded
            ),
            help=f"add {listed([f'on {outcome} -> ...' for outcome in unhandled], 'and')} "
            f"to state `{state.name}`",
        )


def _check_shadowed(transitions: list[Transition], context: Context) -> None:
    """A transition without guard takes all that its triggers bring from those after it."""
    taken: dict[Hashable, Transition] = {}
    earliest: tuple[float, Transition] | None = None
    for transition in transitions:
        blockers = []
        for trigger in transition.triggers:
            delay = _constant_delay(trigger)
            if delay is not None and earliest is not None and earliest[0] <= delay:
                blockers.append(earliest[1])
            else:
                blockers += [taken[key] for key in _keys(trigger) if key in taken][:1]
        if transition.triggers and len(blockers) == len(transition.triggers):
            advice = "give the first one a guard, or remove one of the two"
            _report_shadowed(transition.span, blockers[0].span, advice, context)
        elif transition.guard is None:
            for trigger in transition.triggers:
                for key in _keys(trigger)[:1]:
                    taken.setdefault(key, transition)
                delay = _constant_delay(trigger)
                if delay is not None and (earliest is None or delay < earliest[0]):
                    earliest = (delay, transition)


def _check_branches(choice: Choice, context: Context) -> None:
    last = None
    for branch in choice.branches:
        if last is not None:
            _report_shadowed(branch.span, last.span, "`else` comes last", context)
        elif branch.otherwise:
            last = branch


def _report_shadowed(span: Span, blocker: Span, advice: str, context: Context) -> None:
    context.report.report(
        "transition-never-fires",
        span,
        related=(Label(blocker, "this one is always taken first"),),
        help=advice,
    )


def _keys(trigger: Trigger) -> list[Hashable]:
    """What a trigger reacts to, first itself, then the more general triggers that cover it."""
    match trigger:
        case EventTrigger() | MonitorTrigger():
            event = awaited(trigger)
            return [("event", heard_on(event), event.type.type)] if event is not None else []
        case OutcomeTrigger(outcome=outcome):
            return [("outcome", outcome)]
        case DoneTrigger(region=region, final=final):
            whole = ("done", region.name if region else None, None)
            return [whole] if final is None else [(*whole[:2], final.name), whole]
        case TimeTrigger(delay=delay):
            return [("after", delay.span.text)]


def _constant_delay(trigger: Trigger) -> float | None:
    if isinstance(trigger, TimeTrigger) and isinstance(trigger.delay.tree, Value):
        value = trigger.delay.tree
        if isinstance(value.value, (int, float)):
            return value.value * UNITS.get(value.unit, 1)
    return None


def _check_endless_steps(machine: StateMachine, context: Context) -> None:
    """No circle of choices and of states that are left at once: it would never end."""

    def steps(state: Vertex) -> Iterator[tuple[Ref[Vertex], Vertex]]:
        match state:
            case Choice(branches=branches):
                refs = [branch.target for branch in branches if branch.otherwise]
            case State(items=items, machine=None) if not (_activities(state) or _has_states(state)):
                refs = [
                    item.target
                    for item in items
                    if isinstance(item, Transition)
                    and item.target is not None
                    and item.guard is None
                    and any(isinstance(t, DoneTrigger) for t in item.triggers)
                ]
            case _:
                refs = []
        for ref in refs:
            if ref.target is not None:
                yield ref, ref.target

    states = [node for node in walk(machine) if isinstance(node, Vertex)]
    for state, refs in cycles(states, steps):
        *way, last = refs
        context.report.report(
            "endless-steps",
            last.span,
            name=state.name,
            related=tuple(Label(ref.span, "by way of this transition") for ref in way),
            help="let one of the states on the way wait for something",
        )


def _check_targets(machine: StateMachine, context: Context) -> None:
    """A transition cannot lead from one region into another of the same parallel state."""
    homes: dict[Vertex, tuple[Region, ...]] = {}
    arrows: list[tuple[Transition | Branch, tuple[Region, ...]]] = []

    def visit(container: Container, inside: tuple[Region, ...]) -> None:
        for item in container.items:
            match item:
                case Region():
                    visit(item, (*inside, item))
                case State() | Parallel():
                    homes[item] = inside
                    visit(item, inside)
                case Transition():
                    arrows.append((item, inside))
                case Choice():
                    homes[item] = inside
                    arrows.extend((branch, inside) for branch in item.branches)
                case _ if isinstance(item, Vertex):
                    homes[item] = inside

    visit(machine, ())
    siblings = {
        region: parallel
        for parallel in walk(machine)
        if isinstance(parallel, Parallel)
        for region in regions(parallel)
    }
    for transition, source in arrows:
        target = transition.target.target if transition.target is not None else None
        if target is None:
            continue
        assert transition.target is not None
        for here, there in zip(source, homes[target], strict=False):
            if here is not there and siblings[here] is siblings[there]:
                context.report.report(
                    "target-outside",
                    transition.target.span,
                    target=transition.target.name,
                    reason=f"it is in region `{there.name}`, the transition in `{here.name}`",
                    related=(Label(target.name.span, "declared here"),),
                )


def _activities(state: State | Parallel | Region) -> list[Activity]:
    return [item for item in state.items if isinstance(item, Activity)]


def _has_states(state: State) -> bool:
    return any(isinstance(item, Vertex) for item in state.items)
