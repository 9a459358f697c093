"""Other model checkers see the same states of a swarm as `swarmc verify`, and agree on properties.

They read the files of targets `promela` and the like, and have their own searches. Numbers of
states are compared, and verdicts on all properties that the languages can express.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from swarmdsl.execution.verify.model import Options

from ..verify.random_swarms import random_swarm
from .witnesses import Checker, Compared, compare, missing_for, spin

ROOT = Path(__file__).resolve().parents[2]
MODELS = ROOT / "tests" / "verify" / "models"
EXAMPLES = sorted(each.name for each in (ROOT / "examples").iterdir() if each.is_dir())
GOLDEN = sorted(each.parent.name for each in (ROOT / "tests" / "golden").glob("*/model.swarm"))
_SPIN = pytest.mark.skipif(missing_for("spin", "gcc") != "", reason=missing_for("spin", "gcc"))
WITNESSES = [pytest.param("promela", spin, id="spin", marks=_SPIN)]


def random(seed: int, target: str, check: Checker, folder: Path) -> Compared:
    """Compare a random swarm."""
    source = folder / "random.swarm"
    source.write_text(random_swarm(seed), encoding="utf-8")
    return compare(source, target, check, folder, options=Options(1, seed % 3 == 0))


@pytest.mark.parametrize(("target", "check"), WITNESSES)
def test_robots_that_hear_each_other(target: str, check: Checker, tmp_path: Path) -> None:
    source = ROOT / "examples" / "emergency_exit"

    found = compare(source, target, check, tmp_path, counts={"robot": 3})

    assert found.counts == 1
    assert found.holds + found.fails > 0


@pytest.mark.parametrize(("target", "check"), WITNESSES)
@pytest.mark.parametrize("seed", [3, 24])
def test_random_swarms(seed: int, target: str, check: Checker, tmp_path: Path) -> None:
    found = random(seed, target, check, tmp_path)

    assert found.counts == 1
    assert found.holds > 0
    assert found.fails > 0


@pytest.mark.long
@pytest.mark.timeout(3000)
@pytest.mark.parametrize(("target", "check"), WITNESSES)
@pytest.mark.parametrize("name", EXAMPLES)
def test_examples(name: str, target: str, check: Checker, tmp_path: Path) -> None:
    compare(ROOT / "examples" / name, target, check, tmp_path)
