"""Tests of live states from traces."""

from __future__ import annotations

import json
import os
import sys
import threading
from collections.abc import Iterator
from pathlib import Path
from queue import SimpleQueue
from types import SimpleNamespace
from typing import Any

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.cli import run
from swarmdsl.driver import pipeline
from swarmdsl.ide.preview.live_trace import follow
from swarmdsl.ide.preview.pictures import Pictures, pictures
from swarmdsl.ide.preview.serving import Snapshot

PATIENCE = 60
MODEL = """package yard
import cpswarm.interfaces.*
swarm event Go : swarmros/SimpleEvent
sensor Eye { behavior Watching }
member Dog {
  eye : Eye
  behavior Guarding
}
swarm Pack { dog : Dog[2] }
statemachine Watching { initial Open; state Open { after 1 s -> Shut } final Shut }
statemachine Round {
  initial Walk
  state Walk { after 1 s -> Rest }
  final Rest
}
endless statemachine Guarding {
  initial Lie
  state Lie { on Go -> Patrol }
  state Patrol = Round { on done -> Lie }
}
"""


def step(member: str | None, *states: str, **more: Any) -> str:
    names = ("entered", "exited", "started", "cancelled", "sent")
    line = {"t": 0, "member": member, "event": None, "configuration": states}
    return json.dumps({**line, **{name: [] for name in names}, **more}) + "\n"


class Page:
    """Records the updates of members that a page receives."""

    def __init__(self, snapshot: Snapshot, key: str = "active") -> None:
        self._key = key
        self._told: SimpleQueue[Any] = SimpleQueue()
        self._hears = threading.Event()
        threading.Thread(target=self._hear, args=(snapshot.follow(),), daemon=True).start()
        assert self._hears.wait(PATIENCE)

    def _hear(self, messages: Iterator[Any]) -> None:
        for several in messages:
            self._hears.set()
            for each in several:
                if self._key in each:
                    self._told.put(each[self._key])

    def told(self) -> Any:
        return self._told.get(timeout=PATIENCE)

    def wait_until(self, wanted: Any) -> None:
        """Wait until the merged updates are as expected; fast updates may arrive together."""
        found: Any = {}
        while found != wanted:
            found |= self.told()


@pytest.fixture
def shown(tmp_path: Path) -> Pictures:
    path = tmp_path / "yard.swarm"
    path.write_text(MODEL, encoding="utf-8")
    made = pictures(pipeline.check([path]))
    assert isinstance(made, Pictures), made
    return made


@pytest.fixture
def snapshot(shown: Pictures) -> Snapshot:
    snapshot = Snapshot()
    snapshot.tell(shown)
    return snapshot


def test_diagrams_name_the_runners(shown: Pictures) -> None:
    runs = shown.listed()["runs"]
    assert runs == {
        "Guarding.statechart": [("Guarding", ""), ("dog", "")],
        "Round.statechart": [("Guarding", "Patrol."), ("Round", ""), ("dog", "Patrol.")],
        "Watching.statechart": [("Watching", ""), ("dog.eye", "")],
    }
    assert list(runs) == [each for each in shown.listed()["titles"] if each in runs]


def test_growing_trace_is_followed(snapshot: Snapshot, tmp_path: Path) -> None:
    trace = tmp_path / "trace.jsonl"
    wrong: list[Diagnostics] = []
    follow([str(trace)], snapshot, wrong.append)
    page = Page(snapshot)
    # A monitor writes its verdicts and measures between lines.
    verdict = json.dumps({"t": 0, "property": "Calm", "verdict": "true"}) + "\n"
    verdict += json.dumps({"t": 0, "fitness": "Most", "measures": [], "final": True}) + "\n"
    verdict += json.dumps({"t": 1000, "moved": {"uav[0]": [1.0, 2.0, 0.0]}}) + "\n"
    lines = step("dog[0]", "Lie") + verdict + step("dog[1]", "Lie")
    trace.write_text(lines, encoding="utf-8")
    assert page.told() == {"dog[0]": ["Lie"], "dog[1]": ["Lie"]}
    with trace.open("a", encoding="utf-8") as file:
        file.write(step("dog[1]", "Patrol.Walk") + step("dog[0]", "Shut")[:-10])
        file.flush()
        assert page.told() == {"dog[1]": ["Patrol.Walk"]}
        assert Page(snapshot).told() == {"dog[0]": ["Lie"], "dog[1]": ["Patrol.Walk"]}, (
            "a late page"
        )
        file.write(step("dog[0]", "Shut")[-10:])
    assert page.told() == {"dog[0]": ["Shut"]}
    trace.write_text(step("dog[1]", "Lie"), encoding="utf-8")
    page.wait_until({"dog[0]": None, "dog[1]": ["Lie"]})  # it begins anew
    other = tmp_path / "other.jsonl"
    other.write_text(step("dog[2]", "Patrol.Walk"), encoding="utf-8")
    other.replace(trace)
    page.wait_until({"dog[1]": None, "dog[2]": ["Patrol.Walk"]})
    assert wrong == []


def test_recent_transitions_are_published(snapshot: Snapshot, tmp_path: Path) -> None:
    trace = tmp_path / "trace.jsonl"
    page = Page(snapshot, "taken")
    follow([str(trace)], snapshot, pytest.fail)
    steps = [
        step("dog[0]", "Patrol.Walk", t=100, taken=["Lie->0"]),
        step("dog[1]", "Patrol.Walk", t=9100, taken=["Lie->0"]),
        step("dog[0]", "Patrol.Rest", t=9500, taken=["Patrol.Walk->0"]),
        step("dog[0]", "Lie", t=10_000, taken=["Patrol->0", "Lie->1"]),
    ]
    trace.write_text("".join(steps), encoding="utf-8")
    told = page.told()
    assert told == {"dog[1]": ["Lie->0"], "dog[0]": ["Patrol.Walk->0", "Patrol->0", "Lie->1"]}
    late = Page(snapshot, "taken")
    with trace.open("a", encoding="utf-8") as file:
        file.write(step("dog[1]", "Patrol.Rest", t=20_000, taken=["Patrol.Walk->0"]))
    assert page.told() == late.told() == {"dog[1]": ["Patrol.Walk->0"]}


def test_machine_outside_of_a_swarm_is_found_by_its_states(
    snapshot: Snapshot, tmp_path: Path
) -> None:
    trace = tmp_path / "trace.jsonl"
    follow([str(trace)], snapshot, pytest.fail)
    trace.write_text(step(None, "Lie"), encoding="utf-8")
    assert Page(snapshot).told() == {"Guarding": ["Lie"]}


def test_several_machines_are_named_after_their_traces(snapshot: Snapshot, tmp_path: Path) -> None:
    names = [str(tmp_path / name) for name in ("a.jsonl", "b.jsonl")]
    for name in names:
        Path(name).write_text(step(None, "Lie"), encoding="utf-8")
    follow(names, snapshot, pytest.fail)
    Page(snapshot).wait_until({f"Guarding ({name})": ["Lie"] for name in names})


def test_only_the_first_invalid_line_is_reported(snapshot: Snapshot, tmp_path: Path) -> None:
    trace = tmp_path / "trace.jsonl"
    wrong: list[Diagnostics] = []
    follow([str(trace)], snapshot, wrong.append)
    text = f"{step('dog[0]', 'Lie')}\nhello\n[1]\n{{}}\n{step('dog[1]', 'Lie')}"
    trace.write_text(text, encoding="utf-8")
    assert Page(snapshot).told() == {"dog[0]": ["Lie"], "dog[1]": ["Lie"]}
    (report,) = wrong
    (found,) = report
    assert (found.code, found.notes) == (
        "SW1010",
        (f"line 3 of {trace}; further invalid lines are not reported",),
    )


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="pipes with names are of POSIX")
def test_a_pipe_is_not_followed(snapshot: Snapshot, tmp_path: Path) -> None:
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    told: SimpleQueue[Diagnostics] = SimpleQueue()
    follow([str(pipe)], snapshot, told.put)
    (found,) = told.get(timeout=60)
    assert found.message == f"`{pipe}` is a pipe, not a trace"


@pytest.mark.skipif(os.name != "posix", reason="pipes of POSIX")
def test_standard_input_is_followed(
    snapshot: Snapshot, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    reading, writing = os.pipe()
    with os.fdopen(reading) as stdin, os.fdopen(writing, "wb", buffering=0) as stream:
        monkeypatch.setattr(sys, "stdin", stdin)
        follow(["-"], snapshot, pytest.fail)
        page = Page(snapshot)
        stream.write(step("dog[0]", "Lie").encode())
        assert page.told() == {"dog[0]": ["Lie"]}
        # A last line may have no end.
        stream.write(step("dog[0]", "Patrol.Walk").strip().encode())
        stream.close()
        assert page.told() == {"dog[0]": ["Patrol.Walk"]}


@pytest.mark.parametrize(
    ("name", "why"),
    [
        ("/sar/uav 0", "`/sar/uav 0` is not a valid ROS name"),
        ("sar//uav", "`sar//uav` is not a valid ROS name"),
        ("/é", "`/é` is not a valid ROS name"),
        (f"{'rescue_' * 20}uav_0-x", f"`{'rescue_' * 20}uav_0-x` is not a valid ROS name"),
        *((name, f"{sys.executable} has no rclpy") for name in ("/sar", "sar/uav_0/", "/", "")),
    ],
)
def test_invalid_node_names(
    name: str, why: str, tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: Any
) -> None:
    monkeypatch.setitem(sys.modules, "rclpy", None)
    (tmp_path / "yard.swarm").write_text(MODEL, encoding="utf-8")
    assert run(["preview", str(tmp_path), "--follow", f"ros2:{name}"]) == 1
    said = capsys.readouterr().err
    assert f"error[SW1012]: cannot follow ROS 2 nodes: {why}" in said
    assert "help: " in said


def test_ros_2_without_its_usual_messages(tmp_path: Path, capsys: Any, monkeypatch: Any) -> None:
    for name in ("rclpy", "rclpy.executors"):
        there = SimpleNamespace(SingleThreadedExecutor=None)
        monkeypatch.setitem(sys.modules, name, there)
    monkeypatch.setitem(sys.modules, "std_msgs.msg", None)
    (tmp_path / "yard.swarm").write_text(MODEL, encoding="utf-8")
    assert run(["preview", str(tmp_path), "--follow", "ros2:"]) == 1
    assert f"{sys.executable} has no std_msgs.msg" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("command", "why"),
    [
        ("nowhere-to-be-found {file}", "program `nowhere-to-be-found` not found"),
        ("code -g {path}", "unknown field `{path}`, expected {file}, {line} or {column}"),
        ("code -g", "field `{file}` is missing"),
        ('code "{file}', "no closing quotation"),
        ("", "field `{file}` is missing"),
    ],
)
def test_invalid_editors(command: str, why: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["preview", "--editor", command]) == 2
    assert why in " ".join(capsys.readouterr().err.replace("│", " ").split())
