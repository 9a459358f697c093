"""Guards that decide nothing: they always hold, never do, or repeat an earlier one."""

from __future__ import annotations

from collections.abc import Hashable, Sequence

from swarmdsl.diagnostics import Label
from swarmdsl.folding import fold
from swarmdsl.syntax import (
    Branch,
    Choice,
    Expression,
    Parallel,
    State,
    StateMachine,
    Transition,
    walk,
)
from swarmdsl.validate.context import Context


def check_guards(machine: StateMachine, context: Context) -> None:
    """Check the guards of all transitions and branches of a machine."""
    for node in walk(machine):
        match node:
            case Choice(branches=branches):
                _check_alternatives(branches, context)
            case State() | Parallel():
                items = [item for item in node.items if isinstance(item, Transition)]
                _check_alternatives(items, context)


def _check_alternatives(items: Sequence[Transition | Branch], context: Context) -> None:
    seen: dict[Hashable, Expression] = {}
    for item in items:
        guard = item.guard
        if guard is None or guard.tree is None:
            continue
        value = fold(guard.tree)
        if isinstance(value, bool):
            held = "always" if value else "never"
            context.report.report(
                "constant-guard",
                guard.span,
                held=held,
                help="remove the guard" if value else "remove the transition",
            )
            continue
        triggers = getattr(item, "triggers", [])
        for trigger in triggers or [item]:
            place = trigger.span.text if triggers else ""
            first = seen.setdefault((place, _words(guard)), guard)
            if first is not guard:
                context.report.report(
                    "transition-never-fires",
                    item.span,
                    related=(Label(first.span, "the same guard holds here first"),),
                    help="change one of the guards, or remove one of the two",
                )
                break


def _words(guard: Expression) -> str:
    return "".join(guard.span.text.split())
