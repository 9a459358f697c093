"""The growth of each phase is measured, and the work of a phase grows with the model alone."""

from __future__ import annotations

import sys
import warnings
from pathlib import Path

import pytest

from ..instructions import executed, is_proportional

BENCHMARKS = Path(__file__).resolve().parents[2] / "benchmarks"
sys.path.insert(0, str(BENCHMARKS))
import growth  # noqa: E402
from growth import Sizes, exponents  # noqa: E402
from growth_models import FAMILIES  # noqa: E402
from growth_phases import PHASES, Model  # noqa: E402

sys.path.remove(str(BENCHMARKS))

FEW = 25
FEWER = {"document": 12}
"""For phases that take long."""
MENDED = [
    ("print", "final states with done"),
    ("plantuml", "regions with events out"),
    ("plantuml", "parts and connectors"),
    ("import", "final states with done"),
    ("simulate", "eventless chain"),
    ("document", "files"),
    ("check", "addresses"),
]
"""Phases that once took more than four times as long for four times the model."""


@pytest.mark.parametrize("family", FAMILIES)
def test_the_models_of_a_family_are_valid(family: str, tmp_path: Path) -> None:
    for count in (2, 3, 25):
        assert Model(tmp_path / str(count), FAMILIES[family](count)).system.name


def test_each_phase_is_measured(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    # Which phases apply does not depend on what is measured.
    monkeypatch.setattr(growth, "ROUNDS", 1)
    monkeypatch.setattr(growth, "MORE_ROUNDS", 0)
    families = {name: FAMILIES[name] for name in ("swarm events", "parts and connectors")}
    with warnings.catch_warnings():
        # A worker of pytest-xdist has a thread that receives messages; the child does not need it.
        warnings.simplefilter("ignore", DeprecationWarning)
        table = exponents(tmp_path, families, dict.fromkeys(PHASES, Sizes(3, 4)))

    applied = {
        name: {phase for phase in row if row[phase] is not None} for name, row in table.items()
    }
    assert applied == {
        "swarm events": set(PHASES),
        "parts and connectors": set(PHASES) - {"import", "read SCXML", "simulate"},
    }


@pytest.mark.parametrize(("phase", "family"), MENDED)
def test_twice_the_model_is_twice_the_work(phase: str, family: str, tmp_path: Path) -> None:
    works = []
    few = FEWER.get(phase, FEW)
    for count in (2, few, 2 * few, 4 * few):  # the first time, modules are imported
        action = PHASES[phase](Model(tmp_path / str(count), FAMILIES[family](count)))
        works.append(executed(action))
    assert is_proportional(works[1:]), works
