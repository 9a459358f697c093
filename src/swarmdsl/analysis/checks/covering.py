"""Transitions and branches of which one is always taken before another one."""

from __future__ import annotations

from collections.abc import Iterable

from swarmdsl.analysis.checks.conjunctions import Conjunction, negate, satisfiable
from swarmdsl.analysis.checks.context import Context
from swarmdsl.analysis.checks.facts import Condition
from swarmdsl.analysis.checks.guard_satisfiability import condition_of, guard_value
from swarmdsl.syntax.ast import Branch, Transition

Item = Transition | Branch

# A guard that is not covered is mostly seen to be so in a step or two for each earlier guard.
_STEPS_OF_AN_ITEM = 2


class Earlier:
    """Items before others, in document order."""

    def __init__(self, items: Iterable[Item] = ()) -> None:
        self.items = [*items]
        self._passed: dict[Item, Condition] = {}
        self._none_taken = Conjunction()

    def covering(self, item: Item, context: Context) -> list[Item]:
        """Return a subset of the items of which one is taken whenever `item` could be.

        An item without a guard is covered only by another one without a guard.
        """
        plain = [each for each in self.items if each.guard is None and isinstance(item, Transition)]
        if plain or item.guard is None:
            return plain[:1]
        if not self.items or guard_value(item, context) is False:
            return []
        self._update(context)
        holds = condition_of(item, context)
        # All conditions at once: most guards are not covered, and need no other search.
        if self._none_taken.search(holds, steps=_STEPS_OF_AN_ITEM * len(self.items)):
            return []
        passed = dict(self._passed)
        for before, condition in passed.items():
            if not satisfiable(holds, condition):
                return [before]
        if satisfiable(holds, *passed.values()):
            return []
        for before in self.items:
            others = [condition for each, condition in passed.items() if each is not before]
            if not satisfiable(holds, *others):
                del passed[before]
        return list(passed)

    def _update(self, context: Context) -> None:
        """Add the conditions under which the new items are not taken."""
        for each in self.items[len(self._passed) :]:
            self._passed[each] = negate(condition_of(each, context))
            self._none_taken.add(self._passed[each])
