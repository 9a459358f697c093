"""What is said of the CPSwarm profile: that it is the profile's, and by way of which states."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import fields, is_dataclass, replace
from typing import Any

from swarmdsl.diagnostics import Diagnostic, Label
from swarmdsl.ir import State, StateMachine
from swarmdsl.source import Span

HELP = "`--option scxml.profile=portable` asks for SCXML without it"


def in_profile(machine: StateMachine, found: Iterable[Diagnostic]) -> Iterator[Diagnostic]:
    """What was found when the file of a machine was made, in words of the profile."""
    uses: dict[Span, State] = {}
    for place, state in _reused(machine.states):
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


def _reused(states: Iterable[State]) -> Iterator[tuple[Span, State]]:
    """The places in machines that are reused, each with the state that reuses it."""
    for state in states:
        if state.submachine is None:
            yield from _reused(state.states)
        else:
            yield from ((place, state) for inner in state.states for place in _places(inner))


def _places(node: Any) -> Iterator[Span]:
    """The places of a node of the IR and of all nodes in it."""
    if isinstance(node, Span):
        yield node
    elif isinstance(node, tuple):
        for item in node:
            yield from _places(item)
    elif is_dataclass(node):
        for field in fields(node):
            yield from _places(getattr(node, field.name))
