"""Recordings of a fleet, and fleets in terminals."""

from __future__ import annotations

import json
import os
import pty
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.typesys import Stores, get_typestore

from swarmdsl.cli import run
from swarmdsl.ide.fleet.recorded import BagClock, read_bag
from swarmdsl.ide.fleet.watch import Watch
from swarmdsl.tools.player.record import record_nothing

from .test_page import MODEL, line

STRING, BATTERY = "std_msgs/msg/String", "sensor_msgs/msg/BatteryState"
SECOND = 1_000_000_000


@pytest.fixture
def model(tmp_path: Path) -> Path:
    path = tmp_path / "model.swarm"
    path.write_text(MODEL, encoding="utf-8")
    return path


def record(path: Path, plugin: Any) -> Path:
    """Write what two robots tell to a bag; one of them falls silent."""
    types = get_typestore(Stores.ROS2_JAZZY)
    charge = types.types[BATTERY]
    fields = {each.name: 0 for each in charge.__dataclass_fields__.values()}
    battery = charge(**{**fields, **_arrays(types), "percentage": 0.5})
    about = {"node": "/crew/robot_0/work", "member": "robot[0]", "machine": "Work"}
    about |= {"model": "crew", "version": "1.0", "digest": "aa"}
    with Writer(path, version=9, storage_plugin=plugin) as writer:
        topics = {}

        def write(topic: str, time: float, message: Any, kind: str = STRING) -> None:
            if topic not in topics:
                topics[topic] = writer.add_connection(topic, kind, typestore=types)
            data = types.types[STRING](data=message) if kind == STRING else message
            writer.write(topics[topic], int(time * SECOND), types.serialize_cdr(data, kind))

        for number in range(2):
            said = line(0, f"robot[{number}]", None, "Off")
            write(f"/crew/robot_{number}/work/transitions", 1, said)
            write("/crew/members", 1, f"robot[{number}]")
        write("/crew/models", 1.5, json.dumps(about))
        write("/crew/robot_0/battery", 1.5, battery, BATTERY)
        write("/crew/robot_0/work/transitions", 2, line(1000, "robot[0]", "Visit", "On"))
        write("/crew/members", 8, "robot[0]")
        verdict = {"t": 1000, "property": "Stays", "verdict": "false"}
        write("/crew/crew_monitor/verdicts", 8, json.dumps(verdict))
    return path


def _arrays(types: Any) -> dict[str, Any]:
    import numpy as np

    header = types.types["std_msgs/msg/Header"]
    stamp = types.types["builtin_interfaces/msg/Time"](sec=0, nanosec=0)
    empty = np.array([], dtype=np.float32)
    return {
        "header": header(stamp=stamp, frame_id="base"),
        "present": True,
        "cell_voltage": empty,
        "cell_temperature": empty,
        "location": "",
        "serial_number": "",
    }


@pytest.mark.parametrize("plugin", [StoragePlugin.MCAP, StoragePlugin.SQLITE3])
def test_a_recording_is_shown(
    plugin: Any, model: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    bag = record(tmp_path / "bag", plugin)
    assert run(["fleet", str(model), "--follow", str(bag), "--terminal"]) == 0
    assert capsys.readouterr().out.splitlines() == [
        "robot[0] there On Visit 50%",
        "robot[1] lost Off start",
        "property Stays: false",
        "alarm: robot[1] is lost",
        "alarm: property Stays is violated",
    ]


def test_places_of_a_recording_are_on_the_map(model: Path, tmp_path: Path) -> None:
    types = get_typestore(Stores.ROS2_JAZZY)
    kind = "geometry_msgs/msg/PoseStamped"
    kinds = types.types
    header = kinds["std_msgs/msg/Header"](
        stamp=kinds["builtin_interfaces/msg/Time"](sec=0, nanosec=0), frame_id="map"
    )
    turned = kinds["geometry_msgs/msg/Quaternion"](x=0.0, y=0.0, z=0.0, w=1.0)
    at = kinds["geometry_msgs/msg/Point"](x=0.0, y=0.0, z=0.0)
    pose = kinds[kind](
        header=header, pose=kinds["geometry_msgs/msg/Pose"](position=at, orientation=turned)
    )
    with Writer(tmp_path / "bag", version=9, storage_plugin=StoragePlugin.MCAP) as writer:
        lines = writer.add_connection("/crew/robot_0/work/transitions", STRING, typestore=types)
        poses = writer.add_connection("/crew/robot_0/pose", kind, typestore=types)
        said = types.types[STRING](data=line(0, "robot[0]", None, "Off", began=1000))
        writer.write(lines, SECOND, types.serialize_cdr(said, STRING))
        for number in range(4):
            at.x = float(number)
            data = types.serialize_cdr(pose, kind)
            writer.write(poses, 2 * SECOND + number * SECOND // 2, data)
    clock = BagClock()
    watch = Watch("bag", None, record_nothing(None, "bag"), print, clock)
    read_bag(str(tmp_path / "bag"), watch, clock)
    (message,) = [each for each in next(watch.feed.follow()) if "lines" in each]
    moved = [(each["t"], each["moved"]) for each in message["lines"] if "moved" in each]
    assert moved == [
        (1000, {"robot[0]": [0.0, 0.0, 0.0]}),
        (2000, {"robot[0]": [2.0, 0.0, 0.0]}),
    ]


def test_a_damaged_recording_is_told(
    model: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    bag = tmp_path / "bag"
    bag.mkdir()
    (bag / "metadata.yaml").write_text("rosbag2_bagfile_information: 3\n", encoding="utf-8")
    assert run(["fleet", str(model), "--follow", str(bag), "--terminal"]) == 1
    assert "error[SW1024]: cannot read the recording" in capsys.readouterr().err
    whole = record(tmp_path / "whole", StoragePlugin.MCAP)
    (file,) = whole.glob("*.mcap")
    file.write_bytes(file.read_bytes()[:400])
    assert run(["fleet", str(model), "--follow", str(whole), "--terminal"]) == 1
    assert "error[SW1024]: cannot read the recording" in capsys.readouterr().err


@pytest.mark.parametrize("plugin", [StoragePlugin.MCAP, StoragePlugin.SQLITE3])
def test_damaged_bytes_are_told(
    plugin: Any, model: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    bag = record(tmp_path / "bag", plugin)
    (file,) = (*bag.glob("*.mcap"), *bag.glob("*.db3"))
    whole = file.read_bytes()
    codes = set()
    for at in range(0, len(whole), len(whole) // 12):
        file.write_bytes(whole[:at] + b"\xff" * 60 + whole[at + 60 :])
        code = run(["fleet", str(model), "--follow", str(bag), "--terminal"])
        said = capsys.readouterr().err
        assert code == 0 or "error[SW1024]: cannot read the recording" in said, said
        codes.add(code)
    assert 1 in codes
    assert codes <= {0, 1}


def test_a_trace_that_ends_ends_the_lines(
    model: Path,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    trace = tmp_path / "run.jsonl"
    trace.write_text(f"{line(0, 'robot[0]', None, 'Off')}\n", encoding="utf-8")
    # A token for pages is no reason to refuse a terminal.
    monkeypatch.setenv("SWARMC_FLEET_TOKEN", "secret")
    with trace.open(encoding="utf-8") as stdin:
        monkeypatch.setattr(sys, "stdin", stdin)
        assert run(["fleet", str(model), "--follow", "-", "--terminal"]) == 0
    assert "robot[0] there Off start" in capsys.readouterr().out.splitlines()


def test_each_line_of_a_trace_that_changes_something_is_a_line(
    model: Path,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    lines = [
        line(0, "robot[0]", None, "Off"),
        line(0, "robot[1]", None, "Off"),
        line(1, "robot[0]", "Visit", "On"),
        line(2, "robot[0]", "Leave", "Off"),
        line(3, "robot[9]", None, "Off"),
    ]
    trace = tmp_path / "run.jsonl"
    trace.write_text("".join(f"{each}\n" for each in lines), encoding="utf-8")
    with trace.open(encoding="utf-8") as stdin:
        monkeypatch.setattr(sys, "stdin", stdin)
        assert run(["fleet", str(model), "--follow", "-", "--terminal"]) == 0
    told = capsys.readouterr().out.splitlines()
    assert [each for each in told if "there" in each] == [
        "robot[0] there Off start",
        "robot[1] there Off start",
        "robot[0] there On Visit",
        "robot[0] there Off Leave",
        "robot[9] there Off start",
    ]
    assert "alarm: robot[9] is not in the model: Crew has robot[0] to robot[1]" in told


@pytest.mark.parametrize("name", ["later.jsonl", "ros3:/crew"])
def test_a_trace_that_is_not_there_is_told(name: str, model: Path, tmp_path: Path) -> None:
    process = subprocess.Popen(
        [sys.executable, "-m", "swarmdsl", "fleet", model, "--follow", name, "--terminal"],
        cwd=tmp_path,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    try:
        assert process.stderr is not None
        said = process.stderr.readline()
        assert said.startswith(f"waiting for `{name}`: there is no such file")
        assert "`ros2:NAME`" in said
    finally:
        process.kill()
        process.communicate()


@pytest.mark.parametrize("more", [[], ["--terminal"]])
def test_a_folder_is_no_trace(
    more: list[str], model: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["fleet", str(model), "--follow", str(tmp_path), *more]) == 1
    assert "error[SW0002]" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("words", "reason"),
    [
        (["--follow", ""], "`--follow` names nothing"),
        (["--host", "0.0.0.0"], "`--host` needs `--token`"),
        (["--token", ""], "a token has letters"),
        (["--token", "one&two"], "a token has letters"),
        (["--terminal", "--host", "localhost"], "`--terminal` serves no page"),
        (["--terminal", "--open"], "`--terminal` serves no page"),
        (["--follow", "a.jsonl", "--follow", "ros2:"], "one trace or recording"),
    ],
)
def test_options_that_do_not_fit_are_refused(
    words: list[str], reason: str, model: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["fleet", str(model), *words]) == 2
    assert reason in capsys.readouterr().err


def test_keys_in_a_terminal(model: Path, tmp_path: Path) -> None:
    trace = tmp_path / "run.jsonl"
    trace.write_text(f"{line(0, 'robot[0]', None, 'Off')}\n", encoding="utf-8")
    ours, theirs = pty.openpty()
    process = subprocess.Popen(
        [sys.executable, "-m", "swarmdsl", "fleet", model, "--follow", trace, "--terminal"],
        stdin=theirs,
        stdout=theirs,
        stderr=theirs,
        env={**os.environ, "TERM": "xterm", "COLUMNS": "120", "LINES": "30"},
    )
    os.close(theirs)
    seen = ""

    def until(words: str) -> None:
        nonlocal seen
        while words not in seen:
            seen += os.read(ours, 4096).decode(errors="replace")

    try:
        until("robot[0]")
        until("1 Abort")
        os.write(ours, b"1")
        until("Abort is not sent: robots of a trace hear nothing")
        os.write(ours, b"q")
        assert process.wait(20) == 0
    finally:
        process.kill()
        process.wait()
        os.close(ours)
