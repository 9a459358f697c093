"""What the names in a test mean: members, states, events, functions."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from functools import cached_property

from swarmdsl.base.diagnostics.collector import Diagnostics, listed
from swarmdsl.base.source import Span
from swarmdsl.base.suggest import did_you_mean, suggest
from swarmdsl.execution.engine import Kind, Machine
from swarmdsl.execution.simulate.actors import Actor
from swarmdsl.execution.simulate.subject import Subject
from swarmdsl.execution.testing.case import Deed
from swarmdsl.ir import Send as SendEffect
from swarmdsl.ir import State as ModelState
from swarmdsl.ir import StateKind, StateMachine, Type

_PASSED_THROUGH = (StateKind.CHOICE, StateKind.HISTORY)


class Names:
    """The names of what runs in a test; one that means nothing is reported."""

    def __init__(self, subject: Subject, cast: Sequence[Actor], report: Diagnostics) -> None:
        self.subject = subject
        self.cast = cast
        self._report = report
        self._abilities: dict[tuple[str, Deed], frozenset[str] | None] = {}

    def everybody(self) -> list[int]:
        """All machines."""
        return list(range(len(self.cast)))

    def members(self, word: str, place: Span) -> list[int]:
        """The machines of a robot, of a role or of a type of member, or of parts of these."""
        found = [
            number
            for number, actor in enumerate(self.cast)
            if word in actor.robot.words or word in _own_words(actor)
        ]
        if not found:
            known = {w: None for a in self.cast for w in (*a.robot.words, *_own_words(a))}
            if self.subject.swarm is None:
                help_ = f"`{self.subject.name}` runs alone: it has no name"
            else:
                roles = dict.fromkeys(actor.robot.role for actor in self.cast)
                help_ = did_you_mean(word, known) or suggest(word, roles, "roles")
            self._report.report("unresolved-name", place, kind="member", name=word, help=help_)
        return found

    def in_state(
        self, who: list[int], word: str, states: Iterable[tuple[str, Span]]
    ) -> dict[int, tuple[str, ...]]:
        """Which of the machines have the states, and which of their states are meant."""
        found: dict[int, tuple[str, ...]] = dict.fromkeys(who, ())
        for name, place in states:
            meant = {n: self._state(self.cast[n].machine, name) for n in found}
            if not any(meant.values()):
                ids = [i for n in found for i in _states(self.cast[n].machine)]
                known = dict.fromkeys([*ids, *(i.rpartition(".")[2] for i in ids)])
                help_ = did_you_mean(name, known) or suggest(name, dict.fromkeys(ids), "states")
                self._report.report("unresolved-name", place, kind="state", name=name, help=help_)
                return {}
            unclear = next((ids for ids in meant.values() if len(ids) > 1), None)
            if unclear is not None:
                help_ = f"write {listed(unclear)}"
                self._report.report("ambiguous-name", place, name=name, help=help_)
                return {}
            found = {n: (*found[n], *meant[n]) for n in found if meant[n]}
        own = {n: ids for n, ids in found.items() if word in ("", *_own_words(self.cast[n]))}
        return own or found

    def able(self, who: list[int], word: str, deed: Deed, name: str, place: Span) -> list[int]:
        """Those of the machines that can do something with a name; none is reported."""
        kind = "event" if deed == "sends" else "function"
        if not self.is_known(kind, name, place):
            return []
        able = [n for n in who if self._can(self.cast[n].machine, deed, name)]
        if not able:
            called = f"`{word}`" if word else f"`{self.subject.name}`"
            verb = "sends" if deed == "sends" else "calls"
            self._report.report("impossible-step", place, reason=f"{called} never {verb} `{name}`")
        return [n for n in able if word in ("", *_own_words(self.cast[n]))] or able

    def holders(self, who: list[int], word: str, named: Iterable[tuple[str, Span]]) -> list[int]:
        """Those of the machines that have all these variables; one that none has is reported."""
        for name, place in named:
            known = {n: self.variables(self.cast[n].machine) for n in who}
            found = [n for n, types in known.items() if types is None or name in types]
            if not found:
                names = dict.fromkeys(each for types in known.values() for each in types or ())
                help_ = suggest(name, names, "variables")
                self._report.report(
                    "unresolved-name", place, kind="variable", name=name, help=help_
                )
                return []
            who = found
        return [n for n in who if word in ("", *_own_words(self.cast[n]))] or who

    def variables(self, machine: Machine) -> Mapping[str, Type] | None:
        """The variables and params of a machine; of documents little is known."""
        if self.subject.system is None:
            return None
        model = next(each for each in self.subject.system.machines if each.name == machine.name)
        params = {each.name: each.type for each in model.params}
        return {**params, **{each.name: each.type for each in model.variables}}

    def is_known(self, kind: str, name: str, place: Span) -> bool:
        """Whether there is an event or a function of that name; of documents little is known."""
        known = self._events if kind == "event" else self._functions
        if known is None or name in known:
            return True
        help_ = suggest(name, known, f"{kind}s")
        self._report.report("unresolved-name", place, kind=kind, name=name, help=help_)
        return False

    @cached_property
    def _events(self) -> list[str] | None:
        system = self.subject.system
        return [each.name for each in system.events] if system is not None else None

    @cached_property
    def _functions(self) -> list[str]:
        """The functions that are called at all."""
        machines = dict.fromkeys(actor.machine for actor in self.cast)
        found = {s.activity.name: None for m in machines for s in m.states if s.activity}
        return list(found)

    def _can(self, machine: Machine, deed: Deed, name: str) -> bool:
        key = (machine.name, deed)
        if key not in self._abilities:
            self._abilities[key] = self._find(machine, deed)
        can = self._abilities[key]
        return can is None or name in can

    def _find(self, machine: Machine, deed: Deed) -> frozenset[str] | None:
        if deed != "sends":
            return frozenset(s.activity.name for s in machine.states if s.activity)
        system = self.subject.system
        if system is None:
            return None
        model = next(each for each in system.machines if each.name == machine.name)
        return frozenset(_sent(model))

    def _state(self, machine: Machine, name: str) -> list[str]:
        ids = _states(machine)
        return [name] if name in ids else [each for each in ids if each.endswith(f".{name}")]


def _own_words(actor: Actor) -> tuple[str, ...]:
    """What a machine itself is meant by: with the part, where it is that of a part."""
    robot = actor.robot
    part = (actor.name or "")[len(robot.name or "") :]
    return tuple(f"{word}{part}" for word in robot.words)


def _states(machine: Machine) -> list[str]:
    """The states that a machine can be in when it has come to rest."""
    return [
        state.id
        for state in machine.states[1:]
        if state.kind not in (Kind.HISTORY, Kind.DEEP_HISTORY)
        and not (isinstance(state.origin, ModelState) and state.origin.kind in _PASSED_THROUGH)
    ]


def _sent(machine: StateMachine) -> Iterable[str]:
    for state in machine.walk():
        effects = [*state.entry, *state.exit]
        effects += [effect for each in state.transitions for effect in each.effects]
        yield from (effect.event for effect in effects if isinstance(effect, SendEffect))
