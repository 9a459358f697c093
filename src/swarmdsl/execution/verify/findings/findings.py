"""Findings about a swarm without any property: what gets stuck, or never happens."""

from __future__ import annotations

from collections import Counter
from collections.abc import Hashable, Iterator
from functools import partial
from typing import Any

from swarmdsl.base.records import replace
from swarmdsl.base.source import Span
from swarmdsl.execution.engine import Machine
from swarmdsl.execution.verify.automata.labels import Move
from swarmdsl.execution.verify.automata.limits import Budget, LimitReachedError
from swarmdsl.execution.verify.findings.failures import MOST_RUNS, Failures, failures
from swarmdsl.execution.verify.findings.finding import Finding, Survey, not_shown
from swarmdsl.execution.verify.findings.livelock import livelock
from swarmdsl.execution.verify.findings.reached import Reached, place_of_change
from swarmdsl.execution.verify.proofs.verdict import unfinished
from swarmdsl.execution.verify.replay.play import play
from swarmdsl.execution.verify.replay.spurious import OPEN
from swarmdsl.execution.verify.search.explore import Graph, explore
from swarmdsl.execution.verify.search.run import Run, steps_between
from swarmdsl.execution.verify.swarm.groups import Group, Local, Step
from swarmdsl.execution.verify.swarm.influence import apart, sent_by
from swarmdsl.execution.verify.swarm.model import Model


def survey(model: Model, budget: Budget) -> Survey:
    """Look at all states of a swarm; groups that do not exchange messages are looked at apart."""
    states = transitions = 0
    complete = True
    findings: list[Finding] = []
    full: set[str] = set()
    open_: list[tuple[Finding, str]] = []
    reached: dict[str, Reached] = {}
    try:
        parts = list(apart(model, model.groups(thorough=True)))
    except LimitReachedError:
        return Survey(0, 0, unfinished(model, budget), ())
    for groups in parts:
        network = model.network(groups)
        graph = explore(network, budget)
        states += len(graph.seen)
        transitions += graph.transitions
        sure = graph.complete and not model.doubts(groups) and not model.awaits_members(groups)
        complete &= graph.complete
        full.update(network.full)
        part = _Part(model, graph)
        failed = part.failures(budget)
        if any(flaw in OPEN for _, flaw in failed.flaws.values()):
            # A longer run, in which robots are far from each other and hear of all, may show it.
            lonely = explore(model.network(groups, lonely=True), budget)
            failed.add(_Part(model, lonely).failures(budget))
        found = list(failed.found.values())
        try:
            for each in part.findings(sure=sure, budget=budget):
                found.append(each)
        except LimitReachedError:
            complete = sure = False
        findings += found
        open_ += [*failed.flaws.values(), *part.open.values()]
        # What ends or waits too early explains what does not happen after it.
        early = any(each.fault in ("loops", "waits", "stuck") for each in found)
        part.reach(reached, sure=sure and not early)
    ignored = {each.name for each in findings if each.fault == "lost"}
    for machine in reached.values():
        findings += machine.missing(ignored)
    missing = "" if complete else unfinished(model, budget)
    return Survey(
        states,
        transitions,
        missing,
        tuple(findings),
        tuple(sorted(full)),
        tuple(not_shown(open_, findings)),
        model.awaits_members(group for groups in parts for group in groups),
    )


class _Part:
    """One search, of groups that exchange messages."""

    def __init__(self, model: Model, graph: Graph) -> None:
        self._model = model
        self._graph = graph
        self._network = graph.network
        moves = [move for _, move in self._occurring()]
        self._sent = {message for move in moves for message in move.sends}
        self._perhaps_sent = set(self._sent)
        """Also messages that others beyond the capacity may lead to."""
        if self._network.full:
            self._perhaps_sent.update(*map(sent_by, self._network.groups))
        self.open: dict[Hashable, tuple[Finding, str]] = {}
        """Findings without a run that could be played, with the flaw of the first one."""

    def failures(self, budget: Budget) -> Failures:
        """Find guards and effects without a value, and machines that do not come to rest."""
        return failures(self._graph, budget, partial(play, self._network, []), self._run)

    def findings(self, *, sure: bool, budget: Budget) -> Iterator[Finding]:
        """Yield what else is wrong; what is missing only if the search has seen all.

        Raises LimitReachedError.
        """
        yield from self._answers(budget)
        if sure:
            trapped = set()
            for place, finding in self._trapped(budget):
                trapped.add(place)
                yield finding
            yield from self._stuck(trapped, budget)
            yield from self._lost(budget)

    def reach(self, reached: dict[str, Reached], *, sure: bool) -> None:
        """Note the states and transitions of each machine that occur."""
        for group in self._network.groups:
            for actor in group.automaton.whole.kind.cast:
                name = actor.machine.name
                if name not in reached:
                    machine = self._model.machines[name]
                    reached[name] = Reached(machine, actor.machine)
                reached[name].roles[group.role] = None
                reached[name].sure &= sure
        for group, move in self._perhaps_occurring():
            cast = group.automaton.whole.kind.cast
            for moment in move.moments:
                found = reached[cast[moment.actor].machine.name]
                found.taken.update(moment.taken)
                found.states.update(moment.entered)

    def _occurring(self) -> Iterator[tuple[Group, Move]]:
        """Yield the moves of each group."""
        for group in self._network.groups:
            yield group, group.automaton.first
        for number in self._graph.first:
            group = self._network.groups[self._network.places[number].group]
            for step in self._network.row(number):
                if step.move is not None:
                    yield group, step.move

    def _perhaps_occurring(self) -> Iterator[tuple[Group, Move]]:
        """Yield them, and if messages exceed the capacity, all that these may lead to."""
        yield from self._occurring()
        for group in self._network.groups if self._network.full else ():
            yield from ((group, move) for move in group.automaton.whole.every_move())

    def _answers(self, budget: Budget) -> Iterator[Finding]:
        """Find robots that answer each other without end."""
        if self._model.doubts(self._network.groups):
            # What is not covered may end the loop.
            return
        found = livelock(self._graph, budget)
        if found is None:
            return
        run, step = found
        assert step.move is not None
        group = self._network.groups[self._network.places[step.place].group]
        place = None
        for moment in step.move.moments:
            machine = group.automaton.whole.kind.cast[moment.actor].machine
            place = place or place_of_change(machine, moment)
        yield Finding("answers", step.move.given.name, group.role, place, run=run)

    def _trapped(self, budget: Budget) -> Iterator[tuple[tuple[int, int], Finding]]:
        """Find states that nothing leads on from, whatever comes."""
        told: dict[tuple[int, int], None] = {}
        tried: Counter[tuple[int, int]] = Counter()
        for number in sorted(self._graph.first, key=self._graph.first.__getitem__):
            group_number, state, _ = self._network.places[number]
            group = self._network.groups[group_number]
            key = (group_number, state)
            if key in told or tried[key] == MOST_RUNS or not self._is_trap(group, state):
                continue
            tried[key] += 1
            budget.check()
            run = self._run(number)
            cast = group.automaton.whole.kind.cast
            actor, name = group.automaton.look(state).innermost[0]
            found = Finding("waits", name, group.role, self._origin(cast[actor].machine, name))
            if run.flaw:
                self.open.setdefault(key, (found, run.flaw))
                continue
            told[key] = None
            self.open.pop(key, None)
            yield key, replace(found, run=run)

    def _is_trap(self, group: Group, state: int) -> bool:
        automaton = group.automaton
        look = automaton.look(state)
        if look.ended or not look.quiet or self._waits_outside(group, state):
            return False
        moves = automaton.moves(state)
        if moves is None or not all(_keeps(automaton, move, state) for move in moves):
            return False
        return all(
            _keeps(automaton, move, state)
            for message in self._perhaps_sent
            if automaton.whole.listens(message)
            for move in automaton.moves_on(state, message)
        )

    def _waits_outside(self, group: Group, state: int) -> bool:
        """Return True if a robot handles events of a scenario, which may all have come."""
        if self._model.options.scenario is None:
            return False
        cast = group.automaton.whole.kind.cast
        return any(
            edge.matches(event)
            for actor, name in group.automaton.look(state).innermost
            for edge in _edges(cast[actor].machine, name)
            for event in self._model.outside
        )

    def _stuck(self, trapped: set[tuple[int, int]], budget: Budget) -> Iterator[Finding]:
        """Find a state of the swarm in which nothing can happen, though not all have ended."""
        stuck = set(self._graph.stuck)
        for number, state in enumerate(self._graph.seen):
            if number not in stuck:
                continue
            waiting = self._waiting(state)
            if not waiting or set(waiting) & trapped:
                continue
            budget.check()
            run = play(self._network, self._steps(number), is_whole=True)
            group, local = waiting[0]
            whole = self._network.groups[group].automaton
            actor, name = whole.look(local).innermost[0]
            machine = whole.whole.kind.cast[actor].machine
            found = Finding("stuck", name, whole.whole.kind.role, self._origin(machine, name))
            if run.flaw:
                if self.open.keys().isdisjoint(waiting):
                    self.open.setdefault("stuck", (found, run.flaw))
                continue
            self.open.pop("stuck", None)
            yield replace(found, run=run)
            return

    def _waiting(self, state: int) -> list[tuple[int, int]]:
        """Return the groups and states of robots that wait in a state, if nothing can happen.

        A robot whose machines are `endless` may wait when another one has ended.
        """
        waiting: list[tuple[int, int]] = []
        patient: list[tuple[int, int]] = []
        somebody_ended = False
        for place, _ in self._network.present(state):
            group, local, _ = self._network.places[place]
            automaton = self._network.groups[group].automaton
            steps = self._network.row(place)
            if any(step.move is not None and not step.move.idle for step in steps):
                return []
            if automaton.ended(local):
                somebody_ended = True
                continue
            if self._waits_outside(self._network.groups[group], local):
                continue
            names = [actor.machine.name for actor in automaton.whole.kind.cast]
            endless = all(self._model.machines[name].endless for name in names)
            (patient if endless else waiting).append((group, local))
        return waiting if somebody_ended else waiting + patient

    def _lost(self, budget: Budget) -> Iterator[Finding]:
        """Find events that are sent, but that no robot ever handles."""
        messages = self._model.alphabet.messages
        hears = [move for _, move in self._occurring() if move.given.kind == "hear"]
        heard = {move.given.name for move in hears}
        handled = {
            move.given.name
            for _, move in self._perhaps_occurring()
            if move.given.kind == "hear" and not move.idle
        }
        sent = {messages[m].event.name for m in self._sent}
        astray = self._astray()
        for name in sorted(sent & heard - handled | sent & astray.keys() - heard):
            sends = self._model.sends(self._model.machines)
            place = next((send.origin for send in sends if send.event == name), None)
            first = next(
                (
                    (number, step.move)
                    for number in sorted(self._graph.first, key=self._graph.first.__getitem__)
                    for step in self._network.row(number)
                    if step.move is not None
                    and any(messages[m].event.name == name for m in step.move.sends)
                ),
                None,
            )
            budget.check()
            run = self._run(*first) if first is not None else None
            found = Finding("lost", name, "", place, "" if name in heard else astray[name])
            if run is not None and run.flaw:
                self.open[name] = (found, run.flaw)
            else:
                yield replace(found, run=run)

    def _astray(self) -> dict[str, str]:
        """Return events with a role that gets them and does not handle them, though others do."""
        kinds = [automaton.kind for automaton in self._model.kinds]
        found: dict[str, str] = {}
        reaching: set[str] = set()
        for message in self._perhaps_sent:
            event = self._model.alphabet.messages[message].event
            role = (event.envelope.to or "").partition("[")[0]
            there = [kind for kind in kinds if kind.role == role]
            if there and not any(kind.listens(event.name) for kind in there):
                found[event.name] = f"`{role}`"
            else:
                reaching.add(event.name)
        waited = {name for name in found if any(kind.listens(name) for kind in kinds)}
        return {name: found[name] for name in sorted(waited - reaching)}

    # ---- runs and places

    def _run(self, place: int, move: Move | None = None) -> Run:
        """Return a shortest run to a robot at a place, and its move there."""
        steps = self._steps(self._graph.first[place])
        if move is not None:
            steps.append(next(s for s in self._network.row(place) if s.move is move))
        return play(self._network, steps)

    def _steps(self, number: int) -> list[Step]:
        way = self._graph.way(number)
        return steps_between(way, lambda state: list(self._network.followers(state)))

    def _origin(self, machine: Machine, state: str) -> Span | None:
        return self._model.subject.place(machine.states[machine.numbers[state]].origin)


def _edges(machine: Machine, state: str) -> Iterator[Any]:
    """Yield the edges of a state and those around it."""
    names = state.split(".")
    for end in range(1, len(names) + 1):
        number = machine.numbers.get(".".join(names[:end]))
        if number is not None:
            yield from machine.edges[number]


def _keeps(automaton: Local, move: Move, state: int) -> bool:
    """Return True if a move changes nothing that can be seen."""
    return move.idle and move.target == state
