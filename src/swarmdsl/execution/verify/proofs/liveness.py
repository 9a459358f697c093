"""Proofs of properties that a run that goes on for ever can violate: a search for such runs."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import islice

from swarmdsl import ir
from swarmdsl.base.records import replace
from swarmdsl.execution.verify.abstraction.doubt import Doubt
from swarmdsl.execution.verify.automata.limits import Budget
from swarmdsl.execution.verify.proofs.observation import observer_of, run_to
from swarmdsl.execution.verify.proofs.verdict import Verdict, not_run, not_violated, violated
from swarmdsl.execution.verify.properties.observer import Observer
from swarmdsl.execution.verify.replay.lasso_replay import endless
from swarmdsl.execution.verify.replay.spurious import OPEN
from swarmdsl.execution.verify.search.explore import Graph, observe
from swarmdsl.execution.verify.search.lassos import Lassos
from swarmdsl.execution.verify.search.settling import observe_settling
from swarmdsl.execution.verify.swarm.influence import cone
from swarmdsl.execution.verify.swarm.model import Model
from swarmdsl.execution.verify.swarm.subjects import about

_MOST_LASSOS = 60
"""Number of loops that are tried on the engine."""
_MOST_SETTLING = 4_000
"""Number of states of the search for rest, where a search of all has come to a limit."""
_WITH_A_TIME = "; with a time, such as `within 1 min`, `--time exact` may decide"


def in_the_end(
    property_: ir.Property,
    model: Model,
    me: str | None,
    budget: Budget,
    *,
    lonely: bool,
    timed: bool = False,
) -> Verdict:
    """Decide on a property that runs that go on for ever can violate; `timed` ones fit times.

    If robots of a group must be told apart to decide, each is looked at by itself.
    """
    first_flaw = ""
    for single in (False, True):
        every = model.groups([property_], me=me, tasks=True, single=single)
        seen = set(about(property_, model, every))
        seen |= {number for number, group in enumerate(every) if group.robots == (me,)}
        groups = cone(model, every, seen) or every
        observer = observer_of(
            property_,
            model,
            groups,
            me,
            lonely=lonely,
            others=len(groups) < len(every),
            timed=timed,
        )
        if observer.others:
            # What holds for a moment ends when any robot does something.
            groups = every
            observer = observer_of(
                property_, model, groups, me, lonely=lonely, others=False, timed=timed
            )
        doubts = model.doubts(groups)
        graph = observe(observer.network, observer, budget)
        violation, flaw = _violation(property_, observer, graph, doubts, me, budget)
        if violation is None and not graph.complete and not budget.is_over():
            some = budget.some(_MOST_SETTLING)
            settled = observe_settling(observer, some)
            violation, _ = _violation(
                property_, observer, settled, doubts, me, some, shortest=False
            )
        if violation is not None:
            return violation
        if doubts or not flaw:
            return not_violated(property_, model, graph, groups, me, budget)
        first_flaw = first_flaw or flaw
        if all(len(group.robots) == 1 for group in groups):
            break
    reason = not_run(first_flaw)
    if (
        property_.kind in ("eventually", "leads")
        and first_flaw not in OPEN
        and not model.environment.faults
    ):
        reason += _WITH_A_TIME
    return Verdict(property_, "unknown", len(graph.seen), reason, robot=me)


def _violation(
    property_: ir.Property,
    observer: Observer,
    graph: Graph,
    doubts: Sequence[Doubt],
    me: str | None,
    budget: Budget,
    *,
    shortest: bool = True,
) -> tuple[Verdict | None, str]:
    """Return the verdict if a run in a graph violates a property, or why the first does not."""
    first_flaw = ""
    if graph.bad is not None:
        run = run_to(property_, observer, graph, graph.bad)
        return violated(property_, replace(run, shortest=shortest), graph, me), run.flaw
    lassos = Lassos(graph, observer, budget)
    for lasso in islice(lassos, _MOST_LASSOS):
        if lasso.loop and any(not each.more for each in doubts):
            # What is not covered may end the loop.
            break
        run = endless(observer.network, lasso, property_, me)
        if not run.flaw:
            return violated(property_, replace(run, shortest=shortest), graph, me), ""
        first_flaw = first_flaw or run.flaw
    graph.complete &= lassos.complete
    return None, first_flaw
