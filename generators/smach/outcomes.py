"""Names of outcomes in SMACH on ROS 1, and how they leave containers.

Each container on the route of an outcome passes it on as an outcome of its own; see
`outcome_routes.py`.
"""

from __future__ import annotations

from collections.abc import Iterable

from swarmdsl.codegen import FreshNames, dataclass, field, fresh

from ..outcome_routes import Target
from .module import PREEMPTED, Entry


@dataclass
class ContainerOutcomes:
    """A container under construction: the inside of the state with the id `owner`.

    `taken` are the labels in it and its own outcomes. `exits` are the outcomes of states inside
    that leave it, `internal` the outcomes of internal transitions of its owner, with the label.
    """

    owner: str
    taken: set[str]
    entries: list[Entry] = field(default_factory=list)
    exits: dict[str, Target] = field(default_factory=dict)
    internal: dict[str, str] = field(default_factory=dict)
    _known: dict[Target, str] = field(default_factory=dict)

    def binding(self, target: Target) -> str:
        """Return what a state in the container is bound to: a label, or an outcome."""
        if target.container == self.owner:
            return target.label
        exit_ = Target(target.container, target.label)
        if exit_ not in self._known:
            outcome = fresh(f"to_{target.label}", self.taken, self.exits, {PREEMPTED})
            self._known[exit_] = outcome
            self.exits[outcome] = exit_
        return self._known[exit_]


def outcome_names(
    routes: Iterable[tuple[str, Target | None]], taken: Iterable[str]
) -> list[str | None]:
    """Return the outcome of each route of a state, given its word and its target.

    Routes with one word and one label share an outcome; None for a route without a target.
    """
    given = [(word, Target(to.container, to.label) if to else None) for word, to in routes]
    targets: dict[str, dict[Target, None]] = {}
    for word, target in given:
        if target is not None:
            targets.setdefault(word, {}).setdefault(target)
    known: dict[tuple[str, Target], str] = {}
    names = FreshNames([*taken, PREEMPTED])
    found: list[str | None] = []
    for word, target in given:
        if target is None:
            found.append(None)
            continue
        if (word, target) not in known:
            name = word if len(targets[word]) == 1 else f"{word}_{target.label}"
            known[word, target] = names.new(name)
        found.append(known[word, target])
    return found
