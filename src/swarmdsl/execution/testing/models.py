"""Compile the models of tests, each once."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from pathlib import Path

from swarmdsl.base.diagnostics.collector import Diagnostics, listed
from swarmdsl.base.read_files import MOST_DATA
from swarmdsl.base.records import dataclass, field
from swarmdsl.base.source import Span
from swarmdsl.driver import pipeline
from swarmdsl.driver.config import ModelSource, Settings, find_file, find_settings
from swarmdsl.execution.scxml import read as read_scxml
from swarmdsl.execution.simulate.inputs.scenario_table import Table
from swarmdsl.execution.simulate.machines.subject import Document, Subject
from swarmdsl.ir import System
from swarmdsl.project.loader import Project
from swarmdsl.project.read_source import read_source

_SCXML = ".scxml"


@dataclass
class Model:
    """A system, or SCXML documents; caches subjects with their tables."""

    system: System | None
    documents: dict[str, Document]
    models: Mapping[str, ModelSource] = field(default_factory=dict)
    project: Project | None = None
    subjects: dict[tuple[str, str], Subject] = field(default_factory=dict)

    def subject(self, table: Table, key: str | None, report: Diagnostics) -> Subject | None:
        """Return the swarm or machine named by `key`, else the only one."""
        swarms = {each.name: each for each in self.system.swarms} if self.system else {}
        machines = self.system.machines_by_name if self.system else {}
        names = {"swarm": list(swarms), "machine": [*machines, *self.documents]}
        if key is None:
            key = "swarm" if len(swarms) == 1 else "machine"
            if len(names[key]) != 1 or (key == "machine" and swarms):
                choices = [f'{kind} = "{name}"' for kind in names for name in names[kind]]
                help_ = f"write {listed(choices)}" if choices else "declare a `statemachine`"
                code = "unclear-subject" if choices else "nothing-to-simulate"
                report.report(code, _start(table), help=help_)
                return None
            (name,) = names[key]
        else:
            what = "swarm" if key == "swarm" else "state machine"
            found = table.name(key, names[key], what)
            if found is None:
                return None
            name = found
        if (key, name) not in self.subjects:
            if name in self.documents:
                subject = Subject(name, document=self.documents[name])
            elif key == "swarm":
                subject = Subject(name, self.system, swarm=swarms[name])
            else:
                subject = Subject(name, self.system, machine=machines[name])
            subject.models = self.models
            subject.project = self.project
            self.subjects[key, name] = subject
        return self.subjects[key, name]


class Models:
    """Cache of compiled models."""

    def __init__(self) -> None:
        self._known: dict[tuple[Path, ...], Model | None] = {}

    def of(
        self, named: list[tuple[Path, Span]], test_file: Path, report: Diagnostics
    ) -> Model | None:
        """Return the named model, else that of the project or folder of a test file.

        None if it has errors, which are reported.
        """
        places = dict(named)
        if named:
            paths = tuple(places)
        elif find_file(test_file) is not None:
            paths = find_settings([test_file], report).sources
        else:
            paths = (test_file.parent,)
        missing = [path for path in paths if not os.path.lexists(path)]
        for path in missing:
            report.report("file-not-found", places.get(path), path=path)
        if missing:
            return None
        if paths not in self._known:
            self._known[paths] = _compiled(paths, test_file, report)
        return self._known[paths]


def _compiled(paths: Iterable[Path], test_file: Path, report: Diagnostics) -> Model | None:
    documents: dict[str, Document] = {}
    models = []
    for path in paths:
        if path.suffix != _SCXML:
            models.append(path)
            continue
        source = read_source(path, None, report, most=MOST_DATA)
        machine = read_scxml(source, report) if source is not None else None
        if source is None or machine is None:
            return None
        document = Document(source, machine)
        documents[document.name] = document
    system = project = None
    settings = Settings()
    if models:
        settings = find_settings([test_file], report)
        checked = pipeline.check(models, settings)
        report.include(checked.report)
        system, project = checked.system, checked.valid
        if system is None:
            return None
    return Model(system, documents, settings.models, project)


def _start(table: Table) -> Span:
    """Return the span where a test names its subject, or could."""
    return table.key_place("name") if "name" in table else table.value_place(())
