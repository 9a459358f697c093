"""Conditions that hold together, and the search for values for which they do.

At one moment a term has one value, the same in all conditions. "Not satisfiable" is certain; a
search that would take too long answers "satisfiable".
"""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Iterator

from swarmdsl.analysis.checks.facts import Atom, Combined, Condition
from swarmdsl.analysis.checks.value_sets import Values

# Limit of the search; guards in real models need far fewer steps.
_MAX_STEPS = 2_000

_Term = tuple[Hashable, type[Values]]
# Disjunctions, the next one first: the rest is shared by all branches of the search.
_Forks = tuple[Combined, "_Forks"] | None


class Conjunction:
    """Conditions that are added one by one, and that a search leaves as they are."""

    def __init__(self, conditions: Iterable[Condition] = ()) -> None:
        self._found: dict[_Term, Values] = {}
        self._forks: _Forks = None
        self._possible = True
        self.add(*conditions)

    def add(self, *conditions: Condition) -> None:
        """Add conditions."""
        if self._possible:
            self._possible, self._forks = self._hold([*conditions], self._forks, [])

    def search(self, *conditions: Condition, steps: int = _MAX_STEPS) -> bool | None:
        """Return True or False if conditions can or cannot hold with these; None if unknown.

        Disjunctions are tried in turn, at most as many parts of them as `steps`.
        """
        # What to restore when a part is given up: a term with its values before.
        trail: list[tuple[_Term, Values | None]] = []
        choices: list[tuple[int, _Forks, Iterator[Condition]]] = []
        holds, forks = self._possible, self._forks
        if holds:
            holds, forks = self._hold([*conditions], forks, trail)
        try:
            for _ in range(steps):
                if holds:
                    if forks is None:
                        return True
                    first, forks = forks
                    choices.append((len(trail), forks, iter(first.parts)))
                part = None
                while part is None:
                    if not choices:
                        return False
                    mark, forks, parts = choices[-1]
                    self._restore(trail, mark)
                    part = next(parts, None)
                    if part is None:
                        choices.pop()
                holds, forks = self._hold([part], forks, trail)
            return None
        finally:
            self._restore(trail, 0)

    def _hold(
        self, pending: list[Condition], forks: _Forks, trail: list[tuple[_Term, Values | None]]
    ) -> tuple[bool, _Forks]:
        """Restrict the values of terms; return False if one has none left, and the forks."""
        atoms: dict[_Term, list[Values]] = {}
        while pending:
            part = pending.pop()
            if isinstance(part, Atom):
                # The kind of set is a part of the key, so all sets of a term are of one kind.
                term = (part.term, type(part.range))
                if term in atoms:
                    atoms[term].append(part.values)
                else:
                    atoms[term] = [self._found.get(term, part.range), part.values]
            elif part.every:
                pending += part.parts
            else:
                forks = part, forks
        for term, values in atoms.items():
            left = _intersection(values)
            if not left:
                return False, forks
            trail.append((term, self._found.get(term)))
            self._found[term] = left
        return True, forks

    def _restore(self, trail: list[tuple[_Term, Values | None]], length: int) -> None:
        while len(trail) > length:
            term, values = trail.pop()
            if values is None:
                del self._found[term]
            else:
                self._found[term] = values


def satisfiable(*conditions: Condition) -> bool:
    """Return True if values exist for which all conditions hold."""
    if len(conditions) == 1 and isinstance(conditions[0], Atom):
        # Values of one term are of one class.
        return conditions[0].range.meets(conditions[0].values)  # type: ignore[arg-type]
    return Conjunction(conditions).search() is not False


def negate(some: Condition) -> Condition:
    """Return the negation of a condition."""
    if isinstance(some, Combined):
        return Combined(not some.every, tuple(negate(part) for part in some.parts))
    return Atom(some.term, some.values.complement(), some.range)


def _intersection(sets: list[Values]) -> Values:
    """Intersect sets in pairs, so that long ones are not read once for each other set."""
    while len(sets) > 1:
        pairs = zip(sets[::2], sets[1::2], strict=False)
        rest = sets[len(sets) - len(sets) % 2 :]
        # Sets of one term are of one class.
        sets = [one & other for one, other in pairs] + rest  # type: ignore[operator]
    return sets[0]
