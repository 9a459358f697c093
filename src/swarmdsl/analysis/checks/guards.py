"""Checks of guards that always or never hold."""

from __future__ import annotations

from swarmdsl.analysis.checks.context import Context
from swarmdsl.analysis.checks.guard_satisfiability import guard_value
from swarmdsl.analysis.checks.livelock import EventlessSteps
from swarmdsl.analysis.checks.state_hierarchy import StateHierarchy
from swarmdsl.base.diagnostics.advice import Advice, before, edits
from swarmdsl.base.source import Span
from swarmdsl.syntax.ast import (
    NEIGHBORS,
    Branch,
    Call,
    Choice,
    Elapsed,
    Expression,
    InState,
    OperatorUse,
    Parallel,
    State,
    StateMachine,
    Transition,
    Variable,
    nodes_of,
    walk,
)


def check_guards(machine: StateMachine, context: Context) -> None:
    """Check the guards of all transitions and branches of a machine.

    Guards that make a livelock have been reported as that.
    """
    endless = context.analysis(EventlessSteps, machine).endless
    hierarchy = context.hierarchy(machine)
    for choice in nodes_of(machine, Choice):
        for branch in choice.branches:
            if branch not in endless:
                _check(branch, choice, hierarchy, context)
    for state, transitions in hierarchy.transitions.items():
        for transition in transitions:
            if transition not in endless:
                _check(transition, state, hierarchy, context)
                _check_time(transition, context)


def _check(
    item: Transition | Branch,
    owner: Choice | State | Parallel,
    hierarchy: StateHierarchy,
    context: Context,
) -> None:
    guard = item.guard
    if guard is None or guard.tree is None:
        return
    holds = guard_value(item, context)
    if holds is None:
        return
    held = "never"
    help_: str = Advice("remove the transition", "remove transition")
    if holds:
        held, help_ = "always", _hint(item, owner, hierarchy)
    known = context.typing.folding.value(guard.tree) is not None
    if not known:
        prefix = "change the comparisons, or "
        help_ = help_.prefixed(prefix) if isinstance(help_, Advice) else prefix + help_
    context.report.report(
        "constant-guard",
        guard.span,
        held=held,
        label="" if known else f"this is always {str(held == 'always').lower()}",
        help=help_,
    )


def _check_time(transition: Transition, context: Context) -> None:
    """Report a guard that only time changes, without a trigger: time takes no transition.

    With time, other robots come near.
    """
    guard = transition.guard
    if transition.triggers or guard is None or guard.tree is None:
        return
    parts = list(walk(guard))
    near = [part for part in parts if isinstance(part, Call) and part.function == NEIGHBORS]
    time = next((part for part in parts if isinstance(part, Elapsed) or part in near), None)
    changes = any(
        isinstance(part, (InState, Call)) or isinstance(getattr(part, "target", None), Variable)
        for part in parts
        if part not in near
    )
    if time is not None and not changes:
        context.report.report(
            "unnoticed-time",
            time.span,
            help=_instead_of_time(transition, guard)
            if not near
            else edits(
                "look now and then, `after 1 s [...]`, or name an event with `on`",
                "Write `after 1 s [...]`",
                before(transition.span, "after 1 s "),
            ),
        )


def _instead_of_time(transition: Transition, guard: Expression) -> str:
    """Return the help for a guard on the time in a state; if that is all, a delay is the same."""
    text = "write `after` and the time in its place, or name an event with `on`"
    tree, (source, start, end) = guard.tree, guard.span
    if not isinstance(tree, OperatorUse) or tree.operator not in (">", ">="):
        return text
    measured, limit = tree.operands
    if not isinstance(measured, Elapsed) or measured.state is not None:
        return text
    start, end = source.text.rindex("[", 0, start), source.text.index("]", end) + 1
    new = f"after {limit.span.text}"
    return edits(text, f"Write `{new}`", (Span(source, start, end), new))


def _hint(
    item: Transition | Branch, owner: Choice | State | Parallel, hierarchy: StateHierarchy
) -> str:
    """Return the replacement of a guard that always holds. Some transitions need a guard."""
    if isinstance(owner, Choice):
        return Advice("write `else` in its place, and nothing after it", "write else")
    if isinstance(item, Branch) or item.triggers:
        return Advice("remove the guard", "remove guard")
    if owner in hierarchy.idle and item.target is not None:
        return Advice(
            f"write `on done -> {item.target.name}`: it is taken at once",
            "replace transition",
            f"on done -> {item.target.name}",
        )
    return "give the transition a trigger: the state waits for nothing"
