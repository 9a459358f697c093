"""Load the scenario of a subject from its file."""

from __future__ import annotations

from pathlib import Path

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.read_files import MOST_DATA
from swarmdsl.driver.config.toml import parse_toml
from swarmdsl.execution.simulate.inputs.scenario_file import read_scenario
from swarmdsl.execution.simulate.machines.subject import Subject
from swarmdsl.execution.simulate.scenario.scenario import Scenario
from swarmdsl.project.read_source import read_source


def load_scenario(path: Path | None, subject: Subject, report: Diagnostics) -> Scenario | None:
    """Read a scenario, or return the default one; None if it has mistakes."""
    if path is None:
        return Scenario()
    source = read_source(path, None, report, "a scenario", MOST_DATA)
    document = parse_toml(source, report) if source is not None else None
    if document is None:
        return None
    scenario = read_scenario(document, subject, report)
    return scenario if not report.has_errors else None
