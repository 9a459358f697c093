"""Claims of behaviour tests about findings and violated properties."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from swarmdsl.base.records import dataclass
from swarmdsl.execution.simulate.scenario.durations import SECOND
from swarmdsl.execution.verify.findings.finding import Finding
from swarmdsl.execution.verify.proofs.verdict import Verdict
from swarmdsl.execution.verify.search.run import Run

LONGEST = 600 * SECOND
"""Time that a mended model has to go on after the run."""
_PATIENCE = "10 min"
_OUTSIDE = "Add here what must come from outside."


@dataclass(frozen=True)
class Shown:
    """Something that a run shows to be wrong, in a swarm with given numbers of members.

    `claim` is an expectation after the run, which is in vain: the keys of its step. `property` is
    one that the run violates.
    """

    name: str
    run: Run
    counts: Mapping[str, int]
    property: str | None = None
    claim: Mapping[str, Any] | None = None
    note: str = ""
    """Comment before the claim."""


@dataclass(frozen=True)
class Unshown:
    """Something wrong that no test shows, with the reason."""

    name: str
    reason: str


def shown_by_verdict(verdict: Verdict, run: Run, counts: Mapping[str, int]) -> Shown:
    """Return what a test can show of a property that does not hold, by a run.

    After a run to where something is not possible, or goes on without it for ever, the property
    is to become true.
    """
    property_, robot = verdict.property, verdict.robot
    name = property_.name + (f" for {robot}" if robot is not None else "")
    if property_.kind != "possible" and run.loop is None:
        return Shown(name, run, counts, property=property_.name)
    who = {"who": robot} if robot is not None else {}
    claim = {**who, "satisfies": property_.name, "within": _PATIENCE}
    note = _OUTSIDE if property_.kind == "possible" else ""
    return Shown(name, run, counts, claim=claim, note=note)


def shown_by_finding(finding: Finding, run: Run, counts: Mapping[str, int]) -> Shown | Unshown:
    """Return what a test can show of a finding, by a run."""
    match finding.fault:
        case "loops":
            return Shown(f"{finding.name} comes to rest", run, counts)
        case "answers":
            return Shown(f"answers to {finding.name} come to rest", run, counts)
        case "lost":
            return Unshown(finding.title, "it is about all runs, and a test is about one")
        case "fails":
            return Unshown(finding.title, "a test warns of it, but does not fail")
    last = {line.actor: line.configuration for line in run.lines}
    lost = {loss.robot for loss in run.gone}
    robots = [
        actor.robot
        for actor, states in last.items()
        if finding.name in states
        and finding.role in ("", actor.robot.role)
        and actor.robot.name not in lost
    ]
    if not robots:
        return Unshown(finding.title, "nobody waits at the end of its run")
    robot = robots[0]
    who: dict[str, Any] = {"no": robot.name} if robot.name is not None else {"count": 0}
    claim = {**who, "in": finding.name, "within": _PATIENCE}
    name = f"{robot.name or 'it'} goes on from {finding.name}"
    note = _OUTSIDE if finding.fault == "waits" else ""
    return Shown(name, run, counts, claim=claim, note=note)
