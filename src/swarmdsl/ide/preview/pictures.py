"""What a preview shows of a model, as plain data: the same for a browser and for an editor."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Collection, Iterator, Mapping, Sequence
from functools import cached_property
from typing import TypedDict

from swarmdsl.base.diagnostics.collector import Severity
from swarmdsl.base.source import Span
from swarmdsl.codegen.diagram.graph import Diagram
from swarmdsl.driver.pipeline import Result
from swarmdsl.ir import System
from swarmdsl.tools.diagram.folding import folded
from swarmdsl.tools.diagram.svg import svg
from swarmdsl.tools.diagram.views import diagrams

_TITLES = {"composition": "swarm", "internal": "member", "statechart": "state machine"}


class Steps(TypedDict, total=False):
    """What members have just done, as a `Message` says it."""

    taken: Mapping[str, Sequence[str]]
    entered: Mapping[str, Sequence[str]]


class Message(Steps, total=False):
    """News for a page: titles of all diagrams by their ids, one drawn, or why there is nothing new.

    `broken` is the number of mistakes. An id stays the same while its subject has its name.
    `runs` says of the diagram of a state machine who runs it, each with what the ids of its states
    begin with where it is reused: a role, `uav`, a part of one, `uav.camera`, or by its own name
    the machine alone. `active` are the innermost active states of members; None, of those that
    are gone. `taken` are transitions that members have just taken, by their ids, and `entered` the
    states that they have entered with that, also those they have left since; the empty id is that
    of a machine that has begun.
    """

    titles: dict[str, str]
    runs: Mapping[str, Sequence[tuple[str, str]]]
    id: str
    svg: str
    broken: int
    active: Mapping[str, Sequence[str] | None]


class Pictures:
    """The diagrams of a model, each drawn when it is asked for: most are not looked at."""

    def __init__(self, system: System | None = None) -> None:
        self._system = system
        self._diagrams = tuple(diagrams(system)) if system is not None else ()

    def listed(self) -> Message:
        """What there is."""
        return {
            "titles": {each.stem: f"{each.name} ({_TITLES[each.kind]})" for each in self._diagrams},
            "runs": self._runs(),
        }

    def drawn(self, id_: str | None, hidden: Collection[str] = ()) -> Message:
        """A diagram, or the first if there is none of this id; `hidden` are nodes to fold."""
        named = (each for each in self._diagrams if each.stem == id_)
        found = next(named, self._diagrams[0] if self._diagrams else None)
        return {"id": found.stem, "svg": svg(folded(found, hidden))} if found is not None else {}

    @cached_property
    def files(self) -> frozenset[str]:
        """The files in which what is drawn is written."""
        return frozenset(
            origin.absolute.source.name
            for each in self._diagrams
            for origin in _origins(each)
            if origin is not None
        )

    @cached_property
    def states(self) -> Mapping[str, frozenset[str]]:
        """The ids of the states of each machine, by its name."""
        machines = self._system.machines if self._system is not None else ()
        return {each.name: frozenset(state.id for state in each.walk()) for each in machines}

    def _runs(self) -> Mapping[str, Sequence[tuple[str, str]]]:
        found: dict[str, list[tuple[str, str]]] = defaultdict(list)
        for who, name, prefix in self._uses():
            found[f"{name}.statechart"].append((who, prefix))
        # In the order of the diagrams, of which a page shows the first in which somebody is.
        return {each.stem: found[each.stem] for each in self._diagrams if each.stem in found}

    def _uses(self) -> Iterator[tuple[str, str, str]]:
        """Who runs which machine, and what its states are called in that."""
        if self._system is None:
            return
        machines = {each.name: each for each in self._system.machines}
        runs = {(name, name) for name in machines}
        behaviors = {each.name: each.behavior for each in self._system.components}
        members = {each.name: each for each in self._system.members}
        for role in (role for swarm in self._system.swarms for role in swarm.roles):
            member = members[role.member]
            parts = ((f"{role.name}.{part.name}", part.component) for part in member.parts)
            found = [(role.name, member.behavior)]
            found += [(who, behaviors[component]) for who, component in parts]
            runs.update((who, behavior) for who, behavior in found if behavior is not None)
        for who, name in sorted(runs):
            yield who, name, ""
            for state in machines[name].walk():
                if state.submachine is not None:
                    yield who, state.submachine, f"{state.id}."


def pictures(result: Result) -> Pictures | Message:
    """The diagrams of a checked model; of one with errors a message that says so."""
    if result.system is None:
        return {"broken": result.report.count(Severity.ERROR)}
    return Pictures(result.system)


def _origins(diagram: Diagram) -> Iterator[Span | None]:
    """Where what is drawn is written."""
    yield from (edge.origin for edge in diagram.edges)
    for node in diagram.frame.walk():
        yield node.origin
        yield from (port.origin for port in node.ports)
