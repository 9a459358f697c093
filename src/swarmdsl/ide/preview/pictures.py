"""Diagrams of a model as plain data, for browsers and editors."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Collection, Iterator, Mapping, Sequence
from functools import cached_property
from typing import Any, TypedDict

from swarmdsl.base.diagnostics.collector import Severity
from swarmdsl.base.source import Span
from swarmdsl.codegen.diagram.graph import Diagram
from swarmdsl.driver.pipeline import Result
from swarmdsl.ir import System
from swarmdsl.tools.diagram.folding import fold
from swarmdsl.tools.diagram.svg import svg
from swarmdsl.tools.diagram.views import diagrams

_TITLES = {"composition": "swarm", "internal": "member", "statechart": "state machine"}
_RUNNING = {"composition": "swarm", "statechart": "machine"}


class Steps(TypedDict, total=False):
    """Recent steps of members, see `Message`."""

    taken: Mapping[str, Sequence[str]]
    entered: Mapping[str, Sequence[str]]


class Drawn(TypedDict):
    """Picture of a diagram, with its id."""

    id: str
    svg: str


class Message(Steps, total=False):
    """Update for a page; all keys are optional.

    `titles` are titles of all diagrams by id, `id` and `svg` one drawn diagram, `broken` the number
    of errors. The id of a diagram is stable while its subject keeps its name. `names` are those of
    its nodes by id, `foldable` the ids of nodes that fold, both including hidden ones.

    `runs` maps the diagram of a state machine to those who run it, each with the prefix of its
    state ids in a submachine. A runner is a role (`uav`), a part of a role (`uav.camera`), or the
    machine itself by its name.

    `active` are the innermost active states of members, None for members that ended. `taken` are
    the ids of transitions that members have just taken, `entered` the states that they entered,
    including those left since; the empty id is a machine that started.

    `redrawn` is a new picture of a diagram, for pages that show it.

    `subjects` are diagrams of what a page can simulate, by kind and name, and `scenarios` are the
    files for that. `debug` is the state of a simulation that the user drives, None for none, and
    `breakpoints` are ids of states and transitions by diagram.
    """

    titles: dict[str, str]
    runs: Mapping[str, Sequence[tuple[str, str]]]
    id: str
    svg: str
    names: Mapping[str, str]
    foldable: Sequence[str]
    broken: int
    redrawn: Drawn
    subjects: Mapping[str, str]
    scenarios: Sequence[str]
    debug: Mapping[str, Any] | None
    breakpoints: Mapping[str, Sequence[str]]
    active: Mapping[str, Sequence[str] | None]


class Pictures:
    """Diagrams of a model, drawn on demand."""

    def __init__(self, system: System | None = None) -> None:
        self._system = system
        self._diagrams = tuple(diagrams(system)) if system is not None else ()

    def listed(self) -> Message:
        """Return titles and runners of all diagrams."""
        return {
            "titles": {each.stem: f"{each.name} ({_TITLES[each.kind]})" for each in self._diagrams},
            "runs": self._runs(),
        }

    def drawn(self, id_: str | None, hidden: Collection[str] = ()) -> Message:
        """Draw the diagram of an id, else the first one; `hidden` nodes are folded."""
        named = (each for each in self._diagrams if each.stem == id_)
        found = next(named, self._diagrams[0] if self._diagrams else None)
        if found is None:
            return {}
        nodes = [each for each in found.frame.walk() if each.kind not in ("frame", "initial")]
        return {
            "id": found.stem,
            "svg": svg(fold(found, hidden)),
            "names": {each.id: each.name for each in nodes},
            "foldable": [each.id for each in nodes if each.foldable],
        }

    @cached_property
    def files(self) -> frozenset[str]:
        """Return the files that contain the drawn elements."""
        return frozenset(
            origin.absolute.source.name
            for each in self._diagrams
            for origin in _origins(each)
            if origin is not None
        )

    @cached_property
    def states(self) -> Mapping[str, frozenset[str]]:
        """Return the state ids of each machine by its name."""
        machines = self._system.machines if self._system is not None else ()
        return {each.name: frozenset(state.id for state in each.walk()) for each in machines}

    @cached_property
    def stops(self) -> Mapping[tuple[str, str], Span]:
        """Return the places of states and transitions, by diagram and id: a run can stop there."""
        machines = self._system.machines if self._system is not None else ()
        return {
            (f"{machine.name}.statechart", id_): origin
            for machine in machines
            for state in machine.walk()
            for id_, origin in (
                (state.id, state.origin),
                *(
                    (f"{state.id}->{number}", t.origin)
                    for number, t in enumerate(state.transitions)
                ),
            )
            if origin is not None
        }

    @cached_property
    def subjects(self) -> Mapping[tuple[str, str], str]:
        """Return the diagrams of what can run, by kind and name; swarms are first."""
        found = [(_RUNNING[each.kind], each) for each in self._diagrams if each.kind in _RUNNING]
        found.sort(key=lambda pair: pair[0] != "swarm")
        return {(kind, each.name): each.stem for kind, each in found}

    def _runs(self) -> Mapping[str, Sequence[tuple[str, str]]]:
        found: dict[str, list[tuple[str, str]]] = defaultdict(list)
        for who, name, prefix in self._uses():
            found[f"{name}.statechart"].append((who, prefix))
        # In diagram order: the page shows the first diagram with an active member.
        return {each.stem: found[each.stem] for each in self._diagrams if each.stem in found}

    def _uses(self) -> Iterator[tuple[str, str, str]]:
        """Yield runner, machine and prefix of the state ids."""
        if self._system is None:
            return
        machines = self._system.machines_by_name
        runs = {(name, name) for name in machines}
        behaviors = {each.name: each.behavior for each in self._system.components}
        members = self._system.members_by_name
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
    """Return the diagrams of a valid model, else a message with the number of errors."""
    if result.system is None:
        return {"broken": result.report.count(Severity.ERROR)}
    return Pictures(result.system)


def _origins(diagram: Diagram) -> Iterator[Span | None]:
    """Yield the source spans of the drawn elements."""
    yield from (edge.origin for edge in diagram.edges)
    for node in diagram.frame.walk():
        yield node.origin
        yield from (port.origin for port in node.ports)
