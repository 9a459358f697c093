"""Run and diagnostics as a client shows them."""

from __future__ import annotations

import os
from typing import Any

from swarmdsl.base.diagnostics.collector import Diagnostic
from swarmdsl.execution.simulate.scenario.durations import SECOND
from swarmdsl.execution.simulate.world.line import Line
from swarmdsl.ide.debugger.controls import Controls
from swarmdsl.ide.debugger.inspection import Inspection
from swarmdsl.ide.debugger.sending import enabled
from swarmdsl.ide.server.positions import position


def headline(found: Diagnostic) -> str:
    """Return a diagnostic on one line."""
    place = ""
    if found.primary is not None:
        at = found.primary.span.absolute
        line, column = at.source.line_column(at.start)
        place = f"{at.source.name}:{line}:{column}: "
    label = f": {found.primary.message}" if found.primary and found.primary.message else ""
    help_ = f" (help: {found.help})" if found.help else ""
    return f"{place}{found.severity.value}[{found.code}]: {found.message}{label}{help_}"


def output_of(found: Diagnostic, first_line: int, first_column: int) -> dict[str, Any]:
    """Return the body of an output event for a diagnostic, with its place."""
    body: dict[str, Any] = {"category": "stderr", "output": f"{headline(found)}\n"}
    place = found.primary.span.absolute if found.primary is not None else None
    if place is not None and place.source.path is not None:
        line, column = position(place.source, place.start)
        path = os.path.realpath(place.source.path)
        body["source"] = {"name": place.source.path.name, "path": path}
        body["line"], body["column"] = line + first_line, column + first_column
    return body


def picture(
    controls: Controls, inspection: Inspection, told: Line | None, seen: int | None = None
) -> dict[str, Any]:
    """Return a run as pages show it: active states, the last step unless that is told.

    While the run stands still, `seen` is the member that the user looks at: then also its
    variables, the names of all members, and the events to send.
    """
    if not controls.has_begun:
        return {"active": {}}
    instances = controls.instances
    active: dict[str, list[str] | None] = {}
    # A robot that has come back is the last one among the instances.
    for actor, member in controls.members.items():
        instance = instances[actor]
        states = instance.configuration.innermost if instance.running else None
        active[inspection.name(member)] = [instance.final] if instance.final else states
    shown: dict[str, Any] = {"time": controls.world.clock.now / SECOND, "active": active}
    member = controls.point.member
    last = controls.last.get(member)
    if last is not None and last is not told:
        called = last.actor.machine.called
        shown["taken"] = {inspection.name(member): list(dict.fromkeys(map(called, last.taken)))}
        shown["entered"] = {inspection.name(member): last.entered}
    if seen is not None:
        shown["member"] = inspection.name(seen)
        shown["thread"] = seen + 1
        shown["members"] = [each["name"] for each in inspection.threads()]
        shown["events"] = enabled(controls.subject, controls.world, instances)
        shown["variables"] = inspection.variables(seen)
    return shown
