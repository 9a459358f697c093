"""Mistakes in open TOML files beside a model: behaviour tests and scenarios."""

from __future__ import annotations

import os
from collections.abc import Callable, Container, Iterable, Iterator
from pathlib import Path

from swarmdsl.base.diagnostics.collector import Diagnostic, Diagnostics
from swarmdsl.base.source import Source, Span
from swarmdsl.driver.config import FILE_NAME
from swarmdsl.driver.config.toml import Document, parse_toml
from swarmdsl.driver.pipeline import Result
from swarmdsl.driver.workspace import Workspace
from swarmdsl.execution.simulate.inputs.scenario_file import read_scenario
from swarmdsl.execution.simulate.inputs.scenario_files import is_scenario
from swarmdsl.execution.simulate.inputs.scenario_keys import TABLES
from swarmdsl.execution.simulate.inputs.scenario_table import Table
from swarmdsl.execution.simulate.machines.subject import Subject
from swarmdsl.execution.testing.case import InvalidTest
from swarmdsl.execution.testing.models import Model, Models
from swarmdsl.execution.testing.reading import read_tests

TESTS = ".swarmtest.toml"
_SCENARIOS = "scenarios"
"""Folder whose TOML files are scenarios, whatever is in them."""

Find = Callable[[Path, tuple[Path, ...]], Workspace | None]
"""Return the workspace for a data file: of the models that it names, else of its project."""


class DataFiles:
    """Finds mistakes in data files; models are lowered once until they change."""

    def __init__(self, find: Find) -> None:
        self._find = find
        self._models: dict[Workspace, Model | None] = {}
        # A scenario stays one while it is no TOML for a moment.
        self._scenarios: set[Path] = set()

    def forget(self) -> None:
        """Forget models, which have changed."""
        self._models.clear()

    def mistakes(self, path: Path, text: str, is_open: Container[Path]) -> list[Diagnostic]:
        """Return what is wrong with a file, and with scenarios that it names and are not open."""
        report = Diagnostics()
        source = Source(str(path), text, path)
        if path.name.endswith(TESTS):
            self._check_tests(source, report)
        elif path.name != FILE_NAME:
            self._check_scenario(source, path, report)
        return list(_about_data(report, path, is_open))

    def model(self, path: Path, named: tuple[Path, ...]) -> Model | None:
        """Return the model of a data file with the unsaved text; None if it has mistakes."""
        workspace = self._find(path, named)
        if workspace is None:
            return None
        if workspace not in self._models:
            self._models[workspace] = _lowered(workspace)
        return self._models[workspace]

    def _check_tests(self, source: Source, report: Diagnostics) -> None:
        tests = read_tests(source, _OpenModels(self.model), report, runs=False)
        for case in tests.cases if tests is not None else ():
            if isinstance(case, InvalidTest):
                report.include(case.problems)

    def _check_scenario(self, source: Source, path: Path, report: Diagnostics) -> None:
        found = Diagnostics()
        document = parse_toml(source, found)
        if document is not None and not is_scenario(document.values):
            self._scenarios.discard(path)
        elif document is not None:
            self._scenarios.add(path)
        if path.parent.name != _SCENARIOS and path not in self._scenarios:
            return
        report.include(found)
        if document is None:
            return
        model = self.model(path, ())
        if model is None or model.system is None:
            Table(document, (), report).check_keys(TABLES, "a scenario")
        else:
            report.include(_best(document, _subjects(model, document)))


class _OpenModels(Models):
    """Models of tests with the unsaved text; their own mistakes are shown in their files."""

    def __init__(self, find: Callable[[Path, tuple[Path, ...]], Model | None]) -> None:
        super().__init__()
        self._find = find

    def of(
        self, named: list[tuple[Path, Span]], test_file: Path, report: Diagnostics
    ) -> Model | None:
        missing = [(path, place) for path, place in named if not os.path.lexists(path)]
        for path, place in missing:
            report.report("file-not-found", place, path=path)
        if missing or any(path.suffix == ".scxml" for path, _ in named):
            return None
        return self._find(test_file, tuple(path for path, _ in named))


def _lowered(workspace: Workspace) -> Model | None:
    report = workspace.report
    if report.has_errors:
        return None
    settings, project = workspace.settings, workspace.project
    system = Result(report, workspace.files, project, settings.name).system
    return Model(system, {}, settings.models, project)


def _subjects(model: Model, document: Document) -> Iterator[Subject]:
    """Yield what a scenario may be of: the swarm if there is one, else each that there is."""
    system = model.system
    assert system is not None
    swarms = [Subject(each.name, system, swarm=each) for each in system.swarms]
    machines = [Subject(each.name, system, machine=each) for each in system.machines]
    found = swarms if len(swarms) == 1 and "self" not in document.values else [*swarms, *machines]
    for subject in found:
        subject.models, subject.project = model.models, model.project
        yield subject


def _best(document: Document, subjects: Iterable[Subject]) -> Diagnostics:
    """Return the mistakes of a scenario for the subject that it fits best."""
    best: Diagnostics | None = None
    for subject in subjects:
        report = Diagnostics()
        read_scenario(document, subject, report)
        if best is None or len(report) < len(best):
            best = report
    return best if best is not None else Diagnostics()


def _about_data(report: Diagnostics, path: Path, is_open: Container[Path]) -> Iterator[Diagnostic]:
    """Yield each mistake once, unless another open file shows it."""
    seen = set()
    for each in report:
        source = each.primary.span.source if each.primary is not None else None
        other = source.path if source is not None else None
        if other not in (None, path) and (other.suffix != ".toml" or other in is_open):
            continue
        start = each.primary.span.start if each.primary is not None else 0
        key = (each.code, each.message, other, start)
        if key not in seen:
            seen.add(key)
            yield each
