"""Proofs that something is always possible, by a search backwards."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from itertools import combinations

from swarmdsl import ir
from swarmdsl.execution.verify.automata.limits import Budget
from swarmdsl.execution.verify.proofs.verdict import Verdict, unfinished, violated
from swarmdsl.execution.verify.replay.play import play
from swarmdsl.execution.verify.replay.spurious import exceeding
from swarmdsl.execution.verify.replay.timed_runs import play_timed
from swarmdsl.execution.verify.search.explore import explore, follow
from swarmdsl.execution.verify.search.run import Run, steps_between
from swarmdsl.execution.verify.swarm.groups import Group
from swarmdsl.execution.verify.swarm.model import Model
from swarmdsl.execution.verify.swarm.network import Network
from swarmdsl.execution.verify.swarm.propositions import Terms
from swarmdsl.execution.verify.swarm.timed_network import TimedNetwork

_OFTEN = 256
"""Number of states between two looks at the time."""


def prove_possible(
    property_: ir.Property,
    model: Model,
    network: Network,
    mine: int | None,
    me: str | None,
    budget: Budget,
) -> Verdict:
    """Search backwards from the states in which the claim holds; raises LimitReachedError."""
    is_timed = isinstance(network, TimedNetwork)
    graph = follow(network, budget) if is_timed else explore(network, budget)
    states = len(graph.seen)
    doubts = model.doubts(network.groups)
    if doubts:
        return Verdict(property_, "unknown", states, doubts[0].reason, doubts[0].place, me)
    if not graph.complete:
        reason = unfinished(model, budget)
        full = tuple(sorted(network.full))
        return Verdict(property_, "up to", states, reason, robot=me, full=full)
    holds = _state_truth(property_, network, mine)
    numbers = {state: number for number, state in enumerate(graph.seen)}
    before: dict[int, list[int]] = {}
    overflowing: list[int] = []
    for state, number in numbers.items():
        if not number % _OFTEN:
            budget.check()
        # A loss of a robot makes nothing possible.
        for following, step in network.followers(state):
            is_loss = step.move is not None and step.move.given.kind == "lose"
            if not is_loss and following != state:
                before.setdefault(numbers[following], []).append(number)
            if network.full and network.overflows(state, step):
                overflowing.append(number)
    able = bytearray(states)
    _mark([number for state, number in numbers.items() if holds(state)], before, able)
    lost = able.find(0)
    if lost < 0:
        reason = _unsure(model, network)
        if reason:
            return Verdict(property_, "unknown", states, reason, robot=me)
        return Verdict(property_, "holds", states, robot=me, full=tuple(sorted(network.full)))
    # With more room for messages, more may be possible.
    _mark(overflowing, before, able)
    lost = able.find(0)
    if lost < 0:
        run = Run((), flaw=exceeding(network.capacity, min(network.full)))
        return violated(property_, run, graph, me)
    steps = steps_between(graph.way(lost), lambda s: list(network.followers(s)))
    if isinstance(network, TimedNetwork):
        run = play_timed(network, steps, ended=True)
    else:
        run = play(network, steps, is_whole=True)
    return violated(property_, run, graph, me)


def _mark(numbers: Sequence[int], before: Mapping[int, Sequence[int]], able: bytearray) -> None:
    """Mark states, and those from which one of them can be reached."""
    todo = list(numbers)
    while todo:
        number = todo.pop()
        if not able[number]:
            able[number] = 1
            todo += before.get(number, ())


def _unsure(model: Model, network: Network) -> str:
    """Return the reason why less may be possible than in the network, or ""."""
    is_timed = isinstance(network, TimedNetwork)
    if not is_timed and (_has_delays(model, network.groups) or network.timing is not None):
        return "whether it is possible may depend on the lengths of delays"
    if model.returns:
        return "whether it is possible may depend on when robots come back"
    if model.guesses:
        return "whether it is possible may depend on which robots are taken for lost"
    if any(group.automaton.whole.asks_who_is_near for group in network.groups):
        return "whether it is possible may depend on who is near"
    topic = _reordered(model, network)
    return f"whether it is possible may depend on the order of events on `{topic}`" if topic else ""


def _state_truth(
    property_: ir.Property, network: Network, mine: int | None
) -> Callable[[int], bool]:
    """Return the truth of the claim of a property in a state."""
    terms = Terms(property_, network)
    truth = terms.truth(property_.claims[0])

    def holds(state: int) -> bool:
        counts = [0] * len(terms)
        me = [0] * len(terms)
        for place, count in network.present(state):
            group, local, _ = network.places[place]
            bits = network.groups[group].automaton.look(local).holding
            for term in range(len(terms)):
                held = terms.holds(term, group, bits)
                counts[term] += held * count
                if group == mine:
                    me[term] = held
        return bool(truth(counts, me))

    return holds


def _reordered(model: Model, network: Network) -> str:
    """Return a topic of which different messages of a sender may be on their way, or ""."""
    for place in network.places:
        messages = {network.message(each) for each in place.bag}
        events = [model.alphabet.messages[each].event for each in messages]
        for one, other in combinations(events, 2):
            topic = model.system.event(one.name).topic
            same_sender = one.envelope.sender == other.envelope.sender
            if topic == model.system.event(other.name).topic and (
                same_sender or not model.demands.identity
            ):
                return topic
    return ""


def _has_delays(model: Model, groups: Sequence[Group]) -> bool:
    """Return True if a machine of some groups has a delay."""
    names = {actor.machine.name for g in groups for actor in g.automaton.whole.kind.cast}
    return any(
        isinstance(trigger, ir.TimeTrigger)
        for name in names
        for state in model.machines[name].walk()
        for transition in state.transitions
        for trigger in transition.triggers
    ) or any(send.delay is not None for send in model.sends(names))
