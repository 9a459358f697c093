"""Order: which transitions of a state, or branches of a choice, are ever taken.

Of several that are enabled the first in the text is taken (SCXML 3.13), and one that needs no
event before all that wait for one.
"""

from __future__ import annotations

from collections.abc import Hashable, Mapping, Sequence
from math import inf

from swarmdsl.diagnostics import Label
from swarmdsl.syntax import (
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
from swarmdsl.topics import awaited, heard_on
from swarmdsl.validate.conditions import certain, condition_of, negated, possible
from swarmdsl.validate.context import Context
from swarmdsl.validate.outline import Outline
from swarmdsl.validate.settling import Circles, Step, at_once, endless, immediate

_AT_ONCE = ("at once",)
# More guards than people write for one event; what comes after them is not compared with more.
_MOST_COMPARED = 50
# A transition, and how long its trigger waits.
_Leaving = tuple[float, Transition]


def check_order(machine: StateMachine, circles: Circles, context: Context) -> None:
    """Report what is never taken because something else always comes before it."""
    reported = endless(circles)
    outline = context.outline(machine)
    # By state what leaves it, or one around it, first: of those around others, which come before.
    ends: dict[Container, _Leaving] = {}
    for state, transitions in outline.transitions.items():
        dead = _check_immediate(state, transitions, reported, context)
        alive = [t for t in transitions if t not in dead]
        soonest = _soonest(alive, context)
        outer = [ends[each] for each in (_owner(state, outline),) if each in ends]
        _check_transitions(alive, state, soonest, outer, context)
        if outer or soonest:
            ends[state] = min([*outer, *soonest], key=lambda each: each[0])
    for choice in nodes_of(machine, Choice):
        _check_branches(choice, context)


def _check_immediate(
    state: State | Parallel,
    transitions: Sequence[Transition],
    reported: set[Step],
    context: Context,
) -> set[Transition]:
    """Report what stands beside the way out that a state takes at once; return all of it.

    Where it is left at once in a circle of such states, that is the mistake.
    """
    first = next((t for t in transitions if immediate(t, state, context)), None)
    if first is None or first.target is None:
        return set()
    before = transitions[: transitions.index(first)]
    dead = [
        *(t for t in before if t.triggers and not any(at_once(each, state) for each in t.triggers)),
        *transitions[len(before) + 1 :],
    ]
    if dead and first not in reported:
        context.report.report(
            "transition-never-fires",
            dead[0].span,
            related=(
                Label(first.span, "the state is left by this one as soon as it is entered"),
                *(Label(other.span, "nor can this one fire") for other in dead[1:]),
            ),
            help=f"let `{state.name}` wait before it is left, or remove what it cannot wait for",
        )
    return set(dead)


def _check_transitions(
    transitions: list[Transition],
    state: State | Parallel,
    soonest: Sequence[_Leaving],
    outer: Sequence[_Leaving],
    context: Context,
) -> None:
    earlier: dict[Hashable, list[Transition]] = {}
    for transition in transitions:
        keys = [_keys(trigger, state) for trigger in transition.triggers] or [[_AT_ONCE]]
        _check_repeated(transition.triggers, keys, context)
        sooner = [_sooner(each, transition, soonest, context) for each in transition.triggers]
        late = [_late(each, outer, context) for each in transition.triggers]
        if late and all(late):
            _report_late(transition, outer[0][1], context)
            continue
        blockers = [
            [first] if first is not None else _covering(transition, _all(earlier, each), context)
            for first, each in zip(sooner or [None], keys, strict=True)
        ]
        if all(blockers):
            _report(transition, blockers[0], context)
        elif not _decided(transition, context):
            for key in (key for each in keys for key in each[:1]):
                found = earlier.setdefault(key, [])
                few = len(found) < _MOST_COMPARED or transition.guard is None
                if few and (key[0] != "after" or _leaves(transition)):
                    found.append(transition)


def _check_repeated(
    triggers: Sequence[Trigger], keys: Sequence[list[tuple[Hashable, ...]]], context: Context
) -> None:
    """Report the second of two triggers of one transition that react to the same."""
    seen: dict[Hashable, Trigger] = {}
    for trigger, reacts in zip(triggers, keys, strict=False):
        first = next((seen[key] for key in reacts if key in seen), None)
        if first is not None:
            context.report.report(
                "repeated-trigger",
                trigger.span,
                trigger=first.span.text,
                related=(Label(first.span, "by this"),),
                help="remove one of the two",
            )
        elif reacts:
            seen[reacts[0]] = trigger


def _check_branches(choice: Choice, context: Context) -> None:
    earlier: list[Branch] = []
    last: Branch | None = None
    for branch in choice.branches:
        if last is not None:
            context.report.report(
                "transition-never-fires",
                branch.span,
                related=(Label(last.span, "this one is always taken first"),),
                help="`else` comes last",
            )
            continue
        blockers = _covering(branch, earlier, context)
        if blockers:
            _report(branch, blockers, context)
        elif branch.otherwise:
            last = branch
        elif len(earlier) < _MOST_COMPARED and not _decided(branch, context):
            earlier.append(branch)


def _decided(item: Transition | Branch, context: Context) -> bool:
    """Whether its guard decides nothing, which is reported as such."""
    return item.guard is not None and certain(item, context) is not None


def _covering(
    item: Transition | Branch, earlier: Sequence[Transition | Branch], context: Context
) -> list[Transition | Branch]:
    """Those of the earlier ones of which one is taken whenever this one could be.

    What has no guard is there for what others leave: it is covered by another without one only.
    """
    plain = [before for before in earlier if before.guard is None and isinstance(item, Transition)]
    if plain or item.guard is None:
        return list(plain[:1])
    if certain(item, context) is False:
        return []
    # What holds comes last, which is looked at first: it leaves least of the values.
    holds = condition_of(item, context)
    passed = {before: negated(condition_of(before, context)) for before in earlier}
    if not passed:
        return []
    for before, condition in passed.items():
        if not possible([condition, holds]):
            return [before]
    if possible([*passed.values(), holds]):
        return []
    for before in earlier:
        others = [condition for each, condition in passed.items() if each is not before]
        if not possible([*others, holds]):
            del passed[before]
    return list(passed)


def _report(
    item: Transition | Branch, blockers: Sequence[Transition | Branch], context: Context
) -> None:
    guards = [blocker.guard for blocker in blockers if blocker.guard is not None]
    if not guards:
        related = [Label(blockers[0].span, "this one is always taken first")]
        help_ = "give the first one a guard, or remove one of the two"
    else:
        message = "whenever the guard holds, this one does, and is looked at first"
        if len(guards) > 1:
            message = "whenever the guard holds, one of these does, and is looked at first"
        elif item.guard is not None and _words(guards[0].span.text) == _words(item.guard.span.text):
            message = "the same guard holds here first"
        related = [
            Label(guards[0].span, message),
            *(Label(guard.span, "or this one") for guard in guards[1:]),
        ]
        help_ = "change one of the guards, their order, or remove a transition"
    context.report.report("transition-never-fires", item.span, related=tuple(related), help=help_)


def _words(text: str) -> str:
    return "".join(text.split())


def _all(
    earlier: Mapping[Hashable, list[Transition]], keys: list[tuple[Hashable, ...]]
) -> list[Transition]:
    found = {transition: None for key in keys for transition in earlier.get(key, ())}
    return sorted(found, key=lambda transition: transition.span.start)


def _keys(trigger: Trigger, state: State | Parallel) -> list[tuple[Hashable, ...]]:
    """What a trigger reacts to, first itself, then the more general triggers that cover it."""
    if at_once(trigger, state):
        return [_AT_ONCE]
    match trigger:
        case EventTrigger() | MonitorTrigger():
            event = awaited(trigger)
            return [("event", heard_on(event), event.type.type)] if event is not None else []
        case OutcomeTrigger(outcome=outcome):
            return [("outcome", outcome)]
        case DoneTrigger(region=Ref(target=None)) | DoneTrigger(final=Ref(target=None)):
            return []
        case DoneTrigger(region=region, final=final):
            whole = ("done", region.name if region else None, None)
            return [whole] if final is None else [(*whole[:2], final.name), whole]
        case TimeTrigger(delay=delay):
            return [("after", delay.span.text)]


def _leaves(transition: Transition) -> bool:
    """Whether it ends all delays of its state."""
    return transition.target is not None and not transition.internal


def _soonest(transitions: Sequence[Transition], context: Context) -> list[_Leaving]:
    """The two transitions that leave the state always and first, as their time comes."""
    found: list[_Leaving] = []
    for transition in transitions:
        if transition.guard is None and _leaves(transition):
            known = [_delay(trigger, context) for trigger in transition.triggers]
            delays = [delay for delay in known if delay is not None]
            if delays:
                found.append((min(delays), transition))
    return sorted(found, key=lambda each: each[0])[:2]


def _sooner(
    trigger: Trigger, transition: Transition, soonest: Sequence[_Leaving], context: Context
) -> Transition | None:
    """The transition that leaves the state always, and after a shorter time or the same."""
    if not soonest:
        return None
    delay = _delay(trigger, context)
    others = ((sooner, other) for sooner, other in soonest if other is not transition)
    sooner, other = next(others, (inf, None))
    if delay is None or other is None:
        return None
    before = other.span.start < transition.span.start
    return other if sooner < delay or (before and sooner == delay) else None


def _owner(state: State | Parallel, outline: Outline) -> Container:
    """The state that another one is in, or the machine."""
    container = outline.container[state]
    return outline.container[container] if isinstance(container, Region) else container


def _late(trigger: Trigger, outer: Sequence[_Leaving], context: Context) -> bool:
    """Whether a state around is left by then: it was entered no later."""
    delay = _delay(trigger, context) if outer else None
    return delay is not None and any(sooner <= delay for sooner, _ in outer)


def _report_late(transition: Transition, before: Transition, context: Context) -> None:
    context.report.report(
        "transition-never-fires",
        transition.span,
        related=(Label(before.span, "this one leaves the state around it no later"),),
        help="let it wait less long, or the other one longer",
    )


def _delay(trigger: Trigger, context: Context) -> float | None:
    """How long a trigger waits, where that is known and makes sense."""
    if isinstance(trigger, TimeTrigger) and trigger.delay.tree is not None:
        value = context.typing.folding.value(trigger.delay.tree)
        return value if isinstance(value, (int, float)) and value > 0 else None
    return None
