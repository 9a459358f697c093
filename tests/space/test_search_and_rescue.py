"""Search and rescue: what altitude, numbers of robots and batteries do to its fitness.

The same seeds are compared: people are at the same places in both runs of a pair.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.execution.simulate.many_runs.one_run import Runner
from swarmdsl.execution.simulate.run.prepare import Request, prepare

EXAMPLE = Path(__file__).resolve().parents[2] / "examples" / "search_and_rescue"
SEEDS = (1, 2, 3, 4)


@pytest.fixture(scope="module")
def fitness(tmp_path_factory):
    scenario = tmp_path_factory.mktemp("rescue") / "scenario.toml"

    def fitness(until="150 s", rovers=3, altitude=2.5, watt_hours=60.0, lost=()):
        text = (EXAMPLE / "flat.toml").read_text(encoding="utf-8")
        text = text.replace('until = "15 min"', f'until = "{until}"')
        text = text.replace("rover = 2", f"rover = {rovers}")
        text += f"\n[params.uav]\naltitude = {altitude}\ncapacity = {watt_hours * 3600}\n"
        for robot in lost:
            text += f'\n[[faults]]\nat = "1 s"\nlost = "{robot}"\n'
        scenario.write_text(text, encoding="utf-8")
        request, report = Request((EXAMPLE,), scenario=scenario), Diagnostics()
        prepared = prepare(request, report)
        assert prepared is not None, [each.message for each in report]
        found = Runner(request, prepared).run_all(SEEDS)
        assert all(each.fitness is not None for each in found)
        return [each.fitness for each in found]

    return fitness


@pytest.fixture(scope="module")
def usual(fitness):
    return fitness()


@pytest.fixture(scope="module")
def higher(fitness):
    return fitness(altitude=6.0)


def _is_better(more, less):
    """Compare pairs: all together are better, and hardly any is worse."""
    return sum(more) > sum(less) and sum(a >= b for a, b in zip(more, less, strict=True)) >= 3


def test_more_robots_rescue_more(fitness, usual):
    assert _is_better(usual, fitness(lost=("uav[1]", "uav[2]")))
    soon = {"until": "75 s", "altitude": 6.0}
    assert _is_better(fitness(**soon, rovers=5), fitness(**soon, rovers=1))


def test_a_higher_flight_sees_more_in_the_same_time(usual, higher):
    assert _is_better(higher, usual)


def test_a_flight_above_the_range_of_the_camera_sees_less(fitness, higher):
    assert _is_better(higher, fitness(altitude=35.0))


def test_a_larger_battery_rescues_more(fitness, usual):
    assert _is_better(usual, fitness(watt_hours=2.5))
