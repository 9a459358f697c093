"""Results of checks that hold again when the events of a machine mean what they meant before.

While a person types the name of an event that many machines use, all of them lose it, and find it
again with the last letter: the second time, nothing has to be checked.
"""

from __future__ import annotations

from collections.abc import Hashable, Mapping

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Source
from swarmdsl.driver.workspace.fragments import Fragment
from swarmdsl.driver.workspace.rebinding import event_references
from swarmdsl.syntax.ast import StateMachine

# With and without the event that is edited, while another one may have its name in between.
_KEPT = 4


class RepeatedChecks:
    """Results of one round of checks, to look up and to keep."""

    def __init__(self, fragments: Mapping[Source, Fragment]) -> None:
        self._fragments = fragments
        self._behind: dict[Fragment, frozenset[Fragment]] = {}

    def recall(self, fragment: Fragment) -> Diagnostics | None:
        """Return the result for the events of a fragment as they are now, if it is kept."""
        return fragment.results.get(self._meaning(fragment))

    def keep(self, fragment: Fragment) -> None:
        """Keep the result of a fragment, unless it shows places outside of the fragment."""
        labels = (label for found in fragment.checked for label in found.related)
        meaning = self._meaning(fragment)
        if meaning is not None and all(each.span.source is fragment.source for each in labels):
            fragment.results[meaning] = fragment.checked
            while len(fragment.results) > _KEPT:
                del fragment.results[next(iter(fragment.results))]

    def _meaning(self, fragment: Fragment) -> Hashable:
        """Return all that the events of machines mean; None if it is not known.

        An event means what its text says, and what that depends on.
        """
        if not all(isinstance(each, StateMachine) for each in fragment.parsed.model.declarations):
            return None
        found: list[Hashable] = []
        for _, ref in event_references(fragment):
            event = ref.target
            if event is None:
                found.append(None)
                continue
            declared = self._fragments.get(event.span.source)
            if declared is None:
                return None
            place = (declared.file.source.name, event.span.start)
            found.append((place, declared.source.text, self._uses(declared)))
        return tuple(found)

    def _uses(self, fragment: Fragment) -> frozenset[Fragment]:
        """Return all fragments that one depends on, directly or not."""
        if fragment not in self._behind:
            work, found = [fragment], set[Fragment]()
            while work:
                for used in work.pop().uses:
                    if used not in found and used is not fragment:
                        found.add(used)
                        work.append(used)
            self._behind[fragment] = frozenset(found)
        return self._behind[fragment]
