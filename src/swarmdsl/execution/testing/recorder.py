"""What is seen of a run, and whether what is claimed of it is so."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterable, Sequence
from typing import Any

from swarmdsl.base.diagnostics.collector import listed
from swarmdsl.execution.engine import Machine
from swarmdsl.execution.simulate.actors import Actor
from swarmdsl.execution.simulate.trace import Line
from swarmdsl.execution.simulate.world import LOST
from swarmdsl.execution.testing.case import Claim, Deed
from swarmdsl.execution.testing.data import agrees
from swarmdsl.execution.testing.data import told as data_told

_REMEMBERED = 8
"""How many of the last lines are shown with a failure."""
_SHOWN = 4
"""How many groups of members a sentence tells apart."""


class _Marks(dict[int, bool]):
    """Numbers that are marked or not; `count` is how many are."""

    def __init__(self, marks: dict[int, bool]) -> None:
        super().__init__(marks)
        self.count = sum(marks.values())

    def __setitem__(self, number: int, mark: bool) -> None:
        self.count += mark - self[number]
        super().__setitem__(number, mark)


class Witness:
    """Sees the lines of a trace, and knows by them where the machines are and what they did."""

    def __init__(self, cast: Sequence[Actor], data: Callable[[Actor], Any]) -> None:
        self._cast = cast
        self._data = data
        self._numbers = {actor: number for number, actor in enumerate(cast)}
        self._states: list[list[str]] = [[] for _ in cast]
        self._lost: set[int] = set()
        self._so: dict[int, tuple[Claim, _Marks]] = {}
        """For which machines the claims are so that were asked for since the last mark."""
        self._known: dict[tuple[Machine, tuple[str, ...]], frozenset[str]] = {}
        self._done: dict[Deed, list[set[str]]] = {}
        self._sent: list[list[tuple[str, Any]]] = []
        self.last: deque[Line] = deque(maxlen=_REMEMBERED)
        self.mark()

    def see(self, line: Line) -> None:
        """Take in a line."""
        self.last.append(line)
        number = self._numbers[line.actor]
        self._states[number] = line.configuration
        if line.event == LOST:
            self._lost.add(number)
        self._done["sends"][number].update(line.sent)
        self._sent[number].extend(zip(line.sent, line.messages, strict=True))
        self._done["starts"][number].update(line.started)
        self._done["cancels"][number].update(line.cancelled)
        for claim, so in self._so.values():
            if number in so:
                so[number] = self._is_so(claim, number)

    def mark(self) -> None:
        """Forget what was done until now."""
        for deed in ("sends", "starts", "cancels"):
            self._done[deed] = [set() for _ in self._cast]
        self._sent = [[] for _ in self._cast]
        self._so.clear()

    def holds(self, claim: Claim) -> bool:
        """Whether a claim is true now; who is lost counts only for what it has done before."""
        if id(claim) not in self._so:
            # Asked after every line, of whom only one machine has changed.
            self._so[id(claim)] = claim, _Marks({n: self._is_so(claim, n) for n in claim.who})
        so = self._so[id(claim)][1]
        gone = sum(not so.get(number, True) for number in self._lost)
        return claim.quantity.holds(so.count, len(so) - gone)

    def _is_so(self, claim: Claim, number: int) -> bool:
        if claim.deed is not None:
            if claim.data is None:
                return claim.name in self._done[claim.deed][number]
            sent = (data for name, data in self._sent[number] if name == claim.name)
            return any(agrees(claim.data, data) for data in sent)
        if claim.values:
            held = self._data(self._cast[number])
            return number not in self._lost and agrees(claim.values[number], held)
        return number not in self._lost and self._active(number).issuperset(claim.states[number])

    def _active(self, number: int) -> frozenset[str]:
        """All states that a machine is in."""
        machine, innermost = self._cast[number].machine, tuple(self._states[number])
        found = self._known.get((machine, innermost))
        if found is None:
            places = [machine.numbers[state] for state in innermost]
            around = {each for place in places for each in (place, *machine.ancestors(place))}
            found = frozenset(machine.states[each].id for each in around)
            self._known[machine, innermost] = found
        return found

    # ---- in words

    def told(self, claim: Claim) -> str:
        """What is so instead of a claim."""
        groups: dict[str, list[str]] = {}
        for number in claim.who:
            groups.setdefault(self._what(claim, number), []).append(self._cast[number].name or "")
        if len(groups) > _SHOWN:
            kept = list(groups)[: _SHOWN - 1]
            rest = [name for what, names in groups.items() if what not in kept for name in names]
            other = f"{claim.deed} something else" if claim.deed else "is elsewhere"
            other = "has other values" if claim.values else other
            groups = {**{what: groups[what] for what in kept}, other: rest}
        return ", ".join(_sentence(names, what) for what, names in groups.items())

    def _what(self, claim: Claim, number: int) -> str:
        if number in self._lost and claim.deed is None:
            return "is lost"
        if claim.values:
            return f"has `{data_told(self._data(self._cast[number]), claim.values[number])}`"
        if claim.data is not None:
            each = [
                f"{name}({data_told(data, claim.data)})" if name == claim.name else name
                for name, data in self._sent[number]
            ]
            return f"sends {listed(list(dict.fromkeys(each)), 'and') or 'nothing'}"
        if claim.deed is None:
            return f"is in {listed(self._states[number], 'and')}"
        done = sorted(self._done[claim.deed][number])
        return f"{claim.deed} {listed(done, 'and') or 'nothing'}"


def _sentence(names: Sequence[str], what: str) -> str:
    verb, _, rest = what.partition(" ")
    if names == [""]:
        return what
    if len(names) > 1:
        verb = {"is": "are", "has": "have"}.get(verb, verb.removesuffix("s"))
    shown = [*names[:_SHOWN], *([f"{len(names) - _SHOWN} more"] if len(names) > _SHOWN else [])]
    return f"{_names(shown, len(names) > _SHOWN)} {verb} {rest}"


def _names(names: Iterable[str], more: bool) -> str:
    *first, last = names
    if not more:
        return listed([*first, last], "and")
    return f"{', '.join(f'`{name}`' for name in first)} and {last}"
