"""Import of what runs and what is installed, on a real ROS 2."""

from __future__ import annotations

import json
import os
import time
from pathlib import Path
from typing import Any

import pytest

from swarmdsl.cli import run
from swarmdsl.importing import ros_graph

PATIENCE = 60.0
"""Seconds for nodes to find each other on a busy machine."""
MODEL = """
package lab
import ros "uav_mavros_takeoff"

function lift : abstraction { action "cmd/takeoff" : uav_mavros_takeoff/TakeOff }

statemachine Lifting {
  initial Lift
  state Lift { do lift(altitude = 2.5); on succeeded, aborted -> Done }
  final Done
}
"""


@pytest.fixture
def sourced(ros: Any, monkeypatch: pytest.MonkeyPatch) -> Any:
    """The environment of ROS in this process, as its setup file makes it."""
    for name, value in ros.environment.items():
        monkeypatch.setenv(name, value)
    path = os.pathsep.join([str(ros.python.parent), os.environ["PATH"]])
    monkeypatch.setenv("PATH", path)
    return ros


@pytest.fixture
def awaited(monkeypatch: pytest.MonkeyPatch) -> Any:
    """Let the graph be read until it has some names: discovery takes time."""
    read = ros_graph.read_graph

    def await_(*names: str) -> None:
        def read_again(quiet: float) -> ros_graph.Graph:
            end = time.monotonic() + PATIENCE
            while True:
                graph = read(quiet)
                parts = (graph.actions, graph.services, graph.topics, graph.every_topic)
                missing = {*names} - {name for part in parts for name, _ in part}
                if not missing:
                    return graph
                assert time.monotonic() < end, missing

        monkeypatch.setattr(ros_graph, "read_graph", read_again)

    return await_


def test_functions_and_events_of_a_running_graph(
    sourced: Any, awaited: Any, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    fakes = sourced.fakes()
    awaited(*(f"/sar/uav_0/{name}" for name in ("cmd/takeoff", "cmd/land", "mission_start")))
    fakes.action("/sar/uav_0/cmd/takeoff", "uav_mavros_takeoff/action/TakeOff", "succeeded")
    fakes.service("/sar/uav_0/cmd/land", "std_srvs/srv/Trigger")
    fakes.publisher("/sar/uav_0/mission_start", "swarmros/msg/SimpleEvent")
    fakes.publisher("/elsewhere/tick", "std_msgs/msg/Empty")
    fakes.do("subscribe", topic="/sar/uav_0/only_heard", kind="std_msgs/msg/Empty")
    out = tmp_path / "uav.swarm"
    words = ["import", "ros2", "--from-graph", "--namespace", "/sar/uav_0", "--quiet", "1"]

    assert run([*words, "-o", str(out)]) == 0, capsys.readouterr().err
    assert "3 functions and events were found" in capsys.readouterr().err
    text = out.read_text(encoding="utf-8")
    assert 'action "cmd/takeoff" : uav_mavros_takeoff/TakeOff' in text
    assert 'service "cmd/land" : std_srvs/Trigger' in text
    assert "event MissionStart : swarmros/SimpleEvent" in text
    # Interfaces are those that are installed, and those in their fields.
    assert "altitude : float64" in text
    assert "message swarmros/EventHeader" in text
    assert "only_heard" not in text
    assert "tick" not in text
    # What runs has not changed.
    assert run([*words, "-o", str(out), "--dry-run"]) == 0


def test_models_import_installed_packages_by_their_names(
    sourced: Any,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    model = tmp_path / "model.swarm"
    model.write_text(MODEL, encoding="utf-8")
    assert run(["check", str(model)]) == 0, capsys.readouterr()
    model.write_text(MODEL.replace("altitude =", "height ="), encoding="utf-8")
    assert run(["check", str(model)]) == 1
    assert "has no field `height`" in capsys.readouterr().out
    assert run(["import", "ros", "uav_mavros_takeoff"]) == 0
    assert "action uav_mavros_takeoff/TakeOff" in capsys.readouterr().out

    monkeypatch.setenv("AMENT_PREFIX_PATH", str(tmp_path))
    assert run(["check", str(model)]) == 1
    assert "with the setup file of ROS 2 sourced" in capsys.readouterr().out


def test_doctor_compares_a_model_with_what_is_installed_and_runs(
    sourced: Any, awaited: Any, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    fakes = sourced.fakes()
    awaited("/sar/uav_0/cmd/takeoff", "/sar/uav_0/cmd/land")
    fakes.action("/sar/uav_0/cmd/takeoff", "uav_mavros_takeoff/action/TakeOff", "succeeded")
    fakes.service("/sar/uav_0/cmd/land", "std_srvs/srv/Trigger")
    model = tmp_path / "model.swarm"
    model.write_text(MODEL, encoding="utf-8")
    assert run(["doctor", "--model", str(model), "--running"]) == 0, capsys.readouterr()
    ok = capsys.readouterr().out
    assert "  ok  uav_mavros_takeoff/TakeOff  " in ok
    assert "  ok  cmd/takeoff  /sar/uav_0/cmd/takeoff\n" in ok

    own = """
action uav_mavros_takeoff/TakeOff {
  goal { altitude : float32 }
  result { speed : float32 }
}
function land : abstraction { service "cmd/land" : std_srvs/Empty }
function wave : abstraction { service "cmd/wave" : wave_msgs/Wave }
service wave_msgs/Wave { request { } response { } }
"""
    model.write_text(MODEL.replace('import ros "uav_mavros_takeoff"', "") + own, encoding="utf-8")
    assert run(["doctor", "--model", str(model), "--running", "--format", "json"]) == 1
    told = json.loads(capsys.readouterr().out)
    faults = {each["name"]: each["fault"] for part in told.values() for each in part}
    assert faults["wave_msgs/Wave"] == "package wave_msgs is not installed"
    altitude = "field `altitude` of its goal is float64, but float32 in the model"
    assert altitude in faults["uav_mavros_takeoff/TakeOff"]
    assert "it has no field `speed` of its result" in faults["uav_mavros_takeoff/TakeOff"]
    assert faults["cmd/land"] == (
        "/sar/uav_0/cmd/land is std_srvs/Trigger, but std_srvs/Empty in the model"
    )
    assert faults["cmd/wave"] == "no service server runs"
    assert faults["cmd/takeoff"] == faults["std_srvs/Empty"] == ""


def test_doctor_compares_topics_that_are_only_heard(
    sourced: Any, awaited: Any, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    fakes = sourced.fakes()
    awaited("/sar/uav_0/go")
    fakes.do("subscribe", topic="/sar/uav_0/go", kind="std_msgs/msg/Empty")
    model = tmp_path / "model.swarm"
    model.write_text("swarm operator event Go : std_msgs/String", encoding="utf-8")
    assert run(["doctor", "--model", str(model), "--running"]) == 1
    fault = "/sar/uav_0/go is std_msgs/Empty, but std_msgs/String in the model"
    assert f"  --  go  {fault}\n" in capsys.readouterr().out


def test_doctor_tells_that_nothing_was_compared(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(ros_graph, "read_graph", lambda quiet: ros_graph.Graph())
    model = tmp_path / "model.swarm"
    model.write_text("statemachine Quiet { initial Idle; final Idle }", encoding="utf-8")
    assert run(["doctor", "--model", str(model), "--running"]) == 0
    assert capsys.readouterr().out.count("\n  nothing is compared: none of those") == 2


def test_no_python_has_rclpy(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))

    monkeypatch.delenv("AMENT_PREFIX_PATH", raising=False)
    model = tmp_path / "model.swarm"
    model.write_text(MODEL.replace('import ros "uav_mavros_takeoff"', ""), encoding="utf-8")
    assert run(["doctor", "--model", str(model)]) == 1
    assert "ROS 2 is not sourced: AMENT_PREFIX_PATH is not set" in capsys.readouterr().out
    assert run(["doctor", "--running"]) == 2
    assert "name it with --model" in capsys.readouterr().err
    assert run(["import", "ros2", "--from-graph"]) == 2
    assert "no Python has rclpy: source the setup file of ROS 2" in capsys.readouterr().err
