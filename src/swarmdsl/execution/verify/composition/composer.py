"""Compositions of a model: its subjects alone, and with each property that can be watched."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

from swarmdsl import ir
from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Span
from swarmdsl.codegen.shared.identity import neighbor_uses
from swarmdsl.execution.simulate.evaluation.properties import watchable
from swarmdsl.execution.simulate.machines.subject import Subject
from swarmdsl.execution.verify.automata.labels import Move
from swarmdsl.execution.verify.automata.limits import Budget, Limits
from swarmdsl.execution.verify.composition.plain_data import Composition, Letter, Local, Team, Turn
from swarmdsl.execution.verify.composition.watching import holding, is_owed, watch_of
from swarmdsl.execution.verify.findings.reached import transitions_of
from swarmdsl.execution.verify.proofs.observation import observer_of
from swarmdsl.execution.verify.proofs.verdict import unfinished
from swarmdsl.execution.verify.properties.observer import Observer, is_silent
from swarmdsl.execution.verify.properties.sentence import not_covered
from swarmdsl.execution.verify.report.diagnostics import conditions
from swarmdsl.execution.verify.robot.environment import Options as Network
from swarmdsl.execution.verify.swarm.groups import Group
from swarmdsl.execution.verify.swarm.model import Model
from swarmdsl.execution.verify.swarm.network import Network as States
from swarmdsl.execution.verify.swarm.sizes import shown

__all__ = ["Network", "compose", "subjects"]


def subjects(system: ir.System) -> Iterator[Subject]:
    """Yield the swarms, and the machines with properties; without swarms, all machines."""
    for swarm in system.swarms:
        yield Subject(swarm.name, system, swarm)
    about = {each.subject for each in system.judged}
    for machine in system.machines:
        if not system.swarms or machine.name in about:
            yield Subject(machine.name, system, machine=machine)


def compose(
    subject: Subject,
    counts: Mapping[str, int],
    options: Network,
    target: str,
    report: Diagnostics,
) -> Iterator[Composition]:
    """Yield a subject without a property, then with each one that a safety checker can watch.

    Others are reported, and so is what the automata do not cover. A robot that stands for
    others of its role stands for them here, too.
    """
    properties = watchable(subject)
    budget, found = Budget(Limits()), Diagnostics()
    model = Model(subject, counts, properties, options, budget, found)
    named = subject.swarm or subject.machine
    origin = named.origin if named is not None else None
    lacks = [(each.message, each.primary.span if each.primary else None) for each in found]
    if not lacks and not model.complete:
        lacks.append((unfinished(model, budget), None))
    for reason, place in lacks:
        what = f"`{subject.name}`: {reason}"
        report.report("no-place", place or origin, target=target, what=what)
    if lacks:
        return
    for reason, place in _not_shown(model):
        what = f"all runs of `{subject.name}`: {reason}"
        report.report("no-place", place or origin, target=target, what=what)
    yield _composed(model, counts, model.groups(thorough=True), None, origin)
    for property_ in properties:
        reason = _unwatched(property_)
        if reason:
            what = f"property `{property_.name}`: {reason}"
            report.report("no-place", property_.origin, target=target, what=what)
            continue
        for robot in model.one_of_each(property_):
            groups = model.groups([property_], me=robot, thorough=True)
            observer = observer_of(property_, model, groups, robot, others=False)
            if is_owed(observer.table):
                what = f"property `{property_.name}`: it is about what must happen"
                report.report("no-place", property_.origin, target=target, what=what)
                break
            yield _composed(model, counts, groups, (observer, property_, robot), origin)


def _not_shown(model: Model) -> Iterator[tuple[str, Span | None]]:
    """Yield what a composition leaves out, or adds, each with its place."""
    for doubt in model.every_doubt:
        yield doubt.reason, doubt.place
    for automaton in model.kinds:
        for actor in automaton.kind.cast:
            for _, place in neighbor_uses(model.machines[actor.machine.name]):
                yield "it has more, in which any number of robots is near", place
                return


def _unwatched(property_: ir.Property) -> str:
    """Return the reason why an automaton that watches runs does not decide a property, or ""."""
    if property_.chance is not None:
        return "it is about a probability"
    if property_.kind == "possible":
        return "`always possible` is not about single runs"
    return not_covered(property_)


def _composed(
    model: Model,
    counts: Mapping[str, int],
    groups: Sequence[Group],
    watched: tuple[Observer, ir.Property, str | None] | None,
    origin: Span | None,
) -> Composition:
    options = model.options
    observer = watched[0] if watched is not None else None
    network = (
        observer.network
        if observer is not None
        else States(groups, model.alphabet, options.capacity, lossy=options.lossy)
    )
    receivers = {
        (message.number, sender): tuple(
            number for number, group in enumerate(groups) if group.hears(message.number, source)
        )
        for message in model.alphabet.messages
        for sender, source in enumerate(groups)
    }
    start = network.start()
    watch = watch_of(*watched, groups) if watched is not None else None
    first = [network.places[place] for place, _ in network.present(start)]
    inboxes = {place.group: place.bag for place in first}
    teams = tuple(
        _team(model, number, group, inboxes[number], observer, receivers)
        for number, group in enumerate(groups)
    )
    name = model.subject.name
    if watch is not None:
        name += f"_{watch.name}"
        name += f"_{watch.robot}" if watch.robot is not None else ""
    return Composition(
        name,
        model.subject.name,
        shown(model.subject, [counts]),
        watched[1].origin if watched is not None else origin,
        tuple(_letter(model, number) for number in range(len(model.alphabet.messages))),
        teams,
        {key: found for key, found in receivers.items() if found},
        options.capacity,
        options.lossy,
        tuple(conditions(model, (), fair=False)),
        watch,
    )


def _letter(model: Model, number: int) -> Letter:
    message = model.alphabet.messages[number]
    event = message.event
    return Letter(
        event.name,
        ", ".join(f"{'.'.join(path)} = {_text(v)}" for path, v in model.alphabet.shown(event)),
        event.envelope.to or "",
        event.envelope.sender if model.demands.identity else "",
        message.reliable,
        model.system.event(event.name).origin,
    )


def _team(
    model: Model,
    number: int,
    group: Group,
    inbox: tuple[int, ...],
    observer: Observer | None,
    receivers: Mapping[tuple[int, int], tuple[int, ...]],
) -> Team:
    automaton = group.automaton
    turns: dict[Any, Turn] = {}
    arriving = {message for (message, _), teams in receivers.items() if number in teams}
    for state in range(automaton.count):
        moves = list(automaton.moves(state) or ())
        for message in range(len(model.alphabet.messages)):
            moves += automaton.moves_on(state, message) if message in arriving else ()
        for move in moves:
            turn = _turn(model, number, group, state, move, observer, receivers)
            key = (turn.source, turn.target, turn.hears, turn.sends, turn.moments)
            same = turns.get(key)
            if same is not None:
                inputs = tuple(dict.fromkeys((*same.inputs, *turn.inputs)))
                turn = Turn(*key, inputs, same.origin or turn.origin)
            turns[key] = turn
    return Team(
        group.role or model.subject.name,
        tuple(each or model.subject.name for each in group.robots),
        automaton.first.target,
        inbox,
        tuple(_local(group, number, state, observer) for state in range(automaton.count)),
        tuple(turns.values()),
        {
            message: frozenset(s for s in range(automaton.count) if automaton.is_late(s, message))
            for message in arriving
        },
    )


def _turn(
    model: Model,
    number: int,
    group: Group,
    state: int,
    move: Move,
    observer: Observer | None,
    receivers: Mapping[tuple[int, int], tuple[int, ...]],
) -> Turn:
    moments = None
    if observer is not None and not is_silent(group.automaton, state, move):
        moments = tuple(holding(observer, number, each.holding) for each in move.moments)
    return Turn(
        state,
        move.target,
        move.given.choice if move.given.kind == "hear" else None,
        tuple(each for each in move.sends if receivers[each, number]),
        moments,
        (_input(model, group, move),),
        _origin(group, move),
    )


def _input(model: Model, group: Group, move: Move) -> str:
    """Return what leads to a move: the event as in traces, and the data that decide on it."""
    kind, given = group.automaton.whole.kind, move.given
    data: Mapping[str, Any] = {}
    named = next((each.event for each in move.moments if each.event is not None), given.name)
    match given.kind:
        case "outside" if len(kind.outside.messages[given.name]) > 1:
            data = kind.outside.messages[given.name][given.choice]
        case "end" if given.choice[2] is not None and len(kind.ends[given.name].results) > 1:
            data = kind.ends[given.name].results[given.choice[2]]
        case "hear":
            letter = _letter(model, given.choice)
            return f"{named} ({letter.data})" if letter.data else named
    texts = [f"{name} = {_text(value)}" for name, value in data.items()]
    return f"{named} ({', '.join(texts)})" if texts else named


def _text(value: Any) -> str:
    """Return a value that the engine or an alphabet keeps, as text."""
    match value:
        case ("true" | "false" as truth,):
            return str(truth)
        case bool():
            return str(value).lower()
    return repr(value)


def _origin(group: Group, move: Move) -> Span | None:
    """Return the place of the first transition that a move takes."""
    for moment in move.moments:
        known = transitions_of(group.automaton.whole.kind.cast[moment.actor].machine)
        for each in moment.taken:
            if each in known:
                return known[each].origin
    return None


def _local(group: Group, number: int, state: int, observer: Observer | None) -> Local:
    automaton = group.automaton
    look = automaton.look(state)
    cast = automaton.whole.kind.cast
    names = tuple(
        name if len(cast) == 1 else f"{cast[actor].machine.name}.{name}"
        for actor, name in look.innermost
    )
    holds = holding(observer, number, look.holding) if observer is not None else frozenset()
    return Local(
        names, _shared_values(automaton.whole.values, automaton.classes, state), look.ended, holds
    )


def _shared_values(
    every: Sequence[tuple[tuple[str, Any], ...]], classes: Sequence[int], state: int
) -> str:
    """Return the values of variables that all states have which are one here."""
    found: dict[str, set[Any]] = {}
    for values, block in zip(every, classes, strict=True):
        for name, value in values if block == state else ():
            found.setdefault(name, set()).add(value)
    return ", ".join(
        f"{name} = {_text(next(iter(values)))}"
        for name, values in found.items()
        if len(values) == 1
    )
