"""Record a run, and check claims about it."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable, Sequence
from typing import Any

from swarmdsl.base.diagnostics.collector import listed
from swarmdsl.execution.engine import Machine
from swarmdsl.execution.monitor import FALSE, LOST, TRUE, Verdict
from swarmdsl.execution.simulate.machines.actors import Actor
from swarmdsl.execution.simulate.world.line import Line
from swarmdsl.execution.testing.case import ActionKind, Claim
from swarmdsl.execution.testing.data import describe_fields, matches
from swarmdsl.ir import Property

_REMEMBERED = 8
"""Number of trace lines shown with a failure."""
_SHOWN = 4
"""Maximum number of groups in a description."""


class _Marks(dict[int, bool]):
    """Boolean per number; `count` is the number of True values."""

    def __init__(self, marks: dict[int, bool]) -> None:
        super().__init__(marks)
        self.count = sum(marks.values())

    def __setitem__(self, number: int, mark: bool) -> None:
        self.count += mark - self[number]
        super().__setitem__(number, mark)


class Recorder:
    """Record states and actions of machines from trace lines."""

    def __init__(
        self,
        cast: Sequence[Actor],
        data: Callable[[Actor], Any],
        verdict: Callable[[str, str | None], Verdict],
    ) -> None:
        self._cast = cast
        self._data = data
        self._verdict = verdict
        """Return the verdict so far on a property, of a robot if it is about each one."""
        self._numbers = {actor: number for number, actor in enumerate(cast)}
        self._states: list[list[str]] = [[] for _ in cast]
        self._lost: set[int] = set()
        self._satisfied: dict[int, tuple[Claim, _Marks]] = {}
        """Machines that satisfy each claim checked since the last mark."""
        self._known: dict[tuple[Machine, tuple[str, ...]], frozenset[str]] = {}
        self._actions: dict[ActionKind, list[set[str]]] = {}
        self._sent: list[list[tuple[str, Any, str | None]]] = []
        self.last: deque[Line] = deque(maxlen=_REMEMBERED)
        self.mark()

    def see(self, line: Line) -> None:
        """Process a trace line."""
        self.last.append(line)
        number = self._numbers[line.actor]
        self._states[number] = line.configuration
        if line.event == LOST:
            self._lost.add(number)
        elif line.event is None:
            self._lost.discard(number)  # it started anew
        self._actions["sends"][number].update(line.sent)
        self._sent[number].extend(zip(line.sent, line.messages, line.addresses, strict=True))
        self._actions["starts"][number].update(line.started)
        self._actions["cancels"][number].update(line.cancelled)
        for claim, satisfied in self._satisfied.values():
            if number in satisfied:
                satisfied[number] = self._satisfies(claim, number)

    def mark(self) -> None:
        """Forget the previous actions."""
        for action in ("sends", "starts", "cancels"):
            self._actions[action] = [set() for _ in self._cast]
        self._sent = [[] for _ in self._cast]
        self._satisfied.clear()

    def holds(self, claim: Claim) -> bool:
        """Return True if a claim holds now; only past actions of lost machines count."""
        if claim.property is not None:
            # Also what other robots do, and time, change the verdict on a robot.
            there = [n for n in claim.who if claim.property.each is None or n not in self._lost]
            true = sum(self._judge(claim.property, number) == TRUE for number in there)
            return claim.quantity.holds(true, len(there))
        if id(claim) not in self._satisfied:
            # Cached, because each line changes only one machine.
            self._satisfied[id(claim)] = (
                claim,
                _Marks({n: self._satisfies(claim, n) for n in claim.who}),
            )
        satisfied = self._satisfied[id(claim)][1]
        gone = sum(not satisfied.get(number, True) for number in self._lost)
        return claim.quantity.holds(satisfied.count, len(satisfied) - gone)

    def _satisfies(self, claim: Claim, number: int) -> bool:
        if claim.action is not None:
            if claim.data is None and claim.to is None:
                return claim.name in self._actions[claim.action][number]
            return any(
                name == claim.name
                and (claim.data is None or matches(claim.data, data))
                and claim.to in (None, address)
                for name, data, address in self._sent[number]
            )
        if claim.values:
            held = self._data(self._cast[number])
            return number not in self._lost and matches(claim.values[number], held)
        return number not in self._lost and self._active(number).issuperset(claim.states[number])

    def _judge(self, property_: Property, number: int) -> Verdict:
        robot = self._cast[number].robot.name if property_.each is not None else None
        return self._verdict(property_.name, robot)

    def _active(self, number: int) -> frozenset[str]:
        """Return all active states of a machine."""
        machine, innermost = self._cast[number].machine, tuple(self._states[number])
        found = self._known.get((machine, innermost))
        if found is None:
            places = [machine.numbers[state] for state in innermost]
            around = {each for place in places for each in (place, *machine.ancestors(place))}
            found = frozenset(machine.states[each].id for each in around)
            self._known[machine, innermost] = found
        return found

    # ---- descriptions

    def describe_actual(self, claim: Claim) -> str:
        """Describe the actual state of the machines of a claim."""
        if claim.property is not None and claim.property.each is None:
            return f"its verdict is {self._judge(claim.property, claim.who[0])}"
        groups: dict[str, list[str]] = {}
        for number in claim.who:
            groups.setdefault(self._describe(claim, number), []).append(
                self._cast[number].name or ""
            )
        if len(groups) > _SHOWN:
            kept = list(groups)[: _SHOWN - 1]
            rest = [name for what, names in groups.items() if what not in kept for name in names]
            other = f"{claim.action} something else" if claim.action else "is elsewhere"
            other = "has other values" if claim.values else other
            groups = {**{what: groups[what] for what in kept}, other: rest}
        return ", ".join(_sentence(names, what) for what, names in groups.items())

    def _describe(self, claim: Claim, number: int) -> str:
        if number in self._lost and claim.action is None:
            return "is lost"
        if claim.property is not None:
            name = claim.property.name
            said = {TRUE: f"satisfies `{name}`", FALSE: f"violates `{name}`"}
            return said.get(self._judge(claim.property, number), f"leaves `{name}` open")
        if claim.values:
            held = self._data(self._cast[number])
            names = {claim.written.get(name, name): name for name in claim.values[number]}
            shown = {word: held.get(name) for word, name in names.items()}
            return f"has `{describe_fields(shown, shown)}`"
        if claim.data is not None or claim.to is not None:
            each = [
                _described(name, data, address, claim) if name == claim.name else name
                for name, data, address in self._sent[number]
            ]
            return f"sends {listed(list(dict.fromkeys(each)), 'and') or 'nothing'}"
        if claim.action is None:
            return f"is in {listed(self._states[number], 'and')}"
        done = sorted(self._actions[claim.action][number])
        return f"{claim.action} {listed(done, 'and') or 'nothing'}"


def _sentence(names: Sequence[str], what: str) -> str:
    verb, _, rest = what.partition(" ")
    if names == [""]:
        return what
    if len(names) > 1:
        verb = {"is": "are", "has": "have", "satisfies": "satisfy"}.get(
            verb, verb.removesuffix("s")
        )
    shown = [*names[:_SHOWN], *([f"{len(names) - _SHOWN} more"] if len(names) > _SHOWN else [])]
    return f"{_names(shown, len(names) > _SHOWN)} {verb} {rest}"


def _names(names: Iterable[str], more: bool) -> str:
    *first, last = names
    if not more:
        return listed([*first, last], "and")
    return f"{', '.join(f'`{name}`' for name in first)} and {last}"


def _described(name: str, data: Any, address: str | None, claim: Claim) -> str:
    """Describe a sent event as far as the claim is about it."""
    values = f"({describe_fields(data, claim.data)})" if claim.data is not None else ""
    to = f" to {address or 'all'}" if claim.to is not None else ""
    return f"{name}{values}{to}"
