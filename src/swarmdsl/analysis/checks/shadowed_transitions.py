"""Checks of shadowed transitions and branches, which others always precede.

Of several enabled transitions the first in the document is taken, and an eventless one before
all others (SCXML 3.13).
"""

from __future__ import annotations

from collections.abc import Hashable, Mapping, Sequence

from swarmdsl.analysis.checks.context import Context
from swarmdsl.analysis.checks.covering import Earlier, Item
from swarmdsl.analysis.checks.delays import Leaving, check_late, leaves, sooner_one, soonest_of
from swarmdsl.analysis.checks.guard_satisfiability import guard_value
from swarmdsl.analysis.checks.livelock import EventlessSteps, completes_at_once
from swarmdsl.analysis.checks.state_hierarchy import StateHierarchy
from swarmdsl.analysis.event_topics import event_of, received_topic
from swarmdsl.base.diagnostics.advice import Advice
from swarmdsl.base.diagnostics.collector import Label
from swarmdsl.syntax.ast import (
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
    nodes_of,
)

_AT_ONCE = ("at once",)
# Real models have fewer guards for one event. Later ones are compared with these only.
_MAX_COMPARED = 50


def check_shadowed_transitions(machine: StateMachine, context: Context) -> None:
    """Report transitions and branches that are never taken, because others precede them."""
    eventless = context.analysis(EventlessSteps, machine)
    hierarchy = context.hierarchy(machine)
    has_delays = bool(nodes_of(machine, TimeTrigger))
    # The delay that leaves a state, or one around it, first. Outer states come before inner ones.
    ends: dict[Container, Leaving] = {}
    for state, transitions in hierarchy.transitions.items():
        alive = transitions
        if state in eventless.immediate:
            dead = _check_immediate(state, transitions, eventless, hierarchy, context)
            alive = [each for each in transitions if each not in dead]
        soonest: Sequence[Leaving] = ()
        if has_delays:
            soonest = soonest_of(alive, context)
            outer = ends.get(_owner(state, hierarchy))
            if outer is not None:
                alive = [each for each in alive if not check_late(each, outer, context)]
            first = [each for each in (outer, *soonest[:1]) if each is not None]
            if first:
                ends[state] = min(first, key=lambda each: each[0])
        _check_transitions(alive, state, soonest, hierarchy, context)
    for choice in nodes_of(machine, Choice):
        _check_branches(choice, context)


def _check_immediate(
    state: State | Parallel,
    transitions: Sequence[Transition],
    eventless: EventlessSteps,
    hierarchy: StateHierarchy,
    context: Context,
) -> set[Transition]:
    """Report and return the transitions beside the one that a state takes immediately.

    A livelock is reported as such, not here.
    """
    first = eventless.immediate[state][0]
    if first.target is None:
        return set()
    before = transitions[: transitions.index(first)]
    dead = [
        *(
            t
            for t in before
            if t.triggers
            and not any(completes_at_once(each, state, hierarchy) for each in t.triggers)
        ),
        *transitions[len(before) + 1 :],
    ]
    if dead and first not in eventless.endless:
        context.report.report(
            "transition-never-fires",
            dead[0].span,
            related=(
                Label(first.span, "this transition leaves the state as soon as it is entered"),
                *(Label(other.span, "this one can never fire either") for other in dead[1:]),
            ),
            help=Advice(
                f"let `{state.name}` wait before it is left, or remove the other transitions",
                "remove all",
                *(each.span for each in dead),
            ),
        )
    return set(dead)


def _check_transitions(
    transitions: Sequence[Transition],
    state: State | Parallel,
    soonest: Sequence[Leaving],
    hierarchy: StateHierarchy,
    context: Context,
) -> None:
    if len(transitions) == 1 and len(transitions[0].triggers) < 2:
        return  # nothing to compare it with
    earlier: dict[Hashable, Earlier] = {}
    for transition in transitions:
        triggers = transition.triggers
        keys = [_keys(trigger, state, hierarchy) for trigger in triggers] or [[_AT_ONCE]]
        if len(keys) > 1:
            _check_repeated(transition.triggers, keys, context)
        blockers = [
            _all(earlier, each).covering(transition, context) if earlier else [] for each in keys
        ]
        if soonest:
            for number, trigger in enumerate(transition.triggers):
                sooner = sooner_one(trigger, transition, soonest, context)
                blockers[number] = [sooner] if sooner is not None else blockers[number]
        if all(blockers):
            _report(transition, blockers[0], context)
        elif not _decided(transition, context):
            for each in filter(None, keys):
                key = each[0]
                found = earlier.setdefault(key, Earlier()).items
                few = len(found) < _MAX_COMPARED or transition.guard is None
                if few and (key[0] != "after" or leaves(transition)):
                    found.append(transition)


def _check_repeated(
    triggers: Sequence[Trigger], keys: Sequence[list[tuple[Hashable, ...]]], context: Context
) -> None:
    """Report the second of two equivalent triggers of one transition."""
    seen: dict[Hashable, Trigger] = {}
    for trigger, reacts in zip(triggers, keys, strict=False):
        first = next((seen[key] for key in reacts if key in seen), None)
        if first is not None:
            context.report.report(
                "repeated-trigger",
                trigger.span,
                trigger=first.span.text,
                related=(Label(first.span, "by this"),),
                help=Advice("remove one of the two", "remove trigger"),
            )
        elif reacts:
            seen[reacts[0]] = trigger


def _check_branches(choice: Choice, context: Context) -> None:
    earlier = Earlier()
    last: Branch | None = None
    for branch in choice.branches:
        if last is not None:
            context.report.report(
                "transition-never-fires",
                branch.span,
                related=(Label(last.span, "this one is always taken first"),),
                help=Advice("`else` comes last", "move behind"),
            )
            continue
        blockers = earlier.covering(branch, context)
        if blockers:
            _report(branch, blockers, context)
        elif branch.otherwise:
            last = branch
        elif len(earlier.items) < _MAX_COMPARED and not _decided(branch, context):
            earlier.items.append(branch)


def _decided(item: Item, context: Context) -> bool:
    """Return True for a guard that always or never holds, which is reported elsewhere."""
    return item.guard is not None and guard_value(item, context) is not None


def _report(item: Item, blockers: Sequence[Item], context: Context) -> None:
    guards = [blocker.guard for blocker in blockers if blocker.guard is not None]
    if not guards:
        related = [Label(blockers[0].span, "this one is always taken first")]
        help_: str = Advice(
            "give the first one a guard, or remove one of the two", "remove transition"
        )
    else:
        message = "this guard holds whenever the other one does, and comes first"
        if len(guards) > 1:
            message = "one of these guards holds whenever the other one does, and comes first"
        elif item.guard is not None and _words(guards[0].span.text) == _words(item.guard.span.text):
            message = "the same guard holds here first"
        related = [
            Label(guards[0].span, message),
            *(Label(guard.span, "or this one") for guard in guards[1:]),
        ]
        help_ = Advice(
            "change one of the guards, their order, or remove a transition", "remove transition"
        )
    context.report.report("transition-never-fires", item.span, related=tuple(related), help=help_)


def _words(text: str) -> str:
    return "".join(text.split())


def _all(earlier: Mapping[Hashable, Earlier], keys: list[tuple[Hashable, ...]]) -> Earlier:
    groups = [earlier[key] for key in keys if key in earlier]
    if len(groups) == 1:
        return groups[0]
    found = {transition: None for group in groups for transition in group.items}
    return Earlier(sorted(found, key=lambda transition: transition.span.start))


def _keys(
    trigger: Trigger, state: State | Parallel, hierarchy: StateHierarchy
) -> list[tuple[Hashable, ...]]:
    """Keys of a trigger: its own, then those of more general triggers that cover it."""
    if completes_at_once(trigger, state, hierarchy):
        return [_AT_ONCE]
    match trigger:
        case EventTrigger() | MonitorTrigger():
            event = event_of(trigger)
            return [("event", received_topic(event), event.type.type)] if event is not None else []
        case OutcomeTrigger(outcome=outcome):
            return [("outcome", outcome)]
        case DoneTrigger(region=Ref(target=None)) | DoneTrigger(final=Ref(target=None)):
            return []
        case DoneTrigger(region=region, final=final):
            whole = ("done", region.name if region else None, None)
            return [whole] if final is None else [(*whole[:2], final.name), whole]
        case TimeTrigger(delay=delay):
            return [("after", delay.span.text)]


def _owner(state: State | Parallel, hierarchy: StateHierarchy) -> Container:
    """Return the state around a state, or the machine. Regions are skipped."""
    container = hierarchy.parent[state]
    return hierarchy.parent[container] if isinstance(container, Region) else container
