"""Events, times and decisions: Monitor, Timer and Decision states with their functions."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

from swarmdsl.ir import EventTrigger, Expression, State, TimeTrigger, Transition
from swarmdsl.source import Span

from .expressions import keys, python_expression
from .module import Module, fresh
from .python import Call, Source, place
from .routes import Branch, Route, reachable
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


def triggers_of(state: State, module: Module) -> list[Trigger]:
    """The monitors and timers of a state, one for each event and each time."""
    by_event: dict[str, list[Transition]] = {}
    by_delay: dict[Expression, list[Transition]] = {}
    for transition in state.transitions:
        for trigger in transition.triggers:
            if isinstance(trigger, EventTrigger):
                by_event.setdefault(trigger.event, []).append(transition)
            elif isinstance(trigger, TimeTrigger):
                by_delay.setdefault(trigger.delay, []).append(transition)
    found = [_monitor(state, event, ts, module) for event, ts in by_event.items()]
    for delay, transitions in by_delay.items():
        label = fresh("timeout", (trigger.label for trigger in found))
        found.append(_timer(state, label, delay, transitions, module))
    return found


def _monitor(
    state: State, event: str, transitions: Iterable[Transition], module: Module
) -> Trigger:
    chosen = reachable(transitions)
    needs_message = any(effects_use_event(transition.effects) for transition in chosen)
    key = module.message_key(event) if needs_message else None
    routes = _routes(event, chosen, key)
    keywords: list[tuple[str, object]] = []
    if any(transition.guard is not None for transition in chosen):
        name = _choice(state, event, "userdata, event", routes, chosen, module)
        keywords = [("choose", Source(name)), *_inputs(_guard_reads(chosen))]
    if key is not None:
        keywords.append(("message_key", key))
    arguments = (Source(module.event(event)), state.id, list(routes))
    return Trigger(
        event,
        Call(module.own("states", "Monitor"), arguments, tuple(keywords)),
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
    reads = keys(delay)
    duration = python_expression(delay, module.imports)
    keywords: list[tuple[str, object]] = []
    if any(transition.guard is not None for transition in chosen):
        name = _choice(state, label, "userdata", routes, chosen, module)
        keywords = [("choose", Source(name))]
        reads += _guard_reads(chosen)
    arguments = (Source(f"lambda userdata: {duration}"), list(routes))
    return Trigger(
        label,
        Call(module.own("states", "Timer"), arguments, (*keywords, *_inputs(reads))),
        routes,
        chosen[0].origin,
    )


def _routes(label: str, transitions: Sequence[Transition], key: str | None) -> dict[str, Route]:
    """An outcome for each transition; the guards are done with when it comes."""
    routes: dict[str, Route] = {}
    for transition in transitions:
        name = label if len(transitions) == 1 else f"{label}_{transition.target}"
        taken = Branch(replace(transition, guard=None), key)
        routes[fresh(name, routes)] = [taken]
    return routes


def _choice(
    state: State,
    label: str,
    parameters: str,
    routes: Iterable[str],
    transitions: Sequence[Transition],
    module: Module,
) -> str:
    """The function that returns the outcome of the first transition whose guard holds."""
    body: list[str] = []
    for outcome, transition in zip(routes, transitions, strict=True):
        body += _guarded(transition.guard, [f"return {outcome!r}"], module)
    if transitions[-1].guard is not None:
        body.append(f"{STEP}return None")
    return module.add_function(
        (state.id, "choose", label), parameters, body, place(transitions[0].origin)
    )


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
    name = module.add_function(words, "userdata", body, place(branches[0].transition.origin))
    keywords = [*_inputs(reads)]
    if writes:
        keywords.append(("output_keys", list(dict.fromkeys(writes))))
    return Call(module.own("states", "Decision"), (Source(name), all_outcomes), tuple(keywords))


def _guarded(guard: Expression | None, then: list[str], module: Module) -> list[str]:
    if guard is None:
        return [STEP + line for line in then]
    condition = python_expression(guard, module.imports)
    return [f"{STEP}if {condition}:", *(STEP * 2 + line for line in then)]


def _guard_reads(transitions: Iterable[Transition]) -> list[str]:
    return [key for t in transitions if t.guard is not None for key in keys(t.guard)]


def _inputs(reads: Iterable[str]) -> list[tuple[str, object]]:
    found = list(dict.fromkeys(reads))
    return [("input_keys", found)] if found else []
