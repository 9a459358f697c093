"""Runs that end their process, or never return: they fail alone, and end nothing else."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from swarmdsl.cli import run

from ..space.worlds import TEXT

FUNCTIONS = """
import os, time
from swarmdsl.execution.space.functions.base import Model, statuses
from swarmdsl.ir.function_models import Argument

class Fragile(Model):
    arguments = (Argument("seconds", "number", 3.0, "how long"),)

    def start(self, who, arguments):
        if arguments["seconds"] == 13:
            os._exit(3)
        if arguments["seconds"] == 14:
            time.sleep(1e6)  # no exception of Python ends this
        if arguments["seconds"] == 15:
            raise RuntimeError("no luck")

    def step(self, who, dt):
        return statuses(who >= 0)
"""
PROPERTY = "property Walks of S : some rover in Done within 10 s\n"
STUDY = """
model = "model.swarm"
scenario = "scenario.toml"
repetitions = 1
measure = "Walks"
[factors]
scenario.functions.walk.arguments.seconds = [13, 3, 14, 15]
"""


def test_runs_that_end_their_process_fail_alone(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    model = TEXT.replace("ROBOTS", "2") + PROPERTY
    files = {
        "swarm.toml": '[models]\nfragile = "functions.py:Fragile"\n',
        "functions.py": FUNCTIONS,
        "model.swarm": model,
        "scenario.toml": 'until = "20 s"\n[functions.walk]\nmodel = "fragile"\n',
        "study.toml": STUDY,
    }
    for name, text in files.items():
        Path(name).write_text(text, encoding="utf-8")

    # One job runs in a process of its own, because the project has code that may end it.
    words = ["experiment", "study.toml", "--jobs", "1", "--limit", "1.5", "-o", "out", "--json"]
    assert run(words) == 1
    said = capsys.readouterr()
    assert "error[SW1611]: 3 of 4 runs have no result: its process ends" in said.err
    points = json.loads(said.out)["points"]
    reasons = [each["failures"][0]["reason"] if "failures" in each else "" for each in points]
    gone = "its process ends, or it does not return within 1.5 s"
    assert reasons == [gone, "", gone, reasons[3]]
    assert "RuntimeError: no luck" in reasons[3]
