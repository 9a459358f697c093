"""Pages that other commands write: `--play`."""

from __future__ import annotations

import json
import re
import zlib
from base64 import b64decode
from pathlib import Path
from typing import Any

import pytest

from swarmdsl.cli import run

MODEL = """
event Go : std_msgs/Empty
endless statemachine Work {
  initial Off
  state Off { on Go -> On }
  state On { on Go -> Off }
}
member Robot { behavior Work }
swarm Crew { robot : Robot[2] }
property Stays of Crew : never some robot in On
"""
TEST = """swarm = "Crew"

[[test]]
name = "passes"
steps = [{ all = "robot", in = "Off" }]

[[test]]
name = "fails"
steps = [{ send = "Go", to = "robot[1]" }, { who = "robot[1]", in = "Off" }]
"""


def recorded(path: Path) -> dict[str, Any]:
    """The recording in a page."""
    text = path.read_text(encoding="utf-8")
    (found,) = re.findall(r'id="recording"[^>]*>([^<]+)<', text)
    value: dict[str, Any] = json.loads(zlib.decompress(b64decode(found)))
    return value


@pytest.fixture(autouse=True)
def _folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("model.swarm").write_text(MODEL, encoding="utf-8")
    Path("go.jsonl").write_text('{"event": "Go", "after": 1000}\n', encoding="utf-8")


def test_simulate_writes_the_page_of_its_run(capsys: pytest.CaptureFixture[str]) -> None:
    words = ["simulate", "model.swarm", "--events", "go.jsonl", "--trace-file", "run.jsonl"]
    # The property is violated, which the page tells.
    assert run([*words, "--seed", "7", "--play", "run.html"]) == 1
    assert capsys.readouterr().err.rstrip().endswith("run.html")
    page = recorded(Path("run.html"))
    assert [each["name"] for each in page["members"]] == ["robot[0]", "robot[1]"]
    assert page["seed"] == 7
    assert [each["code"] for each in page["notes"]] == ["SW1606"]

    assert run(["simulate", "model.swarm", "--replay", "run.jsonl", "--play", "old.html"]) == 1
    old = recorded(Path("old.html"))
    assert old["members"] == page["members"]
    assert [s["event"] for s in old["lines"]["steps"] if "event" in s] == [
        s["event"] for s in page["lines"]["steps"] if "event" in s
    ]


def test_verify_writes_the_page_of_its_counterexample(capsys: pytest.CaptureFixture[str]) -> None:
    words = ["verify", "model.swarm", "--property", "Stays"]
    assert run([*words, "--play", "wrong.html"]) == 1
    assert "Stays: wrong.html" in capsys.readouterr().err
    page = recorded(Path("wrong.html"))
    assert any("Work" in machine for machine in page["machines"])
    assert any(step.get("configuration") == ["On"] for step in page["lines"]["steps"])

    # What else is wrong is told first, but the run of a property is played.
    Path("model.swarm").write_text(MODEL.replace("On { on Go -> Off }", "On"), encoding="utf-8")
    assert run(["verify", "model.swarm", "-o", "runs", "--play", "wrong.html"]) == 1
    assert [path.stem for path in sorted(Path("runs").iterdir())] == ["Stays", "waits-On"]
    assert "Stays: wrong.html" in capsys.readouterr().err


def test_test_writes_the_page_of_the_first_failure(capsys: pytest.CaptureFixture[str]) -> None:
    Path("crew.swarmtest.toml").write_text(TEST, encoding="utf-8")
    assert run(["test", ".", "--play", "failed.html"]) == 1
    assert "fails: failed.html" in capsys.readouterr().err
    page = recorded(Path("failed.html"))
    (note,) = page["notes"]
    assert "robot[1]" in note["message"]
    assert any(step.get("configuration") == ["On"] for step in page["lines"]["steps"])

    Path("out").mkdir()
    assert run(["test", ".", "--play", "out"]) == 1
    assert "SW" in capsys.readouterr().err


def test_a_page_plays_one_run(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["simulate", "model.swarm", "--runs", "3", "--play", "run.html"]) == 2
    assert "`--play` and `--runs` conflict" in capsys.readouterr().err
