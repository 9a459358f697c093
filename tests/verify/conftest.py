"""Models from text, ready for proofs."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.driver import pipeline
from swarmdsl.driver.config import find_settings
from swarmdsl.execution.simulate.evaluation.properties import watchable
from swarmdsl.execution.simulate.machines.subject import Subject
from swarmdsl.execution.verify.automata.limits import Budget, Limits
from swarmdsl.execution.verify.proofs.prove import prove
from swarmdsl.execution.verify.proofs.verdict import Verdict
from swarmdsl.execution.verify.robot.environment import Options
from swarmdsl.execution.verify.swarm.model import Model
from swarmdsl.ir import System

from .random_swarms import ranges

ROOT = Path(__file__).resolve().parents[2]
MODELS = ROOT / "tests" / "verify" / "models"


CHUNK = 50
"""Number of random swarms that one test looks at, beyond the few that are always looked at."""


def pytest_generate_tests(metafunc: pytest.Metafunc) -> None:
    if "seeds" in metafunc.fixturenames:
        chunks = ranges(metafunc.config.getoption("--proofs"), CHUNK)
        names = ["few", *(f"{each[0]}-{each[-1]}" for each in chunks)]
        metafunc.parametrize("seeds", [metafunc.module.FEW, *chunks], ids=names)


def at_least(verdicts: int, seeds: Sequence[int]) -> int:
    """Return how many verdicts of a kind there shall be, fewer of a few random swarms."""
    is_small = isinstance(seeds, range) and len(seeds) < CHUNK
    return verdicts * len(seeds) // CHUNK if is_small else verdicts


def system_of(path: Path) -> System:
    """Compile a model without mistakes."""
    checked = pipeline.check([path], find_settings([path], Diagnostics()))
    assert not checked.report.has_errors, [each.message for each in checked.report]
    assert checked.system is not None
    return checked.system


def model_of(
    path: Path, counts: Mapping[str, int] | None = None, options: Options | None = None
) -> Model:
    """Return the automata of the only swarm of a model."""
    system = system_of(path)
    subject = Subject(system.swarms[0].name, system, system.swarms[0])
    report = Diagnostics()
    budget = Budget(Limits())
    made = Model(subject, counts or {}, watchable(subject), options or Options(), budget, report)
    assert not report.has_errors
    return made


def verdicts_of(model: Model, states: int = 100_000) -> dict[str, Verdict]:
    """Return the verdicts on all properties of a model."""
    budget = Budget(Limits(states=states))
    return {each.name: prove(each, model, budget) for each in watchable(model.subject)}


@pytest.fixture
def modelled(tmp_path: Path) -> Callable[..., Model]:
    """Return the automata of a model from text."""

    def made(text: str, **options: object) -> Model:
        path = tmp_path / "model.swarm"
        path.write_text(text, encoding="utf-8")
        return model_of(path, None, Options(**options))  # type: ignore[arg-type]

    return made


def lines_of(verdict: Verdict) -> Sequence[str]:
    """Return the members and events of the run of a verdict."""
    assert verdict.run is not None
    return [f"{line.actor.name} {line.event}" for line in verdict.run.lines]
