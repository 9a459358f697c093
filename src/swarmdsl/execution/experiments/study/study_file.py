"""Read a study from TOML, and check its values."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from swarmdsl.base.diagnostics.collector import Diagnostics, listed
from swarmdsl.base.read_files import MOST_DATA
from swarmdsl.base.source import Span
from swarmdsl.driver.config.toml import Document, parse_toml
from swarmdsl.execution.experiments.comparing import Goal
from swarmdsl.execution.experiments.designs.factorial import combinations
from swarmdsl.execution.experiments.designs.indices import MOST_FACTORS
from swarmdsl.execution.experiments.designs.sobol import MOST_DIMENSIONS
from swarmdsl.execution.experiments.study.factor_file import read_factors
from swarmdsl.execution.experiments.study.plan import DESIGNS, Design, Study, Varied
from swarmdsl.execution.simulate.inputs.choose_space import KINDS
from swarmdsl.execution.simulate.inputs.scenario_table import Table
from swarmdsl.project.read_source import read_source

KEYS = (
    "model",
    "swarm",
    "scenario",
    "design",
    "points",
    "repetitions",
    "seed",
    "until",
    "world",
    "measure",
    "goal",
    "confidence",
    "factors",
)
MOST_RUNS = 10_000_000
_MOST_POINTS = 1_000_000
_GOALS: tuple[Goal, ...] = ("maximize", "minimize")
# Points for each factor where the file does not say how many; all of Morris, rows of indices.
_LATIN, _SOBOL, _TRAJECTORIES, _ROWS = 10, 16, 10, 128


def read_study(path: Path, report: Diagnostics) -> Study | None:
    """Read a study; None if it has mistakes, which are reported."""
    source = read_source(path, None, report, "an experiment", MOST_DATA)
    document = parse_toml(source, report) if source is not None else None
    if document is None:
        return None
    study = _Reader(document, path, report).read()
    return study if not report.has_errors else None


class _Reader:
    def __init__(self, document: Document, path: Path, report: Diagnostics) -> None:
        self.top = Table(document, (), report)
        self.path = path
        self.report = report

    def read(self) -> Study:
        top = self.top
        top.check_keys(KEYS, "an experiment")
        factors = read_factors(top.document, self.report)
        design = self.design()
        found: dict[str, Any] = {
            "swarm": top.text("swarm", "the name of a swarm") if "swarm" in top else None,
            "scenario": self.scenario(),
            "repetitions": self.whole("repetitions", 1, _MOST_POINTS),
            "seed": self.whole("seed", 0, 2**53),
            "until": top.duration("until") if "until" in top else None,
            "world": top.name("world", KINDS, "world") if "world" in top else None,
            "measure": top.text("measure", "the name of a measure") if "measure" in top else None,
            "goal": top.name("goal", _GOALS, "goal") if "goal" in top else None,
            "confidence": self.confidence(),
            "points": self.points(design, factors),
        }
        given = {name: value for name, value in found.items() if value is not None}
        places = {name: top.document.places[(name,)].value for name in top.values if name in KEYS}
        study = Study(
            self.path, factors, self.models(factors), design=design, places=places, **given
        )
        if not self.report.has_errors:
            self.check(study)
        return study

    def design(self) -> Design:
        if "design" not in self.top:
            return "full"
        name = self.top.name("design", DESIGNS, "design")
        return next((each for each in DESIGNS if each == name), "full")

    def scenario(self) -> Path | None:
        if "scenario" not in self.top:
            return None
        text = self.top.text("scenario", "the path of a scenario")
        return self.path.parent / text if text is not None else None

    def whole(self, key: str, low: int, high: int) -> int | None:
        return self.top.whole(key, low, high) if key in self.top else None

    def confidence(self) -> float | None:
        if "confidence" not in self.top:
            return None
        level = self.top.share("confidence")
        if level is not None and not 0.5 <= level < 1:
            self.top.wrong(("confidence",), "from 0.5 to less than 1", level)
            return None
        return level

    def points(self, design: Design, factors: tuple[Varied, ...]) -> int | None:
        if design == "full":
            if "points" in self.top:
                help_ = "a full factorial design has all combinations of levels: leave it out"
                place = self.top.key_place("points")
                owner = 'an experiment with `design = "full"`'
                self.report.report("unknown-key", place, name="points", owner=owner, help=help_)
            return None
        if "points" in self.top:
            return self.top.whole("points", 2, _MOST_POINTS)
        match design:
            case "latin":
                return max(_LATIN * len(factors), 2)
            case "sobol":
                return 1 << max(_SOBOL * len(factors) - 1, 1).bit_length()
            case "morris":
                return _TRAJECTORIES
        return _ROWS

    def models(self, factors: tuple[Varied, ...]) -> tuple[str, ...]:
        """Read the files of the model; empty if a factor has the models."""
        varied = any(each.kind == "model" for each in factors)
        if "model" not in self.top:
            return () if varied else (".",)
        value = self.top.values["model"]
        if varied:
            place, owner = self.top.key_place("model"), "an experiment with a factor `model`"
            help_ = "name all models in the factor, or this one here alone"
            self.report.report("unknown-key", place, name="model", owner=owner, help=help_)
        texts = value if isinstance(value, list) else [value]
        if not texts or not all(isinstance(each, str) and each for each in texts):
            self.top.wrong(("model",), "a path, or a list of paths", value)
            return ()
        return tuple(texts)

    # ---- what only all values together show

    def check(self, study: Study) -> None:
        if not study.factors:
            place = self.place("factors") or Span(self.top.document.source, 0, 0)
            help_ = 'say what is varied: `[factors]`, `"count of robot" = [4, 8]`'
            self.report.report("no-factors", place, help=help_)
            return
        kinds = {each.kind for each in study.factors}
        if "scenario" in kinds and study.scenario is not None:
            place, owner = self.top.key_place("scenario"), "an experiment with a factor `scenario`"
            help_ = "name all scenarios in the factor, or this one here alone"
            self.report.report("unknown-key", place, name="scenario", owner=owner, help=help_)
        if study.design == "full":
            self.check_levels(study)
        most = MOST_FACTORS if study.design == "indices" else MOST_DIMENSIONS
        if study.design in ("sobol", "indices") and len(study.factors) > most:
            help_ = 'Latin hypercubes take any number: `design = "latin"`'
            self.too_many(study, f"{len(study.factors)} factors", f"{most} of them", help_)
        if not self.report.has_errors and (runs := self.runs(study)) > MOST_RUNS:
            help_ = "take fewer levels, points or repetitions"
            if study.design == "full":
                help_ += ', or `design = "latin"`'
            self.too_many(study, f"{runs:,} runs", f"{MOST_RUNS:,}", help_)

    def check_levels(self, study: Study) -> None:
        """Report factors without levels in a full factorial design."""
        others: list[str] = [each for each in DESIGNS if each != "full"]
        for each in study.factors:
            if not each.factor.levels:
                help_ = (
                    f"give it a `step` or a list of levels, or choose another `design`: "
                    f"{listed(others)}"
                )
                self.report.report("no-levels", each.place, name=each.name, help=help_)

    def runs(self, study: Study) -> int:
        factors = len(study.factors)
        points = {
            "full": combinations(study.plain_factors),
            "morris": study.points * (factors + 1),
            "indices": study.points * (factors + 2),
        }.get(study.design, study.points)
        return points * study.repetitions

    def too_many(self, study: Study, count: str, most: str, help_: str) -> None:
        place = study.places.get("design") or self.place("factors")
        self.report.report("too-large-study", place, count=count, most=most, help=help_)

    def place(self, key: str) -> Span | None:
        return self.top.key_place(key) if key in self.top else None
