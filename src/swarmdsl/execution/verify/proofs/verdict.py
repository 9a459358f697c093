"""Verdict on a property, for one number of members."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Literal

from swarmdsl import ir
from swarmdsl.base.records import dataclass
from swarmdsl.base.source import Span
from swarmdsl.execution.verify.automata.limits import Budget
from swarmdsl.execution.verify.replay.spurious import OPEN
from swarmdsl.execution.verify.search.explore import Graph
from swarmdsl.execution.verify.search.run import Run
from swarmdsl.execution.verify.swarm.explosion import explain
from swarmdsl.execution.verify.swarm.groups import Group
from swarmdsl.execution.verify.swarm.model import Model

ESTIMATE = "estimate it with `swarmc simulate --runs 1000`"
"""Advice for probabilities."""

UNSURE = f"some runs violate it: how probable they are is not covered: {ESTIMATE}"
"""Reason why a property with a probability is not decided."""

INTERRUPTED = "the search was interrupted"

Outcome = Literal["fails", "unknown", "up to", "holds"]
_WORST_FIRST: tuple[Outcome, ...] = ("fails", "unknown", "up to", "holds")


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
    open: tuple[str, ...] = ()
    """Data that the proof leaves open: conditions on them may hold or not, each time."""
    size: Mapping[str, int] | None = None
    """Numbers of members of a violation, of roles of which it is about every number."""


def worst(verdicts: Iterable[Verdict]) -> Verdict | None:
    """Return the first of the worst verdicts, None if there is none."""
    return min(verdicts, key=lambda each: _WORST_FIRST.index(each.outcome), default=None)


def violated(property_: ir.Property, run: Run, graph: Graph, me: str | None) -> Verdict:
    """Return the verdict when a run was found that seems to violate a property."""
    states = len(graph.seen)
    if run.flaw:
        return Verdict(property_, "unknown", states, not_run(run.flaw), robot=me)
    if property_.chance is not None:
        return Verdict(property_, "unknown", states, UNSURE, robot=me)
    return Verdict(property_, "fails", states, robot=me, run=run)


def not_run(flaw: str) -> str:
    """Return the reason why a run that was found shows nothing."""
    if flaw in OPEN:
        return f"the run that was found may be impossible: {flaw}"
    return f"the run that was found is impossible: {flaw}"


def at_limit(budget: Budget) -> str:
    """Return the limit that has ended a search."""
    if budget.interrupted:
        return INTERRUPTED
    other = "another one with `--limit`, or fewer robots with `--size`"
    return f"the search came to its limit of {budget.reached}: set {other}"


def unfinished(model: Model, budget: Budget) -> str:
    """Return the reason why a search ended too early, with what makes the states so many."""
    large = next((each for each in model.kinds if each.is_too_large), None)
    if large is None or budget.interrupted:
        return at_limit(budget)
    return f"a `{large.kind.role}` has too many states{explain(large, model)}"


def not_violated(
    property_: ir.Property,
    model: Model,
    graph: Graph,
    groups: Sequence[Group],
    me: str | None,
    budget: Budget,
) -> Verdict:
    """Return the verdict when no violation was found."""
    states, full = len(graph.seen), tuple(sorted(graph.network.full))
    doubts = model.doubts(groups)
    if doubts:
        return Verdict(property_, "unknown", states, doubts[0].reason, doubts[0].place, me)
    if not graph.complete:
        reason = unfinished(model, budget)
        return Verdict(property_, "up to", states, reason, robot=me, full=full)
    return Verdict(property_, "holds", states, robot=me, full=full)
