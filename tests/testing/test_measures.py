"""Tests expect measures and the fitness."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from .conftest import MODEL, Ran

FITNESS = """
fitness Light {
  in bright : uint32   = max count(lamp in Bright)
  in spent  : duration = time(lamp in Bright)
  in gone   : duration = time until all lamp in Gone
  maximize bright
}
"""
Run = Callable[..., Ran]


@pytest.fixture
def run(folder: Path, ran: Run) -> Run:
    """Run tests of the model with a fitness."""
    model = MODEL.replace("swarm Lamps {", "swarm Lamps {\n  fitness Light\n")
    assert model != MODEL
    (folder / "lamps.swarm").write_text(model + FITNESS, encoding="utf-8")
    return ran


def case(measures: str) -> str:
    """Return a test that lights the lamps for a second."""
    steps = 'steps = [{ send = "Start" }, { pass = "1 s" }]'
    scenario = "scenario = { functions = { blink = { never = 1 } } }"
    return f'swarm = "Lamps"\n[[test]]\nname = "t"\n{scenario}\n{steps}\nmeasures = {measures}\n'


@pytest.mark.parametrize(
    "measures",
    [
        "{ bright = 3 }",
        '{ bright = ">= 3", spent = "3 s" }',
        '{ spent = "> 2.5 s", Light = "< 4" }',
        '{ gone = ">= 1 s" }',
    ],
)
def test_expected_measures(run: Run, measures: str) -> None:
    ran = run(case(measures))
    assert ran.code == 0, ran.out + ran.err


@pytest.mark.parametrize(
    ("measures", "expected", "actual"),
    [
        ("{ bright = 4 }", "expected `bright` == 4", "after 1 s: it is 3"),
        ('{ spent = "<= 2 s" }', "expected `spent` <= 2 s", "it is 3 s"),
        ('{ Light = "> 3.5" }', "expected `Light` > 3.5", "it is 3"),
        ('{ gone = "<= 1 min" }', "expected `gone` <= 1 min 0 s", "it is 1 s, when it had not"),
    ],
)
def test_other_measures_fail(run: Run, measures: str, expected: str, actual: str) -> None:
    ran = run(case(measures))
    assert ran.code == 1
    said = ran.out + ran.err
    assert f"error[SW1101]: {expected}" in said
    assert actual in said


@pytest.mark.parametrize(
    ("measures", "code"),
    [
        ("{ brihgt = 3 }", "SW0202"),
        ('{ bright = "many" }', "SW0013"),
        ("{ spent = 3 }", "SW0013"),
        ("{ bright = true }", "SW0013"),
        ("3", "SW0013"),
    ],
)
def test_mistakes(run: Run, measures: str, code: str) -> None:
    ran = run(case(measures))
    assert ran.code == 1
    assert code in ran.out + ran.err


def test_without_a_fitness_there_is_nothing_to_expect(folder: Path, ran: Run) -> None:
    (folder / "lamps.swarm").write_text(MODEL, encoding="utf-8")
    found = ran(case("{ bright = 3 }"))
    assert found.code == 1
    assert "`Lamps` has no fitness with measures" in found.out + found.err
