"""Outputs that would replace what a command reads, a source, or another output."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from .conftest import GOOD, Ran

SCENARIO = 'until = "1 s"\n'
TEST = 'model = "lamps.swarm"\nmachine = "Blinking"\n[[test]]\nname = "it ends"\nsteps = []\n'
EVENTS = '{"event": "Blink"}\n'
FILES = {
    "lamps.swarm": GOOD,
    "scenario.toml": SCENARIO,
    "lamps.swarmtest.toml": TEST,
    "events.jsonl": EVENTS,
    "trace.jsonl": "",
    "swarm.toml": '[project]\nname = "lamps"\n',
}
SIMULATED = "simulate lamps.swarm"


@pytest.fixture
def folder(tmp_path, monkeypatch) -> Path:
    for name, text in FILES.items():
        (tmp_path / name).write_text(text)
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.mark.parametrize(
    ("command", "option", "name", "reason"),
    [
        (SIMULATED, "--results", "lamps.swarm", "an input of this command"),
        (SIMULATED, "--trace-file", "lamps.swarm", "an input of this command"),
        (SIMULATED, "--timeline", "lamps.swarm", "an input of this command"),
        (SIMULATED, "--map", "lamps.swarm", "an input of this command"),
        (SIMULATED, "--results", "./lamps.swarm", "an input of this command"),
        (f"{SIMULATED} --scenario scenario.toml", "--results", "scenario.toml", "an input"),
        (f"{SIMULATED} --events events.jsonl", "--trace-file", "events.jsonl", "an input"),
        (f"{SIMULATED} --replay trace.jsonl", "--results", "trace.jsonl", "an input"),
        (f"{SIMULATED} --runs 2", "--results", "lamps.swarm", "an input of this command"),
        (f"{SIMULATED} --runs 2", "--histogram", "lamps.swarm", "an input of this command"),
        ("simulate .", "--results", "lamps.swarm", "part of a model, of its tests"),
        ("simulate", "--results", "swarm.toml", "part of a model, of its tests"),
        (f"{SIMULATED} --trace-file run.json", "--results", "run.json", "the file of"),
        ("verify lamps.swarm", "--results", "lamps.swarm", "an input of this command"),
        ("verify lamps.swarm", "--junit", "lamps.swarm", "an input of this command"),
        ("test lamps.swarmtest.toml", "--junit", "lamps.swarmtest.toml", "an input"),
        ("test lamps.swarmtest.toml", "--junit", "lamps.swarm", "part of a model"),
        ("diagram lamps.swarm --name Blinker", "-o", "lamps.swarm", "an input of this command"),
    ],
)
def test_an_output_in_place_of_a_source(
    folder: Path,
    swarmc: Callable[..., Ran],
    command: str,
    option: str,
    name: str,
    reason: str,
) -> None:
    ran = swarmc(*command.split(), option, name)
    assert ran.code == 2
    assert option in ran.err
    assert reason in ran.err
    assert "name another file" in ran.err
    assert {each: (folder / each).read_text() for each in FILES} == FILES
    assert {each.name for each in folder.iterdir()} == FILES.keys()


def test_outputs_that_exist_are_written_anew(folder: Path, swarmc: Callable[..., Ran]) -> None:
    (folder / "results.json").write_text("old")
    (folder / "notes.toml").write_text("old")
    assert swarmc(*SIMULATED.split(), "--results", "results.json").code == 0
    assert "Blinking" in (folder / "results.json").read_text()
    assert swarmc(*SIMULATED.split(), "--trace-file", "notes.toml").code == 0
    assert "Blink" in (folder / "notes.toml").read_text()
