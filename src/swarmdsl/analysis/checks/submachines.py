"""Checks of submachines: no machine contains itself or grows too large."""

from __future__ import annotations

from collections.abc import Mapping
from typing import get_args

from swarmdsl.analysis.checks.context import Context
from swarmdsl.analysis.checks.facts import Reuse
from swarmdsl.analysis.resolve.states import regions, vertices
from swarmdsl.base.diagnostics.collector import Label
from swarmdsl.base.graphs import cycles, leaves_first
from swarmdsl.project.loader import Project
from swarmdsl.syntax.ast import (
    Choice,
    Container,
    FinalState,
    History,
    Region,
    State,
    StateMachine,
    Vertex,
    nodes_of,
)
from swarmdsl.syntax.parser.result import NESTING_LIMIT

# More than real models have, and still generated in seconds.
_MAX_STATES = 10_000


def check_submachines(project: Project, context: Context) -> None:
    """Check for cycles of submachines and for their size; note the submachines in the context."""
    before = context.facts.reuse
    reuse = {
        node: before.get(node) or _reuse(node)
        for _, node in project.declarations()
        if isinstance(node, StateMachine)
    }
    context.facts.reuse = reuse
    context.facts.reused = frozenset(inner for each in reuse.values() for _, inner in each.uses)
    has_cycles = False
    for machine, uses in cycles(reuse, lambda machine: reuse[machine].uses):
        has_cycles = True
        *earlier, last = uses
        context.report.report(
            "submachine-cycle",
            last.span,
            name=machine.name,
            related=tuple(Label(use.span, "through this state") for use in earlier),
        )
    if not has_cycles:
        _check_growth(reuse, context)


def _check_growth(reuse: Mapping[StateMachine, Reuse], context: Context) -> None:
    """Check the depth and number of the states of each machine with its submachines.

    A machine that is too large is reported; the machines that reuse it are not.
    """
    sizes: dict[StateMachine, int] = {}
    for machine in leaves_first(reuse, lambda machine: [to for _, to in reuse[machine].uses]):
        found = reuse[machine]
        if any(inner not in sizes for _, inner in found.uses):
            continue
        # The parser limits the depth of a machine without submachines.
        if found.levels is None and (found.uses or machine in context.facts.reused):
            found.levels = _levels(machine, reuse) - 1
        sizes[machine] = found.own + sum(sizes[inner] for _, inner in found.uses)
        if found.levels is not None and found.levels > NESTING_LIMIT:
            deepest, _ = max(found.uses, key=lambda use: reuse[use[1]].levels or 0)
            context.report.report("nested-too-deeply", deepest.span, limit=NESTING_LIMIT)
            del sizes[machine]
        elif sizes[machine] > _MAX_STATES:
            context.report.report(
                "too-many-states",
                machine.name.span,
                name=machine.name,
                limit=_MAX_STATES,
                notes=("the states of a submachine count at each use",),
            )
            del sizes[machine]


def _levels(state: Vertex | Container, reuse: Mapping[StateMachine, Reuse]) -> int:
    """Depth of nested states, the outermost included."""
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
