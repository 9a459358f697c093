"""Proofs with clocks: functions and delays take the times of a scenario and of the model.

First only robots that a property is about have clocks, then all that can influence them.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Sequence
from math import ceil, gcd

from swarmdsl import ir
from swarmdsl.base.records import replace
from swarmdsl.execution.simulate.machines.actors import Actor
from swarmdsl.execution.simulate.machines.expressions import function_of
from swarmdsl.execution.simulate.scenario.durations import SECOND, format_duration
from swarmdsl.execution.verify.abstraction.doubt import Doubt
from swarmdsl.execution.verify.abstraction.places import is_constant
from swarmdsl.execution.verify.automata.automaton import Automaton
from swarmdsl.execution.verify.automata.clock_classes import classes_of
from swarmdsl.execution.verify.automata.clocks import ClockedAutomaton
from swarmdsl.execution.verify.automata.limits import Budget, Limits
from swarmdsl.execution.verify.proofs.possible import prove_possible
from swarmdsl.execution.verify.proofs.verdict import Verdict, unfinished, violated
from swarmdsl.execution.verify.properties.clock_table import ClockTable
from swarmdsl.execution.verify.properties.sentence import is_about_ends, length_of, table_of
from swarmdsl.execution.verify.properties.timed_observer import TimedObserver
from swarmdsl.execution.verify.replay.timed_runs import violating
from swarmdsl.execution.verify.search.explore import Graph, observe
from swarmdsl.execution.verify.search.run import steps_between
from swarmdsl.execution.verify.search.settling import observe_settling
from swarmdsl.execution.verify.search.unfolding import unfold, unfolded
from swarmdsl.execution.verify.swarm.groups import Group
from swarmdsl.execution.verify.swarm.influence import cone
from swarmdsl.execution.verify.swarm.machines import delays_of
from swarmdsl.execution.verify.swarm.model import Model
from swarmdsl.execution.verify.swarm.propositions import facts_of, is_act, mask_of
from swarmdsl.execution.verify.swarm.subjects import DEADLINES, about, expects_in_time, place_of
from swarmdsl.execution.verify.swarm.timed_network import TimedNetwork

_MOST_SOUGHT = 20_000
"""Number of states of a search that is no proof."""


def not_with_clocks(property_: ir.Property, model: Model, me: str | None) -> Doubt | None:
    """Return the reason why clocks do not decide on a property, None if they may."""
    return next(iter(model.doubts(_Proof(property_, model, me, Budget(Limits())).cone)), None)


def prove_exactly(
    property_: ir.Property, model: Model, me: str | None, budget: Budget, known: Verdict
) -> Verdict:
    """Decide on a property with clocks, which `known` leaves open without them."""
    proof = _Proof(property_, model, me, budget)
    doubt = next(iter(model.doubts(proof.cone)), None)
    if doubt is not None:
        reason = f"{known.reason}; clocks do not decide: {doubt.reason}"
        return replace(known, reason=reason, place=doubt.place)
    if is_about_ends(property_) or budget.is_over():
        return known
    if not model.complete and (property_.kind == "possible" or proof.varies):
        reason = f"{known.reason}; clocks do not decide: {unfinished(model, budget)}"
        return replace(known, reason=reason)
    return proof.verdict()


def seek_late(
    property_: ir.Property, model: Model, me: str | None, budget: Budget
) -> Verdict | None:
    """Look for a run with clocks in which what must happen in time does not, without a proof.

    The search is a short one, from states near the start to rest.
    """
    proof = _Proof(property_, model, me, budget)
    if property_.within is None or (not model.complete and proof.varies):
        return None
    return proof.sought()


class _Proof:
    """Search with clocks for one property, of one robot if it is about each."""

    def __init__(
        self, property_: ir.Property, model: Model, me: str | None, budget: Budget
    ) -> None:
        self._property = property_
        self._model = model
        self._me = me
        self._budget = budget
        self._every = model.groups([property_], me=me)
        self._about = set(about(property_, model, self._every))
        mine = place_of(me, self._every)
        if mine is not None:
            self._about.add(mine)
        self.cone = cone(model, self._every, self._about) or self._every
        self._growing: dict[Automaton, Automaton] = {}

    @property
    def varies(self) -> bool:
        """True if the lengths of delays depend on data, so that not all of them are known."""
        machines = self._model.machines.values()
        return not all(map(is_constant, delays_of(machines)))

    def verdict(self) -> Verdict:
        """Return the verdict."""
        some = [self._every[number] for number in self._about]
        if self._property.kind == "possible":
            return self._possible()
        if some and len(some) < len(self.cone):
            found = self._search(self.cone, some)
            if found.outcome == "holds":
                names = ", ".join(sorted({group.role for group in some}))
                return replace(found, reason=f"with clocks of {names}, others take any time")
            if found.outcome == "fails":
                return found
        return self._search(self.cone, self.cone)

    def sought(self) -> Verdict | None:
        """Return the verdict if a violation is near the way to rest."""
        tick = self._tick_of(self._every)
        groups = [self._clocked(each, tick) for each in self._every]
        clock = self._clock(tick)
        network = self._network(groups, tick, max(clock.size, 2).bit_length())
        observer = self._observer(network, others=False)
        some = self._budget.some(_MOST_SOUGHT)
        graph = observe_settling(observer, some)
        if graph.bad is None:
            return None
        way = graph.way(graph.bad)
        steps = steps_between(way, lambda state: list(observer.successors(state)))
        run = violating(network, steps, self._property, ended=False)
        found = violated(self._property, replace(run, shortest=False), graph, self._me)
        return found if found.run is not None else None

    def _search(self, groups: Sequence[Group], clocked: Collection[Group]) -> Verdict:
        """Look for a violation in a swarm in which some groups have clocks."""
        in_time = expects_in_time(self._model, self._every)
        others = len(groups) < len(self._every) or in_time
        observer = self._classes(groups, clocked, others=others)
        graph = observe(observer.network, observer, self._budget)
        if graph.bad is not None and observer.others:
            # Whether others act at that moment is known only with all of them.
            more = self._every if len(clocked) == len(groups) else clocked
            observer = self._classes(self._every, more, others=False)
            graph = observe(observer.network, observer, self._budget)
            if graph.bad is None and in_time:
                states = len(graph.seen)
                return Verdict(self._property, "unknown", states, DEADLINES, robot=self._me)
        if graph.bad is not None:
            return self._violated(observer, graph)
        states, full = len(graph.seen), tuple(sorted(graph.network.full))
        if graph.complete:
            return Verdict(self._property, "holds", states, robot=self._me, full=full)
        reason = f"{unfinished(self._model, self._budget)}; {self._rounding(clocked)}"
        return Verdict(self._property, "up to", states, reason, robot=self._me, full=full)

    def _violated(self, classes: TimedObserver, graph: Graph) -> Verdict:
        assert graph.bad is not None
        network = classes.timed
        made = self._network([*map(unfolded, network.groups)], network.tick, network.base)
        observer = self._observer(made, others=classes.others)
        way = unfold(observer, classes, graph.way(graph.bad))
        steps = steps_between(way, lambda state: list(observer.successors(state)))
        ended = not observer.is_bad(way[-1])
        run = violating(observer.timed, steps, self._property, ended=ended)
        return violated(self._property, run, graph, self._me)

    def _classes(
        self, groups: Sequence[Group], clocked: Collection[Group], *, others: bool
    ) -> TimedObserver:
        """Return the observer of a swarm in which states are one that no run can tell apart."""
        tick = self._tick_of(clocked)
        made = [self._clocked(each, tick) if each in clocked else each for each in groups]
        clock = self._clock(tick)
        network = self._network([*map(self._folded, made)], tick, max(clock.size, 2).bit_length())
        return self._observer(network, others=others)

    def _observer(self, network: TimedNetwork, *, others: bool) -> TimedObserver:
        mine = place_of(self._me, network.groups)
        clock = self._clock(network.tick)
        return TimedObserver(self._property, clock, network, mine, others=others)

    def _clock(self, tick: int) -> ClockTable:
        return ClockTable(table_of(self._property), (length_of(self._property) or 0) // tick)

    def _network(self, groups: Sequence[Group], tick: int, base: int = 0) -> TimedNetwork:
        model, options = self._model, self._model.options
        return TimedNetwork(
            groups,
            model.alphabet,
            options.capacity,
            lossy=model.environment.lossy,
            timing=options.timing,
            tick=tick,
            base=base,
        )

    def _clocked(self, group: Group, tick: int) -> Group:
        whole = group.automaton.whole
        mask = mask_of(whole.kind.facts, [self._property])
        robot = whole.kind.cast[0].robot
        timing = self._model.options.timing
        grow: Callable[[], bool] | None = None
        if not whole.is_complete:
            # Classes of the states that are known are those of no more.
            whole = self._growing.setdefault(whole, Automaton(whole.kind, whole.alphabet))
            grow = self._goes_on
        automaton = ClockedAutomaton(
            whole, mask, tick, lambda name: timing.function(name, robot), grow=grow
        )
        return Group(automaton, group.robots)

    def _goes_on(self) -> bool:
        return self._budget.allows(0)

    def _folded(self, group: Group) -> Group:
        if not isinstance(group.automaton, ClockedAutomaton) or group.automaton.grows:
            return group
        forgets = any(map(is_act, facts_of(self._property)))
        classes = classes_of(group.automaton, steps_count=forgets)
        return group if classes is None else Group(classes, group.robots)

    def _possible(self) -> Verdict:
        tick = self._tick_of(self.cone)
        network = self._network([self._clocked(each, tick) for each in self.cone], tick)
        mine = place_of(self._me, self.cone)
        found = prove_possible(self._property, self._model, network, mine, self._me, self._budget)
        if found.outcome == "holds" and not self._has_whole_ticks():
            # What is possible at a tick need not be so between two of them.
            reason = (
                "whether it is possible may depend on when events come from outside and how long "
                "things take: try `--scenario` with durations that do not vary, and nothing from "
                "outside"
            )
            return replace(found, outcome="unknown", reason=reason)
        return found

    def _has_whole_ticks(self) -> bool:
        """Return True if all that happens does so at a tick, in all runs."""
        timing = self._model.options.timing
        kinds = [group.automaton.whole.kind for group in self.cone]
        spans = [timing.function(f, kind.cast[0].robot) for kind in kinds for f in kind.ends]
        spans += [timing.message(repeats=each.repeats) for each in self._model.alphabet.messages]
        is_fixed = all(least == most for least, most in spans)
        return is_fixed and not any(kind.outside.messages for kind in kinds)

    # ---- ticks

    def _tick_of(self, clocked: Collection[Group]) -> int:
        return gcd(*self._lengths(clocked)) or SECOND

    def _lengths(self, clocked: Collection[Group]) -> Iterator[int]:
        """Yield the lengths that clocks must measure."""
        timing = self._model.options.timing
        within = length_of(self._property)
        if within is not None:
            yield within
        for group in clocked:
            whole = group.automaton.whole
            calls = {slot.name for slots in whole.slots for slot in slots if slot.name}
            if not whole.is_complete:
                calls = set(whole.kind.ends)
                yield from self._lengths_of_delays(whole.kind.cast)
            for name in calls:
                yield from (
                    each for each in timing.function(name, whole.kind.cast[0].robot) if each
                )
            yield from whole.lengths()
        if self._model.alphabet.messages or not self._model.complete:
            yield from (each for each in timing.message(repeats=False) if each)

    def _lengths_of_delays(self, cast: Sequence[Actor]) -> Iterator[int]:
        """Yield the lengths that all delays of a robot have whatever happens."""
        for actor in cast:
            for each in delays_of([self._model.machines[actor.machine.name]]):
                length = ceil(function_of(each)(actor.data, None))
                if length > 0:
                    yield length

    def _rounding(self, clocked: Collection[Group]) -> str:
        """Return the tick of the clocks, and the length to round for a longer one."""
        lengths = sorted(set(self._lengths(clocked)))
        tick = gcd(*lengths) or SECOND
        told = f"clocks have ticks of {format_duration(tick)}"
        best = max(lengths, key=lambda each: gcd(*(o for o in lengths if o != each)), default=0)
        longer = gcd(*(each for each in lengths if each != best))
        if longer > tick:
            rounded = format_duration(max(round(best / longer), 1) * longer)
            told += f": round {format_duration(best)} to {rounded} for {format_duration(longer)}"
        return told
