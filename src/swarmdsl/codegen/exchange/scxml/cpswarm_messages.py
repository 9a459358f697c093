"""Diagnostics of the CPSwarm profile, at the states of the model."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any

from swarmdsl.base.diagnostics.collector import Diagnostic, Label
from swarmdsl.base.records import fields_of, is_dataclass, replace
from swarmdsl.base.source import Span
from swarmdsl.ir import State, StateMachine

HELP = "`--option scxml.profile=portable` builds SCXML without it"


def in_profile(machine: StateMachine, found: Iterable[Diagnostic]) -> Iterator[Diagnostic]:
    """Return the diagnostics of a machine's file, in words of the profile."""
    uses: dict[Span, State] = {}
    for place, state in _reused(machine):
        uses.setdefault(place, state)
    for each in found:
        if each.name in ("unsupported-construct", "bad-identifier"):
            # The message begins with the target, which also has the portable profile.
            each = replace(
                each, message=f"the CPSwarm profile of {each.message}", help=each.help or HELP
            )
        use = uses.get(each.primary.span) if each.primary is not None else None
        if use is not None and use.origin is not None:
            message = f"included in `{machine.name}` by this state"
            each = replace(each, related=(*each.related, Label(use.origin, message)))
        yield each


def without_initializers(machine: StateMachine) -> StateMachine:
    """Return the machine without effects that initialize reused machines' variables.

    The model has no such effects: reports are about the variable instead.
    """
    places = {variable.origin for variable in machine.variables}

    def kept(state: State) -> State:
        entry = state.entry
        if state.submachine is not None:
            entry = tuple(effect for effect in entry if effect.origin not in places)
        return replace(state, entry=entry, states=tuple(map(kept, state.states)))

    return replace(machine, states=tuple(map(kept, machine.states)))


def _reused(machine: StateMachine) -> Iterator[tuple[Span, State]]:
    """Yield each place in reused machines with the outermost reusing state."""
    declared = {variable.origin for variable in machine.variables}

    def visit(states: Iterable[State]) -> Iterator[tuple[Span, State]]:
        for state in states:
            if state.submachine is None:
                yield from visit(state.states)
                continue
            first_values = (effect for effect in state.entry if effect.origin in declared)
            for place in _places((*first_values, *state.states)):
                yield place, state

    return visit(machine.states)


def _places(node: Any) -> Iterator[Span]:
    """Yield the places of an IR node and of all nodes in it."""
    if isinstance(node, Span):
        yield node
    elif isinstance(node, tuple):
        for item in node:
            yield from _places(item)
    elif is_dataclass(type(node)):
        for name in fields_of(type(node)):
            yield from _places(getattr(node, name))
