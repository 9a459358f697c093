"""Texts of a model with its scenarios: what goes to workers."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Mapping, Sequence
from functools import cached_property
from hashlib import sha256
from pathlib import Path
from typing import Any

from swarmdsl import __version__
from swarmdsl.base import resources
from swarmdsl.base.diagnostics.collector import Diagnostics, listed
from swarmdsl.base.read_files import MOST_DATA, is_file
from swarmdsl.base.records import dataclass, field
from swarmdsl.driver import pipeline
from swarmdsl.driver.config import ModelSource, Settings, find_settings
from swarmdsl.driver.config.toml import parse_toml
from swarmdsl.execution.experiments.task import NO_SCENARIO, canonical
from swarmdsl.execution.simulate.machines.subject import Subject, choose
from swarmdsl.project.loader import Project
from swarmdsl.project.read_source import read_source

_MANIFEST = "package.xml"
_IN_C = "physics"
"""Kind of a world whose library is no Python."""


@dataclass(frozen=True)
class Conditions:
    """Conditions of all runs: their length, their space, and the properties to watch.

    `until` is in nanoseconds. None watches all properties.
    """

    until: int | None = None
    world: str | None = None
    properties: tuple[str, ...] | None = None

    def as_data(self) -> list[Any]:
        """Return JSON types."""
        return [self.until, self.world, self.properties and list(self.properties)]


@dataclass(frozen=True)
class Shipment:
    """A model as texts, by path below a common folder, with scenarios by name.

    `paths` are the files to compile, `libraries` the folders to search, and `models` the function
    models of the project: the class with the path of its file, or None for an entry point.
    """

    texts: Mapping[str, str]
    paths: tuple[str, ...]
    swarm: str
    name: str | None = None
    libraries: tuple[str, ...] = ()
    models: Mapping[str, tuple[str, str | None]] = field(default_factory=dict)
    scenarios: Mapping[str, str] = field(default_factory=dict)
    conditions: Conditions = field(default_factory=Conditions)
    version: str = __version__

    def as_data(self) -> dict[str, Any]:
        """Return JSON types."""
        return {
            "version": self.version,
            "digest": self.digest,
            "texts": dict(self.texts),
            "paths": list(self.paths),
            "swarm": self.swarm,
            "name": self.name,
            "libraries": list(self.libraries),
            "models": {name: list(each) for name, each in self.models.items()},
            "scenarios": dict(self.scenarios),
            "conditions": self.conditions.as_data(),
        }

    @cached_property
    def digest(self) -> str:
        """Digest of everything but the scenarios."""
        models = {name: list(each) for name, each in self.models.items()}
        parts = [self.version, dict(self.texts), self.paths, self.swarm, self.name, self.libraries]
        return _digest([*parts, models, self.conditions.as_data()])

    @property
    def may_crash(self) -> bool:
        """True if runs may end their process: by code of the project, or of a library in C."""
        given = (self.conditions.world or "", *self.scenarios.values())
        return bool(self.models) or any(_IN_C in text for text in given)

    def scenario_digest(self, name: str) -> str:
        """Return the digest of a scenario, empty for none."""
        return _digest([self.scenarios[name]]) if name != NO_SCENARIO else ""


def _digest(data: Sequence[Any]) -> str:
    return sha256(canonical(data).encode("utf-8", "surrogatepass")).hexdigest()


def shipment_of(data: Mapping[str, Any]) -> Shipment:
    """Return the shipment of `Shipment.as_data`."""
    until, world, properties = data["conditions"]
    return Shipment(
        data["texts"],
        tuple(data["paths"]),
        data["swarm"],
        data["name"],
        tuple(data["libraries"]),
        {name: (each[0], each[1]) for name, each in data["models"].items()},
        data["scenarios"],
        Conditions(until, world, tuple(properties) if properties is not None else None),
        data["version"],
    )


def pack(
    paths: Sequence[Path],
    swarm: str | None,
    scenarios: Iterable[Path],
    report: Diagnostics,
    conditions: Conditions = Conditions(),  # noqa: B008 - frozen
    choice: str = "--swarm {}",
) -> tuple[Shipment, Subject] | None:
    """Check a model and pack it with its scenarios; None if something is wrong.

    What the scenarios say depends on candidates: only their syntax is checked. `choice` is how a
    user chooses a swarm.
    """
    settings = find_settings(paths, report)
    if report.has_errors:
        return None
    named = tuple(paths or settings.sources)
    checked = pipeline.check(named, settings)
    report.include(checked.report)
    if checked.valid is None or checked.system is None:
        return None
    names = [each.name for each in checked.system.swarms]
    if swarm is None and len(names) > 1:
        help_ = f"choose one: {listed([choice.format(name) for name in names])}"
        report.report("unclear-subject", help=help_)
        return None
    subject = choose(checked.system, [], None, swarm, report)
    if subject is None:
        return None
    if subject.swarm is None:
        help_ = "an experiment runs a swarm: declare one"
        report.report("nothing-to-simulate", help=help_)
        return None
    subject.models = settings.models
    texts = {}
    for path in scenarios:
        source = read_source(path, None, report, "a scenario", MOST_DATA)
        if source is not None and parse_toml(source, report) is not None:
            texts[str(path)] = source.text
    files = dict(_files(checked.valid, settings, report))
    if report.has_errors:
        return None
    base = _base([*files, *map(_absolute, named)])
    shipment = Shipment(
        {_below(base, path): text for path, text in sorted(files.items())},
        tuple(_below(base, _absolute(path)) for path in named),
        subject.swarm.name,
        settings.name,
        tuple(_below(base, _absolute(path)) for path in settings.libraries),
        {name: _model(base, each) for name, each in settings.models.items()},
        texts,
        conditions,
    )
    return shipment, subject


def _files(project: Project, settings: Settings, report: Diagnostics) -> Iterator[tuple[str, str]]:
    """Yield the files of a model with their texts, without those that swarmdsl brings."""
    own = _absolute(resources.library())
    for file in project.files:
        path = file.source.path
        if path is None or _absolute(path).startswith(own + os.sep):
            continue
        yield _absolute(path), file.source.text
        if path.suffix == ".swarm":
            continue
        # The name of a ROS package is in its manifest.
        for folder in (path.parent, path.parent.parent):
            if is_file(folder / _MANIFEST):
                yield from _read(folder / _MANIFEST, report)
    for model in settings.models.values():
        if model.path is not None:
            yield from _read(model.path, report)


def _read(path: Path, report: Diagnostics) -> Iterator[tuple[str, str]]:
    source = read_source(path, None, report, "a file of text", MOST_DATA)
    if source is not None:
        yield _absolute(path), source.text


def _absolute(path: Path) -> str:
    return os.path.abspath(path)  # noqa: PTH100 - links keep their names


def _base(paths: Sequence[str]) -> str:
    """Return the folder above the common one, whose name can be that of a package."""
    common = os.path.commonpath([os.path.dirname(path) for path in paths])  # noqa: PTH120
    return os.path.dirname(common)  # noqa: PTH120


def _below(base: str, path: str) -> str:
    return Path(os.path.relpath(path, base)).as_posix()


def _model(base: str, source: ModelSource) -> tuple[str, str | None]:
    path = _below(base, _absolute(source.path)) if source.path is not None else None
    return source.attribute, path
