"""The example `meadow`: what altitude, numbers of robots and batteries do to its fitness.

The same seeds are compared: people are at the same places in both runs of a pair.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.execution.simulate.one_run import Runner
from swarmdsl.execution.simulate.prepare import Request, prepare

ROOT = Path(__file__).resolve().parents[2]
MEADOW = ROOT / "examples" / "meadow"
SEEDS = (1, 2, 3, 4)


@pytest.fixture
def fitness(tmp_path):
    def fitness(until="4 min", uavs=3, altitude=2.5, watt_hours=60.0, width=5.0):
        text = (MEADOW / "mission.toml").read_text(encoding="utf-8")
        text = text.replace('until = "15 min"', f'until = "{until}"')
        text = text.replace("uav   = 3", f"uav   = {uavs}").replace("width = 5", f"width = {width}")
        text += f"\n[params.uav]\naltitude = {altitude}\ncapacity = {watt_hours * 3600}\n"
        scenario = tmp_path / "scenario.toml"
        scenario.write_text(text, encoding="utf-8")
        request, report = Request((MEADOW,), scenario=scenario), Diagnostics()
        prepared = prepare(request, report)
        assert prepared is not None, [each.message for each in report]
        runner = Runner(request, prepared)
        found = runner.run_all(SEEDS)
        assert all(each.fitness is not None for each in found)
        return [each.fitness for each in found]

    return fitness


def _is_better(more, less):
    """Compare pairs: none is worse but for a person or so, and all together are better."""
    return sum(more) > sum(less) and sum(a >= b for a, b in zip(more, less, strict=True)) >= 3


def test_more_robots_find_more(fitness):
    assert _is_better(fitness(uavs=4), fitness(uavs=1))


def test_a_higher_flight_with_wider_lanes_finds_more_in_the_same_time(fitness):
    assert _is_better(fitness(altitude=6.0, width=12.0), fitness(altitude=2.5, width=5.0))


def test_a_flight_above_the_range_of_the_camera_finds_nobody(fitness):
    assert max(fitness(altitude=35.0)) < 0


def test_a_larger_battery_finds_more(fitness):
    assert _is_better(fitness(watt_hours=60.0), fitness(watt_hours=2.5))
