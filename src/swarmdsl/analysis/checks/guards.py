"""Guards that decide nothing: they always hold, or never do."""

from __future__ import annotations

from swarmdsl.analysis.checks.context import Context
from swarmdsl.analysis.checks.guard_satisfiability import certain
from swarmdsl.analysis.checks.livelock import Settling, is_idle
from swarmdsl.syntax.ast import Branch, Choice, Parallel, State, StateMachine, Transition, nodes_of


def check_guards(machine: StateMachine, settling: Settling, context: Context) -> None:
    """Check the guards of all transitions and branches of a machine.

    Where one that always holds makes a machine go round for ever, that has been reported.
    """
    for choice in nodes_of(machine, Choice):
        for branch in choice.branches:
            if branch not in settling.endless:
                _check(branch, _advice(branch, choice), context)
    for state, transitions in context.outline(machine).transitions.items():
        for transition in transitions:
            if transition not in settling.endless:
                _check(transition, _advice(transition, state), context)


def _check(item: Transition | Branch, advice: str, context: Context) -> None:
    guard = item.guard
    if guard is None or guard.tree is None:
        return
    holds = certain(item, context)
    if holds is None:
        return
    held, help_ = ("always", advice) if holds else ("never", "remove the transition")
    known = context.typing.folding.value(guard.tree) is not None
    context.report.report(
        "constant-guard",
        guard.span,
        held=held,
        label="" if known else f"whatever the values are, this is {str(held == 'always').lower()}",
        help=help_ if known else f"change the comparisons, or {help_}",
    )


def _advice(item: Transition | Branch, owner: Choice | State | Parallel) -> str:
    """What to write instead of a guard that always holds: not every transition can go without."""
    if isinstance(owner, Choice):
        return "write `else` in its place, and nothing after it"
    if isinstance(item, Branch) or item.triggers:
        return "remove the guard"
    if is_idle(owner) and item.target is not None:
        return f"write `on done -> {item.target.name}`: it is taken at once"
    return "give the transition a trigger: nothing in the state is ever waited for"
