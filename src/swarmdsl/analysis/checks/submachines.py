"""What machines have of each other: no machine contains itself, nor grows without bounds."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import get_args

from swarmdsl.analysis.checks.context import Context
from swarmdsl.analysis.resolve.states import regions, vertices
from swarmdsl.base.diagnostics.collector import Label
from swarmdsl.base.graphs import cycles, leaves_first
from swarmdsl.base.records import dataclass
from swarmdsl.project.loader import Project
from swarmdsl.syntax.ast import (
    Choice,
    Container,
    FinalState,
    History,
    Ref,
    Region,
    State,
    StateMachine,
    Vertex,
    nodes_of,
)
from swarmdsl.syntax.parser.result import NESTING_LIMIT

# More than anyone writes, and still generated in seconds.
_MOST_STATES = 10_000


@dataclass
class Reuse:
    """What a machine has of others.

    `uses` are the names in it of those it reuses, with what they mean; `own` is how many states
    and regions it has itself, `levels` how deep all are in each other, once somebody asked.
    """

    uses: Sequence[tuple[Ref[StateMachine], StateMachine]]
    own: int
    levels: int | None = None


def check_submachines(project: Project, context: Context) -> None:
    """Check which machines reuse which, and note it in the context."""
    before = context.known.reuse
    reuse = {
        node: before.get(node) or _reuse(node)
        for _, node in project.declarations()
        if isinstance(node, StateMachine)
    }
    context.known.reuse = reuse
    endless = False
    for machine, uses in cycles(reuse, lambda machine: reuse[machine].uses):
        endless = True
        *way, last = uses
        context.report.report(
            "submachine-cycle",
            last.span,
            name=machine.name,
            related=tuple(Label(use.span, "by way of this state") for use in way),
        )
    if not endless:
        _check_growth(reuse, context)


def reused_machines(context: Context) -> set[StateMachine]:
    """The machines that states of others stand for, once `check_submachines` has seen to them."""
    return {inner for reuse in context.known.reuse.values() for _, inner in reuse.uses}


def _check_growth(reuse: Mapping[StateMachine, Reuse], context: Context) -> None:
    """Check how deep and how many the states of each machine are, those it reuses in place.

    A machine that is too large is reported, those that reuse it are not.
    """
    sizes: dict[StateMachine, int] = {}
    reused = reused_machines(context)
    for machine in leaves_first(reuse, lambda machine: [to for _, to in reuse[machine].uses]):
        found = reuse[machine]
        if any(inner not in sizes for _, inner in found.uses):
            continue
        # Without reuse they are not deeper than the parser takes.
        if found.levels is None and (found.uses or machine in reused):
            found.levels = _levels(machine, reuse) - 1
        sizes[machine] = found.own + sum(sizes[inner] for _, inner in found.uses)
        if found.levels is not None and found.levels > NESTING_LIMIT:
            deepest, _ = max(found.uses, key=lambda use: reuse[use[1]].levels or 0)
            context.report.report("nested-too-deeply", deepest.span, limit=NESTING_LIMIT)
            del sizes[machine]
        elif sizes[machine] > _MOST_STATES:
            context.report.report(
                "too-many-states",
                machine.name.span,
                name=machine.name,
                limit=_MOST_STATES,
                notes=("the states of a machine that it reuses count each time",),
            )
            del sizes[machine]


def _levels(state: Vertex | Container, reuse: Mapping[StateMachine, Reuse]) -> int:
    """How deep states stand in each other, the outermost included."""
    if isinstance(state, State) and state.machine is not None and state.machine.target is not None:
        return 1 + (reuse[state.machine.target].levels or 0)
    if isinstance(state, (Choice, History, FinalState)):
        return 1
    inside = (*vertices(state), *regions(state))
    return 1 + max((_levels(inner, reuse) for inner in inside), default=0)


def _reuse(machine: StateMachine) -> Reuse:
    uses = [
        (state.machine, state.machine.target)
        for state in nodes_of(machine, State)
        if state.machine is not None and state.machine.target is not None
    ]
    own = sum(len(nodes_of(machine, kind)) for kind in (*get_args(Vertex), Region))
    return Reuse(uses, own)
