"""Verdict on a property, for one number of members."""

from __future__ import annotations

from typing import Literal

from swarmdsl import ir
from swarmdsl.base.records import dataclass
from swarmdsl.base.source import Span
from swarmdsl.execution.verify.explore import Graph
from swarmdsl.execution.verify.model import Model
from swarmdsl.execution.verify.runs import Run

Outcome = Literal["holds", "fails", "up to", "unknown"]


@dataclass(frozen=True)
class Verdict:
    """Verdict on a property, for one number of members.

    `robot` and `run` are those of a violation; `reason`, perhaps with a place in the model, is
    that of a verdict that is open. `states` is the number of states that were looked at.
    """

    property: ir.Property
    outcome: Outcome
    states: int = 0
    reason: str = ""
    place: Span | None = None
    robot: str | None = None
    run: Run | None = None
    full: tuple[str, ...] = ()
    """Events of which messages were lost because there were too many."""
    alone: bool = False
    """True if the proof is about one robot, whatever the others do."""


def violated(property_: ir.Property, run: Run, graph: Graph, me: str | None) -> Verdict:
    """Return the verdict when a run was found that seems to violate a property."""
    states = len(graph.seen)
    if run.flaw:
        reason = f"the run that was found cannot be: {run.flaw}"
        return Verdict(property_, "unknown", states, reason, robot=me)
    if property_.chance is not None:
        reason = "some runs violate it: how probable they are is not covered"
        return Verdict(property_, "unknown", states, reason, robot=me)
    return Verdict(property_, "fails", states, robot=me, run=run)


def unfinished(model: Model) -> str:
    """Say what made a search stop, and which variable to bound."""
    for automaton in model.kinds:
        if any(steps is None for steps in automaton.steps):
            wide = automaton.wide()
            what = f": bound `{wide}`" if wide else ""
            return f"a `{automaton.kind.role}` has too many states{what}"
    return "there are more states"
