"""Hint for a run in which all machines wait for events that nobody sends."""

from __future__ import annotations

from pathlib import Path

from swarmdsl.base.diagnostics.collector import Diagnostics, listed
from swarmdsl.base.diagnostics.render.printable import printable
from swarmdsl.base.read_files import MOST_DATA
from swarmdsl.driver.config import find_file
from swarmdsl.driver.config.toml import parse_toml
from swarmdsl.execution.simulate.inputs.scenario_file import read_scenario
from swarmdsl.execution.simulate.machines.subject import Subject
from swarmdsl.project.read_source import read_source
from swarmdsl.project.search import found_below

_MOST = 5
"""Maximum number of events in the hint."""


def deadlock_hint(awaited: list[str], subject: Subject, start: Path) -> str:
    """Name the awaited events, and a scenario of the project at `start` for them."""
    events = printable(listed(awaited[:_MOST], "or"))
    more = " and others" if len(awaited) > _MOST else ""
    project = find_file(start)
    scenario = _scenario(project.parent, subject) if project is not None else None
    return f"all wait for {events}{more}: --events FILE or --scenario {scenario or 'FILE'}"


def _scenario(folder: Path, subject: Subject) -> str | None:
    """Find a scenario of this model in a folder that sends messages."""
    for path in found_below(folder, ".toml", Diagnostics()) or ():
        report = Diagnostics()
        source = read_source(path, None, report, most=MOST_DATA)
        document = parse_toml(source, report) if source is not None else None
        if document is None:
            continue
        scenario = read_scenario(document, subject, report)
        if not report.has_errors and scenario.messages:
            return printable(path.as_posix())
    return None
