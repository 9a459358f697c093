"""A branch in which nothing is changed goes on as the recording did."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Source
from swarmdsl.execution.monitor import LOST
from swarmdsl.execution.simulate.run.prepare import Request, prepare
from swarmdsl.execution.simulate.scenario.durations import MILLISECOND, SECOND
from swarmdsl.execution.simulate.world.line import Line, as_json
from swarmdsl.execution.simulate.world.runner import run
from swarmdsl.execution.simulate.world.world import World
from swarmdsl.execution.testing.case import InvalidTest
from swarmdsl.execution.testing.models import Models
from swarmdsl.execution.testing.reading import read_tests
from swarmdsl.execution.testing.verdict import judge
from swarmdsl.tools.player.engine_world import written_world

from ..verify.random_swarms import random_swarm
from .engine_in_page import needs_node, node

ROOT = Path(__file__).resolve().parents[2]
EXAMPLES = [
    ("search_and_rescue", "mission.toml", "SearchAndRescue"),
    ("agriculture", "season.toml", None),
    ("storage", None, None),
    ("minimal", None, None),
    ("emergency_exit", None, None),
]
FORKS = (-1, 0, 3, 10, 25, 60, 100)
MOST_LINES = 600


class _EnoughError(Exception):
    """A run has many lines: robots that answer each other may send ever more messages."""


def recorded(request: Request, until: int) -> dict[str, Any]:
    """A run of the simulator, as it is on the page, to be forked at some lines."""
    report = Diagnostics()
    prepared = prepare(request, report)
    assert prepared is not None, [each.message for each in report]
    cast, inputs = prepared.stage(report)
    seed = request.seed or prepared.scenario.seed
    subject = prepared.subject
    lines: list[dict[str, Any]] = []

    def note(line: Line) -> None:
        variables = {k: v for k, v in line.actor.data.items() if not callable(v) and k != "self"}
        name = line.actor.name or line.actor.machine.name
        lines.append({**json.loads(as_json(line)), "member": name, "variables": variables})
        lines[-1] = json.loads(json.dumps(lines[-1]))
        if len(lines) > MOST_LINES:
            raise _EnoughError

    world = World(subject.system, cast, prepared.scenario, seed, [note], subject.heartbeat)
    given = written_world(subject, cast, world)
    try:
        run(world, inputs, until)
    except _EnoughError:
        # The millisecond of the last line may have more.
        last = lines[-1]["t"]
        lines = [each for each in lines if each["t"] < last]
        until = last * MILLISECOND - 1
    forks = [each for each in FORKS if each < len(lines)]
    return {"world": given, "lines": lines, "lost": LOST, "end": until, "forks": forks}


def check(cases: list[dict[str, Any]], folder: Path) -> None:
    found = node("branches.js", map(json.dumps, cases), folder)
    for case, differences in zip(cases, found, strict=True):
        for last, difference in zip(case["forks"], differences, strict=True):
            words = json.dumps(difference, indent=1)
            assert difference is None, f"{case['world']['subject']} after {last}: {words}"


@needs_node
def test_examples(tmp_path: Path) -> None:
    cases = []
    for name, scenario, swarm in EXAMPLES:
        folder = ROOT / "examples" / name
        path = folder / scenario if scenario else None
        request = Request((folder,), swarm=swarm, scenario=path, world="abstract")
        cases.append(recorded(request, 120 * SECOND))
    assert sum(len(each["lines"]) for each in cases) > 500
    check(cases, tmp_path)


SCENARIO = """until = "40 s"
[network]
latency = { uniform = ["5 ms", "900 ms"] }
loss = 0.2
[functions.attempt]
duration = { normal = ["2 s", "1 s"] }
aborted = 0.2
never = 0.1
results = [{ ok = true }, { ok = false }]
[[messages]]
event = "Go"
at = "2 s"
every = "3 s"
"""


@needs_node
def test_random_swarms(pytestconfig: pytest.Config, tmp_path: Path) -> None:
    cases = []
    (tmp_path / "scenario.toml").write_text(SCENARIO)
    # The last ones have events that others must not overtake, and servers that stop at their time.
    few = (*range(10), 13, 63, 68)
    for seed in range(300) if pytestconfig.getoption("--agreement") else few:
        path = tmp_path / f"swarm{seed}.swarm"
        path.write_text(random_swarm(seed))
        scenario = tmp_path / "scenario.toml"
        cases.append(recorded(Request((path,), scenario=scenario, seed=seed), 40 * SECOND))
    check(cases, tmp_path)


@needs_node
def test_saved_tests_pass(tmp_path: Path) -> None:
    """A branch with other events and outcomes is a test that `swarmc test` passes."""
    folders = [ROOT / "examples" / name for name in ("search_and_rescue", "minimal")]
    (tmp_path / "scenario.toml").write_text(SCENARIO)
    for seed in (1, 2, 4):
        folder = tmp_path / f"seed{seed}"
        folder.mkdir()
        (folder / "model.swarm").write_text(random_swarm(seed))
        folders.append(folder)
    cases = []
    for folder in folders:
        scenario = tmp_path / "scenario.toml" if folder.parent == tmp_path else None
        request = Request((folder,), scenario=scenario, world="abstract", seed=3)
        cases.append(recorded(request, 40 * SECOND))
    changed = 0
    for folder, texts in zip(
        folders, node("saved.js", map(json.dumps, cases), tmp_path), strict=True
    ):
        for text in texts:
            report = Diagnostics()
            path = folder / "branch.swarmtest.toml"
            tests = read_tests(Source(path.as_posix(), text, path), Models(), report)
            assert tests is not None, ([each.message for each in report], text)
            (case,) = tests.cases
            assert not isinstance(case, InvalidTest), ([e.message for e in case.problems], text)
            verdict = judge(case, case.seeds, lambda _seed, _line: None)
            assert verdict.passed, (verdict, text)
            changed += 'as = "aborted"' in text or "send = " in text
    assert changed > 5
