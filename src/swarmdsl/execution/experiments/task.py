"""Plain data of experiments: candidates, tasks and rows."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from typing import Any

from swarmdsl.base.records import dataclass, field

Value = bool | int | float | str
"""Value of a setting, as it stands in a scenario: a time is a string with its unit."""

COUNT = "count of "
SCENARIO = "scenario "
NO_SCENARIO = ""
"""Name of the scenario of runs without a file."""


@dataclass(frozen=True)
class Candidate:
    """Settings by name: `uav.altitude`, `count of uav`, `scenario network.loss`.

    The name of a param begins with a word that selects members: a role, a type or a robot.
    Anything else of a scenario is named by its keys. Settings are in the order of their names.
    """

    settings: tuple[tuple[str, Any], ...] = ()

    @staticmethod
    def of(settings: Mapping[str, Any]) -> Candidate:
        """Return the candidate with some settings."""
        return Candidate(tuple(sorted(settings.items())))

    @property
    def values(self) -> dict[str, Any]:
        """Settings by name."""
        return dict(self.settings)

    @property
    def text(self) -> str:
        """Canonical JSON, which identifies the candidate."""
        return canonical(self.values)

    def __hash__(self) -> int:
        return hash(self.text)


def settings_text(candidate: Candidate) -> str:
    """Write settings as a reader sees them."""
    return ", ".join(f"{name} = {value}" for name, value in candidate.settings) or "as it is"


@dataclass(frozen=True)
class Task:
    """Runs of a candidate of a model in a scenario, with some seeds."""

    digest: str
    scenario: str
    candidate: Candidate
    seeds: tuple[int, ...]


@dataclass(frozen=True)
class Row:
    """One run: values of measures, times in seconds, fitness, and verdicts on properties.

    `unreached` are the measures that are lower bounds only. A run without a result has a
    `failure` in words. `seconds` is how long it took, which is no part of the result.
    """

    candidate: Candidate
    scenario: str
    seed: int
    measures: Mapping[str, float | None] = field(default_factory=dict)
    fitness: float | None = None
    verdicts: Mapping[str, str] = field(default_factory=dict)
    unreached: tuple[str, ...] = ()
    failure: str | None = None
    seconds: float = field(default=0.0, compare=False)

    def as_data(self) -> dict[str, Any]:
        """Return the result of the run as JSON types, without the candidate and the time."""
        found: dict[str, Any] = {"seed": self.seed, "fitness": self.fitness}
        found |= {"measures": dict(self.measures), "verdicts": dict(self.verdicts)}
        if self.unreached:
            found["unreached"] = list(self.unreached)
        if self.failure is not None:
            found["failure"] = self.failure
        return found


def row_of(task: Task, data: Mapping[str, Any], seconds: float) -> Row:
    """Return the row of `Row.as_data`."""
    return Row(
        task.candidate,
        task.scenario,
        data["seed"],
        data["measures"],
        data["fitness"],
        data["verdicts"],
        tuple(data.get("unreached", ())),
        data.get("failure"),
        seconds,
    )


def canonical(data: Mapping[str, Any] | Sequence[Any]) -> str:
    """Return the one text of JSON data."""
    return json.dumps(data, sort_keys=True, separators=(",", ":"), ensure_ascii=False)
