"""SPIN, rumur and Storm see the same states as `swarmc verify`, and agree on properties.

They read the files of targets `promela`, `murphi` and `jani`, and have their own searches. Numbers
of states are compared, and verdicts on all properties that the languages can express.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from swarmdsl.execution.verify.robot.environment import Options

from ..verify.random_swarms import random_swarm, ranges
from .witnesses import MISSING, Case, Compared, compare

ROOT = Path(__file__).resolve().parents[2]
SOURCES = {
    **{each.name: each for each in sorted((ROOT / "examples").iterdir()) if each.is_dir()},
    **{
        each.parent.name: each for each in sorted((ROOT / "tests" / "golden").glob("*/model.swarm"))
    },
}
FEW = ("minimal", "operations")
"""Models that are compared also if only few swarms are."""
MOST = {name: 300_000 for name in SOURCES if (ROOT / "examples" / name).is_dir()}
"""Numbers of states up to which examples are compared."""
MANY = 10
"""Number of random swarms in a test, from which on all models are compared, too."""
Witnessed = Callable[[str, str, Callable[[], Compared]], Compared]
WITNESSES = [
    pytest.param(target, id=target, marks=pytest.mark.skipif(reason != "", reason=reason))
    for target, reason in MISSING.items()
]


def random(seed: int, folder: Path) -> Case:
    """Write a random swarm."""
    source = folder / f"random{seed}.swarm"
    source.write_text(random_swarm(seed), encoding="utf-8")
    return Case(source, options=Options(1, seed % 3 == 0))


@pytest.mark.parametrize("target", WITNESSES)
def test_robots_that_hear_each_other(target: str, tmp_path: Path) -> None:
    text = (ROOT / "examples" / "emergency_exit" / "emergency_exit.swarm").read_text("utf-8")
    source = tmp_path / "model.swarm"
    source.write_text(text.replace("Spiderino[8]", "Spiderino[2..8]"), encoding="utf-8")

    found = compare([Case(source, {"robot": 3})], target, tmp_path)

    assert (found.counts, found.holds, found.fails) == (1, 6, 0)


@pytest.mark.parametrize("target", WITNESSES)
def test_robots_that_address_each_other(target: str, tmp_path: Path) -> None:
    source = ROOT / "tests" / "composed" / "addressed.swarm"

    found = compare([Case(source, options=Options(1, lossy=True))], target, tmp_path)

    assert (found.counts, found.holds, found.fails) == (1, 1, 2)


def pytest_generate_tests(metafunc: pytest.Metafunc) -> None:
    swarms = metafunc.config.getoption("--swarms")
    if "seeds" in metafunc.fixturenames:
        metafunc.parametrize("seeds", ranges(swarms, MANY), ids=str)
    if "name" in metafunc.fixturenames:
        metafunc.parametrize("name", FEW if swarms < MANY else list(SOURCES))


@pytest.mark.timeout(3000)
@pytest.mark.parametrize("target", WITNESSES)
def test_random_swarms(seeds: range, target: str, tmp_path: Path, witnessed: Witnessed) -> None:
    cases = [random(seed, tmp_path) for seed in seeds]

    found = witnessed("random swarms", target, lambda: compare(cases, target, tmp_path))

    assert min(found) > 0


@pytest.mark.timeout(3000)
@pytest.mark.parametrize("target", WITNESSES)
def test_models(name: str, target: str, tmp_path: Path, witnessed: Witnessed) -> None:
    case = Case(SOURCES[name])
    case = case._replace(most=MOST.get(name, case.most))

    found = witnessed(name, target, lambda: compare([case], target, tmp_path))

    # Others may have too many states.
    assert found.counts or name not in FEW
