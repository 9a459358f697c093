"""Runs of a study that are worth a look, each with the command that plays it."""

from __future__ import annotations

import shlex
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import tomli

from swarmdsl.execution.experiments.report.search import Worst
from swarmdsl.execution.experiments.settings import merged
from swarmdsl.execution.experiments.study.analysis import Analysis, Result
from swarmdsl.execution.experiments.study.models import Setting
from swarmdsl.execution.experiments.task import Row
from swarmdsl.execution.experiments.toml_text import toml_text
from swarmdsl.execution.simulate.durations import written_duration

_MOST = 3
"""Runs of a kind that are shown."""


@dataclass(frozen=True)
class Played:
    """Runs worth a look, and the scenarios that play them, by path."""

    runs: tuple[Worst, ...]
    scenarios: dict[Path, str]


def worst_of(found: Analysis, setting: Setting, folder: Path) -> Played:
    """Return the worst runs of the best point, and violations and failures of any point.

    Scenarios are files in the folder; they have the settings of a point.
    """
    names: dict[str, Path] = {}
    texts: dict[Path, str] = {}
    runs = []
    for why, result, row in _chosen(found):
        text = scenario_text(setting, result)
        if text not in names:
            names[text] = folder / f"{len(names) + 1}.toml"
            texts[names[text]] = text
        command = _command(setting, result, names[text], row.seed)
        runs.append(Worst(why, row.seed, result.values.get(row.seed), command))
    return Played(tuple(runs), texts)


def scenario_text(setting: Setting, result: Result) -> str:
    """Return the scenario of a point with its settings, as TOML."""
    model = setting.model(result.point)
    name = setting.scenario(result.point)
    values = tomli.loads(model.shipment.scenarios.get(name, ""))
    return toml_text(merged(setting.candidate(result.point), values))


def _chosen(found: Analysis) -> Iterator[tuple[str, Result, Row]]:
    best = found.best
    if best is not None:
        sign = 1 if found.goal == "maximize" else -1
        valued = [row for row in best.rows if row.seed in best.values]
        valued.sort(key=lambda row: (sign * best.values[row.seed], row.seed))
        for row in valued[:_MOST]:
            yield "worst run of the best point", best, row
    violated = [
        (f"violates {name}", result, row)
        for result in found.results
        for name, seeds in result.violations.items()
        for row in result.rows
        if row.seed in seeds[:1]
    ]
    yield from violated[:_MOST]
    failed = [
        (row.failure, result, row)
        for result in found.results
        for row in result.failures[:1]
        if row.failure is not None
    ]
    yield from failed[:_MOST]


def _command(setting: Setting, result: Result, scenario: Path, seed: int) -> str:
    """Return the command that plays a run."""
    study, model = setting.study, setting.model(result.point)
    words = ["swarmc", "simulate", *(path for _, path in model.places)]
    until = written_duration(study.until) if study.until is not None else None
    given = (
        ("--swarm", study.swarm),
        ("--scenario", scenario),
        ("--until", until),
        ("--world", study.world),
        ("--seed", seed),
    )
    for option, value in given:
        if value is not None:
            words += [option, str(value)]
    revisions = " ".join(dict.fromkeys(revision for revision, _ in model.places if revision))
    # Only a working tree of the revision has its files.
    return f"# at {revisions}: {shlex.join(words)}" if revisions else shlex.join(words)
