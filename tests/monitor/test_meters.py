"""Meters agree with the definitions of the measures, on random functions of time."""

from __future__ import annotations

import random
from fractions import Fraction

import pytest

from swarmdsl.execution.monitor import Meter, Reading, aggregated

KINDS = ("count", "total", "time", "until", "mean", "min", "max")


def random_steps(dice: random.Random) -> list[tuple[int, int]]:
    """Make the steps of a run, each with its time and a number; several can be at one time."""
    time, steps = 0, []
    for _ in range(1 + dice.randrange(8)):
        steps.append((time, dice.randrange(4)))
        time += dice.choice((0, 1, 2, 5))
    return steps


def value(kind: str, steps: list[tuple[int, int]], end: int, *, momentary: bool) -> Reading:
    """Return the value of a measure by its definition, moment by moment."""
    numbers = [number for _, number in steps]

    def at(moment: int) -> int:
        return next(number for time, number in reversed(steps) if time <= moment)

    match kind:
        case "count":
            return Reading(numbers[-1])
        case "total":
            before = [0] * len(numbers) if momentary else [0, *numbers]
            rises = (max(b - a, 0) for a, b in zip(before, numbers, strict=False))
            return Reading(sum(rises))
        case "time":
            return Reading(sum(at(moment) for moment in range(end)))
        case "until":
            first = next((time for time, number in steps if number), None)
            return Reading(end, reached=False) if first is None else Reading(first)
        case "mean":
            whole = sum(at(moment) for moment in range(end))
            return Reading(float(Fraction(whole, end)) if end else numbers[-1])
        case "min":
            return Reading(min(numbers))
    return Reading(max(numbers))


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("momentary", [False, True])
def test_random_runs(kind: str, momentary: bool) -> None:
    dice = random.Random(kind)
    for _ in range(300):
        steps = random_steps(dice)
        over = kind if kind in ("mean", "min", "max") else None
        meter = Meter("count" if over else kind, over, momentary=momentary)
        for number, step in enumerate(steps):
            meter.step(*step)
            so_far = steps[: number + 1]
            assert meter.read(step[0]) == value(kind, so_far, step[0], momentary=momentary)
        end = steps[-1][0] + dice.randrange(6)
        assert meter.read(end) == value(kind, steps, end, momentary=momentary), steps


def test_what_never_happens_takes_until_the_limit() -> None:
    meter = Meter("until")
    meter.step(0, 0)
    assert meter.read(7, 20) == Reading(20, reached=False)
    meter.step(9, 2)
    assert meter.read(12, 20) == Reading(9)


@pytest.mark.parametrize(
    ("aggregate", "expected"),
    [
        ("sum", Reading(12, reached=False)),
        ("mean", Reading(4, reached=False)),
        ("min", Reading(2)),
        ("max", Reading(6, reached=False)),
    ],
)
def test_aggregates_of_robots(aggregate: str, expected: Reading) -> None:
    readings = [Reading(4), Reading(6, reached=False), Reading(2)]
    assert aggregated(aggregate, readings) == expected


def test_without_robots_only_the_sum_has_a_value() -> None:
    values = {each: aggregated(each, []).value for each in ("sum", "mean", "min", "max")}
    assert values == {"sum": 0, "mean": None, "min": None, "max": None}
