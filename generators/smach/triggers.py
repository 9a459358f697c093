"""Events, times and decisions: Monitor, Timer and Decision states with their functions."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from swarmdsl.dataclass import dataclass
from swarmdsl.ir import EventTrigger, Expression, State, TimeTrigger, Transition
from swarmdsl.source import Span

from .expressions import keys, python_expression
from .module import Module, fresh
from .python import Call, Source, comments
from .routes import Branch, Route, reachable
from .scopes import Targets
from .statements import (
    STEP,
    effect_lines,
    effect_reads,
    effect_writes,
    effects_use_event,
    load_event,
)


@dataclass(frozen=True)
class Trigger:
    """A state that ends when something happens, and where each of its outcomes leads."""

    label: str
    call: Call
    routes: dict[str, Route]
    origin: Span | None


def triggers_of(state: State, targets: Targets, module: Module) -> list[Trigger]:
    """What may end a state: its condition, and a monitor or timer for each event and time."""
    by_event: dict[str, list[Transition]] = {}
    by_delay: dict[Expression, list[Transition]] = {}
    for transition in state.transitions:
        for trigger in transition.triggers:
            if isinstance(trigger, EventTrigger):
                by_event.setdefault(trigger.event, []).append(transition)
            elif isinstance(trigger, TimeTrigger):
                by_delay.setdefault(trigger.delay, []).append(transition)
    found = [
        _monitor(state, event, transitions, targets, module)
        for event, transitions in by_event.items()
    ]
    for delay, transitions in by_delay.items():
        label = fresh("timeout", (trigger.label for trigger in found))
        found.append(_timer(state, label, delay, transitions, module))
    if conditions := eventless(state):
        label = fresh("condition", (trigger.label for trigger in found))
        found.insert(0, _condition(state, label, conditions, module))
    return found


def eventless(state: State) -> list[Transition]:
    """The transitions that are taken as soon as their guards hold."""
    return reachable(transition for transition in state.transitions if not transition.triggers)


def _monitor(
    state: State,
    event: str,
    transitions: Iterable[Transition],
    targets: Targets,
    module: Module,
) -> Trigger:
    chosen = reachable(transitions)
    leaving = [transition for transition in chosen if transition.target is not None]
    needs_message = any(effects_use_event(transition.effects) for transition in leaving)
    key = module.message_key(event, targets.region(state)) if needs_message else None
    routes = _routes(event, chosen, key)
    around = {
        outcome: targets.parent[transition.target]
        for outcome, transition in zip(routes, leaving, strict=True)
        if transition.target is not None
    }
    keywords = _choice(state, event, "userdata, event", routes, chosen, module)
    if key is not None:
        keywords.append(("message_key", key))
    return Trigger(
        event,
        Call(
            module.own("states", "Monitor"),
            (Source(module.event(event)), state.id, around),
            tuple(keywords),
        ),
        routes,
        chosen[0].origin,
    )


def _timer(
    state: State,
    label: str,
    delay: Expression,
    transitions: Iterable[Transition],
    module: Module,
) -> Trigger:
    chosen = reachable(transitions)
    routes = _routes(label, chosen, None)
    duration = python_expression(delay, module.imports)
    keywords = _choice(state, label, "userdata", routes, chosen, module, keys(delay))
    arguments = (Source(f"lambda userdata: {duration}"), list(routes))
    call = Call(module.own("states", "Timer"), arguments, tuple(keywords))
    return Trigger(label, call, routes, chosen[0].origin)


def _condition(
    state: State, label: str, transitions: Sequence[Transition], module: Module
) -> Trigger:
    routes = _routes(label, transitions, None)
    name, reads, _ = _choose(state, label, "userdata", routes, transitions, module)
    arguments = (Source(name), list(routes))
    call = Call(module.own("states", "Condition"), arguments, tuple(_keys(reads, ())))
    return Trigger(label, call, routes, transitions[0].origin)


def _routes(label: str, transitions: Sequence[Transition], key: str | None) -> dict[str, Route]:
    """An outcome for each transition that leads on; the guards are done with when it comes."""
    routes: dict[str, Route] = {}
    for transition in transitions:
        if transition.target is None:
            continue
        name = label if len(transitions) == 1 else f"{label}_{transition.target}"
        routes[fresh(name, routes)] = [Branch(transition, key).taken]
    return routes


def _choice(
    state: State,
    label: str,
    parameters: str,
    routes: Iterable[str],
    transitions: Sequence[Transition],
    module: Module,
    also_read: Iterable[str] = (),
) -> list[tuple[str, object]]:
    """The keywords for what has to be decided when it comes: nothing, for one plain transition."""
    first = transitions[0]
    if first.guard is None and first.target is not None:
        return _keys(also_read, ())
    name, reads, writes = _choose(state, label, parameters, routes, transitions, module)
    return [("choose", Source(name)), *_keys([*also_read, *reads], writes)]


def _choose(
    state: State,
    label: str,
    parameters: str,
    routes: Iterable[str],
    transitions: Sequence[Transition],
    module: Module,
) -> tuple[str, list[str], list[str]]:
    """The function that returns the outcome of the first transition whose guard holds.

    One without a target is done in it. Also the userdata that it reads and writes.
    """
    outcomes = iter(routes)
    body: list[str] = []
    reads: list[str] = []
    writes: list[str] = []
    for transition in transitions:
        depth = 1 if transition.guard is None else 2
        if transition.guard is not None:
            body.append(f"{STEP}if {python_expression(transition.guard, module.imports)}:")
            reads += keys(transition.guard)
        if transition.target is None:
            body += effect_lines(transition.effects, depth, module)
            reads += effect_reads(transition.effects)
            writes += effect_writes(transition.effects)
            body.append(f"{STEP * depth}return {module.own('states', 'STAYS')}")
        else:
            body.append(f"{STEP * depth}return {next(outcomes)!r}")
    if transitions[-1].guard is not None:
        body.append(f"{STEP}return None")
    words = (state.id, "choose", label)
    said = [
        line
        for transition in transitions
        if transition.target is None or transition is transitions[0]
        for line in comments(transition.origin, "" if transition.target else transition.doc)
    ]
    name = module.add_function(words, parameters, body, tuple(said))
    return name, reads, writes


def decision(
    words: Iterable[str],
    branches: Sequence[Branch],
    outcomes: Sequence[str],
    otherwise: str | None,
    module: Module,
) -> Call:
    """The state that takes the first branch whose guard holds, with its effects.

    `outcomes` are those of the branches; `otherwise` is that of none.
    """
    body: list[str] = []
    reads: list[str] = []
    writes: list[str] = []
    for branch, outcome in zip(branches, outcomes, strict=True):
        transition = branch.transition
        depth = 1 if transition.guard is None else 2
        inner: list[str] = []
        if branch.message_key is not None and effects_use_event(transition.effects):
            inner.append(load_event(branch.message_key, depth))
            reads.append(branch.message_key)
        inner += effect_lines(transition.effects, depth, module)
        inner.append(f"{STEP * depth}return {outcome!r}")
        if transition.guard is not None:
            body.append(f"{STEP}if {python_expression(transition.guard, module.imports)}:")
            reads += keys(transition.guard)
        body += inner
        reads += effect_reads(transition.effects)
        writes += effect_writes(transition.effects)
    all_outcomes = list(dict.fromkeys(outcomes))
    if otherwise is not None:
        body.append(f"{STEP}return {otherwise!r}")
        all_outcomes.append(otherwise)
    name = module.add_function(words, "userdata", body, comments(branches[0].transition.origin))
    keywords = tuple(_keys(reads, writes))
    return Call(module.own("states", "Decision"), (Source(name), all_outcomes), keywords)


def _keys(reads: Iterable[str], writes: Iterable[str]) -> list[tuple[str, object]]:
    found = (
        ("input_keys", list(dict.fromkeys(reads))),
        ("output_keys", list(dict.fromkeys(writes))),
    )
    return [(word, names) for word, names in found if names]
