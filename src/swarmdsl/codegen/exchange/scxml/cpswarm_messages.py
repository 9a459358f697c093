"""What is said of the CPSwarm profile: that it is the profile's, and by way of which states."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any

from swarmdsl.base.diagnostics.collector import Diagnostic, Label
from swarmdsl.base.records import fields_of, is_dataclass, replace
from swarmdsl.base.source import Span
from swarmdsl.ir import State, StateMachine

HELP = "`--option scxml.profile=portable` asks for SCXML without it"


def in_profile(machine: StateMachine, found: Iterable[Diagnostic]) -> Iterator[Diagnostic]:
    """What was found when the file of a machine was made, in words of the profile."""
    uses: dict[Span, State] = {}
    for place, state in _reused(machine):
        uses.setdefault(place, state)
    for each in found:
        if each.name in ("unsupported-construct", "bad-identifier"):
            # The message begins with the target, which has another profile.
            each = replace(
                each, message=f"the CPSwarm profile of {each.message}", help=each.help or HELP
            )
        use = uses.get(each.primary.span) if each.primary is not None else None
        if use is not None and use.origin is not None:
            message = f"comes into `{machine.name}` as part of this state"
            each = replace(each, related=(*each.related, Label(use.origin, message)))
        yield each


def without_first_values(machine: StateMachine) -> StateMachine:
    """The machine without the effects that give variables of reused machines their first value.

    The model does not have them as effects, and what is missing is said of the variable.
    """
    places = {variable.origin for variable in machine.variables}

    def kept(state: State) -> State:
        entry = state.entry
        if state.submachine is not None:
            entry = tuple(effect for effect in entry if effect.origin not in places)
        return replace(state, entry=entry, states=tuple(map(kept, state.states)))

    return replace(machine, states=tuple(map(kept, machine.states)))


def _reused(machine: StateMachine) -> Iterator[tuple[Span, State]]:
    """The places in machines that are reused, each with the outermost state that reuses it."""
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
    """The places of a node of the IR and of all nodes in it."""
    if isinstance(node, Span):
        yield node
    elif isinstance(node, tuple):
        for item in node:
            yield from _places(item)
    elif is_dataclass(type(node)):
        for name in fields_of(type(node)):
            yield from _places(getattr(node, name))
