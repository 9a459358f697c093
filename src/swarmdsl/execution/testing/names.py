"""Resolve the names in tests: members, states, events, functions."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import cached_property

from swarmdsl.analysis.resolve.sentences import matches
from swarmdsl.base.diagnostics.collector import Diagnostics, listed
from swarmdsl.base.source import Span
from swarmdsl.base.suggest import did_you_mean, suggest
from swarmdsl.execution.engine import Kind, Machine
from swarmdsl.execution.simulate.machines.actors import Actor
from swarmdsl.execution.simulate.machines.subject import Subject
from swarmdsl.execution.testing.case import ActionKind
from swarmdsl.ir import Send as SendEffect
from swarmdsl.ir import State as ModelState
from swarmdsl.ir import StateKind, StateMachine, Variable

_PASSED_THROUGH = (StateKind.CHOICE, StateKind.HISTORY)


class Names:
    """Scope of a test; unresolved names are reported."""

    def __init__(self, subject: Subject, cast: Sequence[Actor], report: Diagnostics) -> None:
        self.subject = subject
        self.cast = cast
        self._report = report
        self._abilities: dict[tuple[str, ActionKind], frozenset[str] | None] = {}

    def all_machines(self) -> list[int]:
        """Return all machines."""
        return list(range(len(self.cast)))

    def members(self, word: str, place: Span) -> list[int]:
        """Return the machines of a robot, role, type of member, or part of one."""
        found = [
            number
            for number, actor in enumerate(self.cast)
            if word in actor.robot.words or word in _own_words(actor)
        ]
        if not found:
            known = {w: None for a in self.cast for w in (*a.robot.words, *_own_words(a))}
            if self.subject.swarm is None:
                help_ = f"`{self.subject.name}` is a single machine without members"
            else:
                roles = dict.fromkeys(actor.robot.role for actor in self.cast)
                help_ = did_you_mean(word, known) or suggest(word, roles, "roles")
            self._report.report("unresolved-name", place, kind="member", name=word, help=help_)
        return found

    def in_state(
        self, who: list[int], word: str, states: Iterable[tuple[str, Span]]
    ) -> dict[int, tuple[str, ...]]:
        """Return the machines that have the states, with the ids of these."""
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

    def machines_able(
        self,
        who: list[int],
        word: str,
        action: ActionKind,
        name: str,
        place: Span,
        *,
        skips: bool = False,
    ) -> list[int]:
        """Return the machines that can do an action; report if none can, unless that is skipped."""
        kind = "event" if action == "sends" else "function"
        if not self.is_known(kind, name, place):
            return []
        able = [n for n in who if self._can(self.cast[n].machine, action, name)]
        if not able and not skips:
            called = f"`{word}`" if word else f"`{self.subject.name}`"
            verb = "sends" if action == "sends" else "calls"
            self._report.report("impossible-step", place, reason=f"{called} never {verb} `{name}`")
        return [n for n in able if word in ("", *_own_words(self.cast[n]))] or able

    def machines_with(
        self, who: list[int], word: str, named: Iterable[tuple[str, Span]]
    ) -> list[int]:
        """Return the machines with all the variables; report a variable that none has."""
        for name, place in named:
            meant = {n: self.variables(self.cast[n].machine, name) for n in who}
            found = [n for n, each in meant.items() if each is None or each]
            if not found:
                known = [each for n in who for each in self._values(self.cast[n].machine)]
                names = dict.fromkeys(each.local or each.name for each in known)
                help_ = suggest(name, names, "variables")
                self._report.report(
                    "unresolved-name", place, kind="variable", name=name, help=help_
                )
                return []
            unclear = next(
                (each for each in meant.values() if each is not None and len(each) > 1), ()
            )
            if unclear:
                help_ = f"write {listed([f'{each.owner}.{each.local}' for each in unclear], 'or')}"
                self._report.report("ambiguous-name", place, name=name, help=help_)
                return []
            who = found
        return [n for n in who if word in ("", *_own_words(self.cast[n]))] or who

    def variables(self, machine: Machine, name: str) -> Sequence[Variable] | None:
        """Return the variables and params that a name means; None for a document.

        A variable of a state has its name, or a path: `tries`, `Search.tries`.
        """
        if self.subject.system is None:
            return None
        values = self._values(machine)
        exact = [each for each in values if each.name == name]
        written = tuple(name.split("."))
        return exact or [
            each
            for each in values
            if each.owner and matches((*each.owner.split("."), each.local), written)
        ]

    def _values(self, machine: Machine) -> Sequence[Variable]:
        """Return the variables of a machine, and its params as variables."""
        if self.subject.system is None:
            return ()
        model = self.subject.system.machines_by_name[machine.name]
        params = (Variable(each.name, each.type, each.default) for each in model.params)
        return (*params, *model.variables)

    def is_known(self, kind: str, name: str, place: Span) -> bool:
        """Return True if an event or function exists, or may exist in a document."""
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
        """The functions that are called."""
        machines = dict.fromkeys(actor.machine for actor in self.cast)
        found = {s.activity.name: None for m in machines for s in m.states if s.activity}
        return list(found)

    def _can(self, machine: Machine, action: ActionKind, name: str) -> bool:
        key = (machine.name, action)
        if key not in self._abilities:
            self._abilities[key] = self._find(machine, action)
        can = self._abilities[key]
        return can is None or name in can

    def _find(self, machine: Machine, action: ActionKind) -> frozenset[str] | None:
        if action != "sends":
            return frozenset(s.activity.name for s in machine.states if s.activity)
        system = self.subject.system
        if system is None:
            return None
        model = system.machines_by_name[machine.name]
        return frozenset(_sent(model))

    def _state(self, machine: Machine, name: str) -> list[str]:
        """Return the states that a name or a path means; it can leave out names in between."""
        ids, written = _states(machine), tuple(name.split("."))
        if name in ids:
            return [name]
        ends = [each for each in ids if each.endswith(f".{name}")]
        return ends or [each for each in ids if matches(tuple(each.split(".")), written)]


def _own_words(actor: Actor) -> tuple[str, ...]:
    """Return the words that select a machine; with the part, for that of a part."""
    robot = actor.robot
    part = (actor.name or "")[len(robot.name or "") :]
    return tuple(f"{word}{part}" for word in robot.words)


def _states(machine: Machine) -> list[str]:
    """Return the states in which a machine can come to rest."""
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
