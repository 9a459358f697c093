"""Observers of properties in the groups of a swarm, and the runs that they have found."""

from __future__ import annotations

from collections.abc import Sequence

from swarmdsl import ir
from swarmdsl.base.records import replace
from swarmdsl.execution.verify.properties.observer import Observer
from swarmdsl.execution.verify.properties.sentence import is_about_ends, length_of, table_of
from swarmdsl.execution.verify.properties.timed_observer import LateObserver
from swarmdsl.execution.verify.replay.late_runs import late
from swarmdsl.execution.verify.replay.play import play
from swarmdsl.execution.verify.search.explore import Graph
from swarmdsl.execution.verify.search.run import Run, steps_between
from swarmdsl.execution.verify.swarm.groups import Group
from swarmdsl.execution.verify.swarm.model import Model
from swarmdsl.execution.verify.swarm.subjects import place_of


def observer_of(
    property_: ir.Property,
    model: Model,
    groups: Sequence[Group],
    me: str | None,
    *,
    others: bool,
    eager: bool = False,
    lonely: bool = False,
    timed: bool = False,
) -> Observer:
    """Return the observer of a property in some groups, of one robot if it is about each.

    Runs of a property with `within` must fit times, and all runs with `timed`.
    """
    table = table_of(property_)
    is_timed = property_.within is not None
    # What must happen is asked of robots that are there.
    spared = me if is_about_ends(property_) else None
    network = model.network(
        groups,
        base=max(table.size, 2).bit_length(),
        timed=is_timed or timed,
        spared=spared,
        eager=eager,
        lonely=lonely,
    )
    mine = place_of(me, groups)
    if is_timed:
        return LateObserver(property_, table, network, mine, others=others)
    return Observer(property_, table, network, mine, others=others)


def run_to(property_: ir.Property, observer: Observer, graph: Graph, bad: int) -> Run:
    """Return a run to a state that violates a property, at once or if nothing follows."""
    way = graph.way(bad)
    steps = steps_between(way, lambda state: list(observer.successors(state)))
    is_bad = observer.is_bad(way[-1])
    within = length_of(property_)
    if within is not None:
        return late(observer.network, steps, property_, within, ended=not is_bad)
    run = play(observer.network, steps, property_, ended=not is_bad)
    return run if is_bad else replace(run, loop=0)
