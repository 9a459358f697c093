"""Make the views of composed swarms: names, texts and small steps."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping

from swarmdsl.codegen import Diagnostics, FreshNames, suggest
from swarmdsl.codegen.python import source_place
from swarmdsl.execution.verify.composition import (
    SETTLED,
    VIOLATED,
    Combined,
    Composition,
    Local,
    Network,
    Reading,
    Rule,
    Team,
    Turn,
    compose,
    subjects,
)
from swarmdsl.ir import System

from .options import MOST, Options, counts_of
from .view import (
    Change,
    LetterView,
    Look,
    Loss,
    Sent,
    StateView,
    SwarmView,
    TeamView,
    TurnView,
    WatchView,
)


def views(
    system: System, options: Options, target: str, report: Diagnostics
) -> Iterator[SwarmView]:
    """Yield the views of all swarms of a system, with and without their properties."""
    counts = counts_of(options.size) or {}
    for fault, help_ in _size_faults(system, counts):
        report.report("bad-option", target=target, fault=f"`size`: {fault}", help=help_ or None)
    if report.has_errors:
        return
    network = Network(options.channel, options.lossy)
    for subject in subjects(system):
        swarm = subject.swarm
        mine = {r.name: counts[r.name] for r in (swarm.roles if swarm else ()) if r.name in counts}
        if subject.size(mine) > MOST:
            what = f"`{subject.name}`: there are more than {MOST} robots"
            report.report("no-place", swarm.origin if swarm else None, target=target, what=what)
            continue
        for composition in compose(subject, mine, network, target, report):
            yield _Viewer(composition).view()


def _size_faults(system: System, counts: Mapping[str, int]) -> Iterator[tuple[str, str]]:
    """Yield what is wrong with numbers of members, with hints."""
    known = {role.name for swarm in system.swarms for role in swarm.roles}
    for name in sorted(counts.keys() - known):
        yield f"no swarm has a role `{name}`", suggest(name, known, "roles")
    for swarm in system.swarms:
        for role in swarm.roles:
            number, allowed = counts.get(role.name), role.multiplicity
            if number is not None and not (
                allowed.lower <= number and (allowed.upper is None or number <= allowed.upper)
            ):
                yield f"`{swarm.name}` has {allowed} `{role.name}`, not {number}", ""


class _Viewer:
    def __init__(self, composition: Composition) -> None:
        self._composition = composition
        self._letters = tuple(self._letter_views())
        names, sent, states = FreshNames(), FreshNames(), FreshNames()
        roles = [team.role for team in composition.teams]
        self._names = [
            names.new(_word(team.role if roles.count(team.role) == 1 else team.robots[0]))
            for team in composition.teams
        ]
        self._states = [tuple(self._state_views(n, states)) for n in range(len(composition.teams))]
        self._sent = {
            (letter, team): Sent(
                sent.new(f"{self._letters[letter].name}_from_{self._names[team]}"),
                self._letters[letter],
                self._names[team],
                tuple(self._names[each] for each in receivers),
            )
            for (letter, team), receivers in composition.receivers.items()
            if any(letter in turn.sends for turn in composition.teams[team].turns)
        }

    def view(self) -> SwarmView:
        """Return the view."""
        made = self._composition
        teams = []
        first = 0
        for number, team in enumerate(made.teams):
            teams.append(self._team_view(number, team, first))
            first += len(team.robots)
        return SwarmView(
            made.name.replace("[", "_").replace("]", ""),
            f"{made.subject}: {made.size}",
            source_place(made.origin),
            made.origin,
            made.capacity,
            made.lossy,
            made.robots,
            made.conditions,
            self._letters,
            tuple(teams),
            tuple(self._sent.values()),
            self._watch_view(),
        )

    def _letter_views(self) -> Iterator[LetterView]:
        names, events = FreshNames(), FreshNames()
        called: dict[str, str] = {}
        for letter in self._composition.letters:
            details = [letter.data] if letter.data else []
            details += [f"from {letter.sender}"] if letter.sender else []
            details += [f"to {letter.to}"] if letter.to else []
            text = _comment(" ".join((letter.event, *(f"({each})" for each in details))))
            if letter.event not in called:
                called[letter.event] = events.new(_word(letter.event))
            name = names.new(_word(letter.event))
            yield LetterView(name, called[letter.event], text, letter.reliable, letter.origin)

    def _state_views(self, number: int, names: FreshNames) -> Iterator[StateView]:
        for local in self._composition.teams[number].locals:
            name = names.new(f"{self._names[number]}_{_word('_'.join(local.names))}")
            yield StateView(name, _comment(_state_text(local)))

    def _team_view(self, number: int, team: Team, first: int) -> TeamView:
        states = self._states[number]
        arriving = {
            letter for (letter, _), teams in self._composition.receivers.items() if number in teams
        }
        return TeamView(
            self._names[number],
            _comment(f"{len(team.robots)} {team.role}: {', '.join(team.robots)}"),
            first,
            first + len(team.robots) - 1,
            states[team.first].name,
            tuple(team.inbox.count(letter) for letter in range(len(self._letters))),
            states,
            tuple(
                view.name for view, local in zip(states, team.locals, strict=True) if local.ended
            ),
            tuple(self._turn_views(number, team)),
            tuple(
                Loss(view, tuple(states[each].name for each in sorted(team.late[letter])))
                for letter, view in enumerate(self._letters)
                if letter in arriving and self._composition.lossy and not view.reliable
            ),
        )

    def _turn_views(self, number: int, team: Team) -> Iterator[TurnView]:
        for turn in team.turns:
            looks, last = self._looks(number, team, turn)
            stays = turn.source == turn.target and turn.hears is None and not turn.sends
            if (stays and not looks) or team.locals[turn.source].ended:
                continue
            place = source_place(turn.origin)
            text = " or ".join(turn.inputs) + (f"  ({place})" if place else "")
            yield TurnView(
                self._states[number][turn.source].name,
                self._states[number][turn.target].name,
                self._letters[turn.hears] if turn.hears is not None else None,
                tuple(self._sent[each, number] for each in turn.sends),
                looks,
                last,
                team.locals[turn.target].ended,
                _comment(text),
                turn.origin,
            )

    def _looks(
        self, number: int, team: Team, turn: Turn
    ) -> tuple[tuple[Look, ...], tuple[Change, ...]]:
        """Return the looks of the watch in a turn, and the changes after the last one."""
        watch = self._composition.watch
        if watch is None:
            return (), ()
        mine = number == watch.me
        before = team.locals[turn.source].holds
        made = []
        moments: Iterable[frozenset[int]] = turn.moments or ()
        if turn.moments is None and watch.forgets:
            moments = (before,)
        for moment in moments:
            made.append(Look(_changes(before, moment, mine=mine)))
            before = moment
        return tuple(made), _changes(before, team.locals[turn.target].holds, mine=mine)

    def _watch_view(self) -> WatchView | None:
        watch = self._composition.watch
        if watch is None:
            return None
        terms = range(len(watch.terms))
        teams = self._composition.teams
        first = [sum(len(t.robots) for t in teams if n in t.locals[t.first].holds) for n in terms]
        mine = sorted({n for _, reading in watch.claims for n in _own_terms(reading)})
        held = teams[watch.me].locals[teams[watch.me].first].holds if watch.me is not None else ()
        special = {SETTLED: watch.states, VIOLATED: watch.states + 1}
        return WatchView(
            watch.name,
            _comment(watch.text),
            tuple(map(_comment, watch.terms)),
            tuple(mine),
            tuple(first),
            tuple(int(n in held) for n in mine),
            tuple((_comment(text), reading) for text, reading in watch.claims),
            special.get(watch.start, watch.start),
            watch.states,
            watch.states + 1,
            tuple(
                Rule(each.source, each.when, special.get(each.target, each.target))
                for each in watch.rules
            ),
        )


def _own_terms(reading: Reading) -> Iterator[int]:
    if isinstance(reading, Combined):
        for each in reading.parts:
            yield from _own_terms(each)
    elif reading.whose != "all":
        yield reading.term


def _changes(before: frozenset[int], after: frozenset[int], *, mine: bool) -> tuple[Change, ...]:
    return tuple(Change(term, term in after, mine) for term in sorted(before ^ after))


def _state_text(local: Local) -> str:
    text = ", ".join(local.names)
    return f"{text}; {local.values}" if local.values else text


def _word(text: str) -> str:
    """Return a text as a part of a name: letters, digits and underscores."""
    return re.sub(r"[^A-Za-z0-9_]+", "_", text).strip("_")


def _comment(text: str) -> str:
    """Return a text on one line that ends no comment, and that a preprocessor does not read."""
    return re.sub(r"\s+", " ", text).replace("*/", "* /").replace("/*", "/ *").replace("\\", "/")
