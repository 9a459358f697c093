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
from swarmdsl.execution.simulate.run.prepare import Request
from swarmdsl.execution.simulate.scenario.durations import written_duration

_WORST, _BEST = "worst run of the best point", "best run of the best point"
_MOST = 3
"""Runs of a kind that are shown."""


@dataclass(frozen=True)
class Played:
    """Runs worth a look, and the scenarios that play them, by path.

    `ends` are the worst and the best run of the best point, with their pages, unless the
    model is of a git revision.
    """

    runs: tuple[Worst, ...]
    scenarios: dict[Path, str]
    ends: tuple[tuple[Request, Path], ...]


def worst_of(found: Analysis, setting: Setting, folder: Path) -> Played:
    """Return worst and best runs of the best point, and violations and failures of any point.

    Scenarios are files in the folder; they have the settings of a point.
    """
    names: dict[str, Path] = {}
    texts: dict[Path, str] = {}
    runs = []
    ends = {}
    for why, result, row in _chosen(found):
        text = scenario_text(setting, result)
        if text not in names:
            names[text] = folder / f"{len(names) + 1}.toml"
            texts[names[text]] = text
        path = names[text]
        page = path.with_name(f"{path.stem}-{row.seed}.html")
        command = _command(setting, result, path, page, row.seed)
        runs.append(Worst(why, row.seed, result.values.get(row.seed), command))
        if why in (_WORST, _BEST) and why not in ends:
            ends[why] = _request(setting, result, path, row.seed), page
    return Played(tuple(runs), texts, tuple(each for each in ends.values() if each[0].paths))


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
            yield _WORST, best, row
        for row in valued[_MOST:][-1:]:
            yield _BEST, best, row
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


def _request(setting: Setting, result: Result, scenario: Path, seed: int) -> Request:
    """Return the simulation of a run; it has no files for a model of a git revision."""
    study, places = setting.study, setting.model(result.point).places
    return Request(
        () if any(revision for revision, _ in places) else tuple(Path(path) for _, path in places),
        swarm=study.swarm,
        scenario=scenario,
        until=study.until,
        world=study.world,
        seed=seed,
        trace="none",
    )


def _command(setting: Setting, result: Result, scenario: Path, page: Path, seed: int) -> str:
    """Return the command that plays a run."""
    study, model = setting.study, setting.model(result.point)
    words = ["swarmc", "simulate", *(path for _, path in model.places)]
    until = written_duration(study.until) if study.until is not None else None
    given = (
        ("--swarm", study.swarm),
        ("--scenario", scenario),
        ("--play", page),
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
