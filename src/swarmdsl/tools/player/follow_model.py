"""Follow traces on their model: what it says that traces do not, and where they differ."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any, NamedTuple

from swarmdsl.base.diagnostics.collector import Diagnostic, Diagnostics, Severity
from swarmdsl.base.records import replace
from swarmdsl.base.source import Source
from swarmdsl.execution.simulate.machines.actors import Actor, actors
from swarmdsl.execution.simulate.machines.subject import Subject
from swarmdsl.execution.simulate.recording.run_lines import Changes
from swarmdsl.execution.simulate.replay.replay import replay
from swarmdsl.execution.simulate.scenario.scenario import Robot, Scenario
from swarmdsl.execution.simulate.world.line import Line
from swarmdsl.tools.player.judged_lines import Judge

_INVALID = "bad-trace-line"
"""Told when the lines were read."""


class Followed(NamedTuple):
    """Variables that lines have changed, by the name of the trace and the place in it.

    `judged` are lines with verdicts and measures. Times of several traces differ: they have none.
    """

    variables: Mapping[tuple[str, int], Mapping[str, Any]]
    judged: Sequence[Mapping[str, Any]]


def follow(
    sources: Sequence[Source],
    robots: Iterable[str],
    subject: Subject,
    scenario: Scenario,
    report: Diagnostics,
) -> Followed | None:
    """Return what the model says of traces; report where members leave the model.

    None if nothing is compared, which is told: machines have params without a value, or there are
    too many.
    """
    robots = list(robots)
    missing = Diagnostics()
    if not _cast(robots, subject, scenario, missing):
        report.include(map(_not_compared, missing))
        return None
    found: dict[tuple[str, int], Mapping[str, Any]] = {}
    judged: list[dict[str, Any]] = []
    for source in sources:
        changes, judge = Changes(), Judge(subject)

        def see(
            line: Line,
            data: Mapping[str, Any],
            at: int,
            name: str = source.name,
            changes: Changes = changes,
            judge: Judge = judge,
        ) -> None:
            judge.see(line, data, at)
            changed = changes.of(line.actor, data)
            if changed:
                found[name, at] = changed

        # A replay changes the data of its machines.
        told = Diagnostics()
        cast = _cast(robots, subject, scenario, told)
        replayed = replay(source, subject, cast, told, see, scenario.faults)
        report.include(each for each in told if each.name != _INVALID)
        if len(sources) == 1:
            judged = judge.lines(replayed)
    return Followed(found, judged)


def _not_compared(found: Diagnostic) -> Diagnostic:
    """Return a warning of what keeps traces from being compared with the model."""
    message = f"{found.message}: traces are not compared with the model"
    return replace(found, severity=Severity.WARNING, message=message)


def _cast(
    robots: Iterable[str], subject: Subject, scenario: Scenario, report: Diagnostics
) -> list[Actor]:
    """Return the machines of as many robots as the traces have; report why there are none."""
    counts = dict(scenario.counts)
    for name in robots:
        robot = Robot.called(name)
        if robot.role:
            counts[robot.role] = max(counts.get(robot.role, 0), robot.count)
    made = subject.create_robots(counts, scenario.alone)
    cast = actors(subject, made, scenario, report)
    return [] if report.has_errors else cast
