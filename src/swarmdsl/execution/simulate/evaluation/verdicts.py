"""Verdicts on properties, as diagnostics and as rows of a summary."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import Any

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.execution import monitor
from swarmdsl.execution.monitor import (
    FALSE,
    TRUE,
    PropertyResult,
    Verdict,
    Violation,
    Watch,
)
from swarmdsl.execution.simulate.evaluation.measures import FitnessResult, evaluate, measures_of
from swarmdsl.execution.simulate.evaluation.properties import plan, watch
from swarmdsl.execution.simulate.machines.actors import Actor
from swarmdsl.execution.simulate.scenario.durations import format_duration
from swarmdsl.execution.simulate.scenario.space import ABSTRACT, Space
from swarmdsl.execution.simulate.world.line import Line, as_text
from swarmdsl.ir import Fitness, Property

_SHOWN = 4
"""Number of trace lines and robots that are shown."""
_Key = tuple[int, bool, int]
"""Order of a line: its time, False for the first one of a machine, and its place in the trace."""


def report_violations(results: Iterable[PropertyResult], report: Diagnostics) -> None:
    """Report the first violation of each property; one run does not refute a chance."""
    for result in results:
        if result.property.chance is None and result.violations:
            violation = result.violations[0]
            fields: dict[str, Any] = {**violation_fields(violation)}
            report.report(
                "violated-property",
                violation.property.origin,
                notes=tuple(_notes(result)),
                **fields,
            )


def violation_fields(violation: Violation) -> dict[str, str]:
    """Return the fields of the diagnostic of a violation."""
    return {
        "name": violation.property.name,
        "who": f" by `{violation.robot}`" if violation.robot is not None else "",
        "time": format_duration(violation.time),
    }


def _notes(result: PropertyResult) -> Iterator[str]:
    others = [f"`{each.robot}`" for each in result.violations[1:]]
    if others:
        more = f" and {len(others) - _SHOWN} more" if len(others) > _SHOWN else ""
        yield f"likewise by {', '.join(others[:_SHOWN])}{more}"
    lines = [as_text(line).strip() for line in result.violations[0].last[-_SHOWN:]]
    for line in lines:
        yield f"before: {line}"


def rows(results: Iterable[PropertyResult]) -> Iterator[tuple[str, str, str]]:
    """Yield the properties with their verdicts, and the robots of the worst one."""
    for result in results:
        first = result.violations[0] if result.violations else None
        where = ", ".join(result.robots[:_SHOWN])
        if len(result.robots) > _SHOWN:
            where += f" and {len(result.robots) - _SHOWN} more"
        when = f"at {format_duration(first.time)}" if first is not None else ""
        worst = where if result.property.each is not None and result.verdict != "true" else ""
        by_chance = result.verdict == FALSE and result.property.chance is not None
        verdict = "false in this run" if by_chance else result.verdict
        yield result.property.name, verdict, " ".join(filter(None, (worst, when, result.remark)))


class Recording:
    """Lines of replayed traces, watched in the order of time when all are known."""

    def __init__(self, properties: Sequence[Property], fitness: Fitness | None) -> None:
        self._properties = properties
        self._fitness = fitness
        self._lines: list[tuple[_Key, Line, Mapping[str, Any]]] = []
        self._begun: set[Actor] = set()

    def see(self, line: Line, data: Mapping[str, Any] | None, place: int) -> None:
        """Keep a line with the data of its machine, and its place in the trace."""
        if self._properties or self._fitness is not None:
            # At one time, machines start first; but one that comes back starts where it says so.
            self._lines.append(((line.time, line.actor in self._begun, place), line, data or {}))
            self._begun.add(line.actor)

    def results(
        self,
        end: int,
        loop: int | None = None,
        space: Space = ABSTRACT,
        *,
        told: Callable[[monitor.Property, Verdict, int], None] | None = None,
        heard: Callable[[Watch, Line], None] | None = None,
    ) -> tuple[list[PropertyResult], FitnessResult | None]:
        """Return verdicts and fitness of the traces until a time; a log can end at any time.

        The last `loop` lines repeat for ever; with 0, nothing happens after them. Measures of space
        are those of `space`. `told` is called with verdicts so far, `heard` after each line.
        """
        if not self._lines:
            return [], None
        known: dict[Actor, Mapping[str, Any]] = {}
        planned = plan(self._properties, measures_of(self._fitness))
        monitors = watch(planned, lambda actor: known[actor], told=told)
        lines = sorted(self._lines, key=lambda each: each[0])
        endings = [watch(planned, lambda actor: known[actor]) for _ in range(loop or 0)]
        ends: list[list[PropertyResult]] = []
        for number, (_, line, data) in enumerate(lines, start=1):
            known[line.actor] = data
            for each in (monitors, *endings):
                each.see(line)
            if heard is not None:
                heard(monitors, line)
            if endings and number > len(lines) - (loop or 0):
                ends.append(endings.pop(0).results(line.time, ended=True))
        results = monitors.results(end, ended=loop == 0)
        if ends:
            results = [_in_loop(result, at) for result, *at in zip(results, *ends, strict=True)]
        if self._fitness is None:
            return results, None
        return results, evaluate(self._fitness, monitors.readings(end), space)


def _in_loop(result: PropertyResult, ends: Sequence[PropertyResult]) -> PropertyResult:
    """Return the verdict on a run whose last lines repeat for ever.

    `ends` are the verdicts if one of these lines was the last one of all. What stays open at each
    of them never happens, and all else does.
    """
    if result.verdict == FALSE:
        return result
    last = ends[-1]
    robots = tuple(each for each in last.robots if all(each in end.robots for end in ends))
    is_false = all(each.verdict == FALSE for each in ends)
    if is_false and last.property.each is None:
        return last
    if is_false and robots:
        violations = tuple(each for each in last.violations if each.robot in robots)
        return last._replace(robots=robots, violations=violations)
    return result._replace(verdict=TRUE, robots=())
