"""Parts of a recording beside its lines: properties, measures, coverage, the ground of the map."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from typing import Any

from swarmdsl.base.source import Span
from swarmdsl.execution.engine import Machine
from swarmdsl.execution.simulate.evaluation.measures import fitness_of, inputs_of
from swarmdsl.execution.simulate.evaluation.properties import watchable
from swarmdsl.execution.simulate.machines.subject import Subject
from swarmdsl.execution.simulate.pictures.map_svg import Place
from swarmdsl.syntax.parser.keywords import RESERVED
from swarmdsl.syntax.types import DURATION
from swarmdsl.tools.player.counted_elements import coverage_of
from swarmdsl.tools.player.ground import ground


def view_data(subject: Subject, lines: Iterable[Mapping[str, Any]]) -> dict[str, Any]:
    """Return what views show of the model of a run with some lines, as plain data."""
    roles = [each.name for each in subject.swarm.roles] if subject.swarm is not None else [""]
    return {
        "properties": list(_properties(subject)),
        "measures": list(_measures(subject)),
        "coverage": coverage_of(subject, _tables(subject)),
        "map": ground(subject.environment, _places(lines), roles),
        "keywords": sorted(RESERVED),
    }


def _properties(subject: Subject) -> Iterator[dict[str, str]]:
    for each in watchable(subject):
        yield {"name": each.name, "text": _line(each.origin), "doc": each.doc}


def _measures(subject: Subject) -> Iterator[dict[str, str]]:
    """Yield the measures, times in seconds, and the fitness."""
    fitness = fitness_of(subject)
    if fitness is None:
        return
    for each in inputs_of(fitness):
        yield {"name": each.name, "unit": "s" if each.type == DURATION else "", "doc": each.doc}
    doc = f"fitness, to {fitness.goal}: {fitness.doc}".removesuffix(": ")
    yield {"name": fitness.name, "unit": "", "doc": doc}


def _tables(subject: Subject) -> list[Machine]:
    """Return the machines that members can run."""
    if subject.document is not None:
        return [subject.document.machine]
    counts = {role.name: 1 for role in subject.swarm.roles} if subject.swarm is not None else {}
    robots = subject.create_robots(counts)
    found = (each for robot in robots for _, each in subject.behaviours(robot))
    return [subject.table(each) for each in dict.fromkeys(found)]


def _places(lines: Iterable[Mapping[str, Any]]) -> Iterator[Place]:
    """Yield all places of robots; one without a height is on the ground."""
    for line in lines:
        for x, y, *z in [line["at"]] if "at" in line else line.get("moved", {}).values():
            yield x, y, z[0] if z else 0.0


def _line(origin: Span | None) -> str:
    """Return the line of a place."""
    if origin is None:
        return ""
    at = origin.absolute
    return at.source.line_text(at.line).strip()
