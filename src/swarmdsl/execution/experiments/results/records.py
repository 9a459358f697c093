"""Runs of a results folder as plain records, and groups of them."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from operator import attrgetter
from pathlib import Path
from typing import Any

from swarmdsl.base.errors import describe_exception
from swarmdsl.base.read_files import read_text
from swarmdsl.base.write_stream import write_stream
from swarmdsl.execution.experiments.designs.factors import Value
from swarmdsl.execution.experiments.failures import StoppedError
from swarmdsl.execution.experiments.store import FILE, Store

NAMES = "experiment.json"
"""File of a results folder with the subject of its runs."""
FIXED = ("group", "model", "scenario", "seed", "fitness", "failure", "seconds")
"""Names that every record has."""


@dataclass(frozen=True)
class About:
    """Subject of a folder: names of models by digest, the measure and its goal."""

    models: Mapping[str, str]
    measure: str = "fitness"
    goal: str = "maximize"

    def write(self, folder: Path) -> None:
        """Write it to a folder, for `read_about`. Raises StoppedError."""
        path = folder / NAMES
        found = {"measure": self.measure, "goal": self.goal, "models": dict(self.models)}
        try:
            with write_stream(path) as stream:
                stream.write(f"{json.dumps(found, indent=2)}\n")
        except OSError as error:
            help_ = "name another folder with `-o`, or make room"
            reason = error.strerror or str(error)
            raise StoppedError("no-store", help_, use="keep", path=path, reason=reason) from error


@dataclass(frozen=True)
class Record:
    """A run. `group` is the number of its model, scenario and settings, from 1 on.

    A scenario that has changed since is another one.
    """

    group: int
    model: str
    scenario: str
    settings: Mapping[str, Any]
    seed: int
    fitness: float | None
    measures: Mapping[str, float | None]
    verdicts: Mapping[str, str]
    failure: str | None
    seconds: float

    def get(self, name: str) -> Any:
        """Return the value of a name: one of FIXED, a setting, a measure or a property."""
        if name in FIXED:
            return getattr(self, name)
        for values in (self.settings, self.measures, self.verdicts):
            if name in values:
                return values[name]
        return None


def read_about(folder: Path) -> About:
    """Return what a folder says about itself; a folder without the file says nothing."""
    found: Any = {}
    with suppress(OSError, ValueError):
        found = json.loads(read_text(folder / NAMES))
    if not isinstance(found, dict):
        found = {}
    models = found.get("models", {})
    return About(
        {str(digest): str(name) for digest, name in models.items()}
        if isinstance(models, dict)
        else {},
        str(found.get("measure", "fitness")),
        "minimize" if found.get("goal") == "minimize" else "maximize",
    )


def read_records(folder: Path, about: About) -> list[Record]:
    """Return all runs of a folder. Raises StoppedError."""
    path = folder / FILE
    with Store(path, is_read_only=True) as store:
        try:
            return list(_records(store, about))
        except (KeyError, TypeError, ValueError) as error:
            reason = describe_exception("a run in it", error)
            help_ = "its runs are not those of a search or an experiment"
            raise StoppedError("no-store", help_, use="read", path=path, reason=reason) from error


def _records(store: Store, about: About) -> Iterator[Record]:
    groups: dict[tuple[str, ...], int] = {}
    for each in store.all():
        key = (each.model, each.scenario, each.text, each.candidate)
        row = json.loads(each.row)
        yield Record(
            groups.setdefault(key, len(groups) + 1),
            about.models.get(each.model, each.model[:12]),
            each.scenario,
            json.loads(each.candidate),
            each.seed,
            row["fitness"],
            row["measures"],
            row["verdicts"],
            row.get("failure"),
            each.seconds,
        )


def names_of(records: Sequence[Record]) -> tuple[list[str], list[str], list[str]]:
    """Return the names of settings, measures and properties, in order of appearance."""
    settings, measures, properties = (
        list(dict.fromkeys(name for record in records for name in values(record)))
        for values in map(attrgetter, ("settings", "measures", "verdicts"))
    )
    return sorted(settings), measures, properties


def grouped(records: Sequence[Record]) -> dict[int, list[Record]]:
    """Return the runs of each group."""
    found: dict[int, list[Record]] = {}
    for record in records:
        found.setdefault(record.group, []).append(record)
    return found


def shown(value: Value | list[Any] | None) -> str:
    """Return a value for people."""
    if value is None:
        return ""
    if isinstance(value, float):
        return f"{value:.6g}"
    return value if isinstance(value, str) else json.dumps(value)
