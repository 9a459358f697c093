"""Examples in the flat world: they end, their properties hold, and what must matter does.

Both runs of a pair have the same seed: robots start at the same places, and so are targets.
"""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.cli import run
from swarmdsl.execution.simulate.many_runs.one_run import Runner
from swarmdsl.execution.simulate.run.prepare import Request, prepare

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
FIRST = {
    "emergency_exit": "15 min",
    "search_and_rescue": "8 min",
    "agriculture": "8 min",
    "flocking": "6 min",
    "storage": "5 min",
    "turtlebots": "7 min",
    "crazyflies": "1 min",
}
"""Time up to which runs of each example go."""
NAMES = ("emergency_exit",)
SEEDS = (1, 2, 3, 4)


def _outcomes(name, scenario, seeds=SEEDS, properties=True):
    request = Request((EXAMPLES / name,), scenario=scenario, properties=properties)
    report = Diagnostics()
    prepared = prepare(request, report)
    assert prepared is not None, [each.message for each in report]
    assert prepared.spaces.is_flat
    runner = Runner(request, prepared)
    return runner.properties, runner.run_all(seeds)


@pytest.mark.parametrize("name", FIRST)
def test_properties_hold_and_there_is_a_fitness(name, tmp_path):
    text = (EXAMPLES / name / "flat.toml").read_text(encoding="utf-8")
    scenario = tmp_path / "scenario.toml"
    until = re.search(r'until = "(.*)"', text)
    scenario.write_text(text.replace(until[1], FIRST[name]), encoding="utf-8")
    properties, outcomes = _outcomes(name, scenario, seeds=SEEDS[:2])
    certain = [number for number, each in enumerate(properties) if each.chance is None]
    assert certain
    for outcome in outcomes:
        # A property with a chance may be false in a run: ways can be long.
        broken = [properties[n].name for n in certain if outcome.verdicts[n] == "false"]
        assert not broken
        assert outcome.fitness is not None, outcome.reason


@pytest.mark.parametrize("name", NAMES)
def test_a_run_is_the_same_twice(name, capsys):
    scenario = str(EXAMPLES / name / "flat.toml")
    said = []
    for _ in range(2):
        code = run(["simulate", str(EXAMPLES / name), "--scenario", scenario, "--trace", "json"])
        assert code == 0
        said.append(capsys.readouterr().out)
    assert '"at"' in said[0]
    assert said[0] == said[1]


def test_faster_robots_are_out_earlier(tmp_path):
    text = (EXAMPLES / "emergency_exit" / "flat.toml").read_text(encoding="utf-8")
    found = []
    for speed in (0.1, 0.4):
        scenario = tmp_path / "scenario.toml"
        scenario.write_text(f"{text}\n[params.robot]\nspeed = {speed}\n", encoding="utf-8")
        _, outcomes = _outcomes("emergency_exit", scenario, properties=False)
        found.append([each.fitness for each in outcomes])
    slow, fast = found
    assert sum(fast) > sum(slow)
    assert sum(a > b for a, b in zip(fast, slow, strict=True)) >= 3
