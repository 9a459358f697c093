"""Fitness scripts compute the model's value from a bag and print it."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.typesys import Stores, get_typestore

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.codegen.api import NoOptions
from swarmdsl.codegen.exchange import fitness
from swarmdsl.ir import System

Compile = Callable[[str], System]
Run = Callable[..., "subprocess.CompletedProcess[str]"]

# What the module of ROS 1 does with a bag that is a list of messages as Python text.
ROSBAG = """
from pathlib import Path


class Time(float):
    def to_sec(self):
        return float(self)


class Message:
    def __init__(self, data):
        self.data = data


class Bag:
    def __init__(self, path):
        self._messages = eval(Path(path).read_text())

    def __enter__(self):
        return self

    def __exit__(self, *_):
        pass

    def read_messages(self, topics):
        for topic, data in self._messages:
            if topic in topics:
                yield topic, Message(data), None
"""


@pytest.fixture
def run(compiled: Compile, tmp_path: Path) -> Run:
    """Compile a fitness and compute it from messages, pairs of topic and data."""

    def run(model: str, *messages: str, path: str = "run.bag") -> subprocess.CompletedProcess[str]:
        report = Diagnostics()
        (file,) = fitness.emit(compiled(model), NoOptions(), report)
        assert not len(report)
        assert (file.path, file.executable) == ("good_run/fitness.py", True)
        (tmp_path / file.path).parent.mkdir(exist_ok=True)
        (tmp_path / file.path).write_text(file.text, encoding="utf-8")
        (tmp_path / "rosbag.py").write_text(ROSBAG, encoding="utf-8")
        (tmp_path / "run.bag").write_text(f"[{', '.join(messages)}]", encoding="utf-8")
        return subprocess.run(
            [sys.executable, "-W", "error", file.path, path, "120", "4"],
            cwd=tmp_path,
            env={**os.environ, "PYTHONPATH": str(tmp_path)},
            capture_output=True,
            text=True,
            timeout=60,
        )

    return run


RESCUE = """
/// People "found" in time.
fitness GoodRun {
  in found   : int32
  in elapsed : duration
  param limit : duration = 5 min
  param price : float64 = 0.5 * 2
  maximize found * price * (limit - elapsed) / limit
}
"""


def test_the_last_message_counts(run: Run) -> None:
    ran = run(RESCUE, "('/found', 1)", "('/other', 7)", "('elapsed', Time(75))", "('/found', 8)")

    assert (ran.returncode, ran.stdout, ran.stderr) == (0, "fitness=6.0\n", "")


def test_what_is_to_be_small_has_its_sign_changed(run: Run) -> None:
    model = """
    fitness GoodRun { in max : float64; in hops : int32[]; minimize min(max, 2) - len(hops) }
    """
    ran = run(model, "('/max', 4.5)", "('/hops', [1, 2, 3])")

    assert ran.stdout == "fitness=1.0\n"


def test_operators_mean_what_they_do_in_the_language(run: Run) -> None:
    model = """
    fitness GoodRun {
      in a : int32
      in b : int32
      maximize (a - b) - (a - b) % 4 * 10 + a / b + sqrt(abs(-b)) - -2
    }
    """
    ran = run(model, "('/a', 1)", "('/b', 4)")

    assert ran.stdout == "fitness=-8.75\n"


@pytest.mark.parametrize(
    ("messages", "says"),
    [
        (["('/found', 1)"], "no value in run.bag of: elapsed"),
        (["('/found', 10 ** 400)", "('/elapsed', Time(1))"], "the fitness has no value: "),
        (["('/found', float('nan'))", "('/elapsed', Time(1))"], "no value: it is not finite"),
    ],
)
def test_without_a_value_nothing_is_printed(run: Run, messages: list[str], says: str) -> None:
    ran = run(RESCUE, *messages)

    assert (ran.returncode, ran.stdout) == (1, "")
    assert says in ran.stderr
    assert "Traceback" not in ran.stderr


MEASURED = """
swarm event Sighted : std_msgs/Empty
endless statemachine Work { initial Fly; state Fly { on Sighted / send Sighted -> Fly } }
member Uav { behavior Work }
swarm Fleet { uav : Uav[2]; fitness GoodRun }
fitness GoodRun {
  in found  : uint8    = total(uav sends Sighted)
  in begun  : duration = time until Sighted
  in unused : float64  = mean each uav : total(sends Sighted)
  in way    : duration
  maximize found - begun / 1 min - way / 1 min
}
"""


def told(*values: Any, **more: Any) -> str:
    """Write a line of a monitor with values of the first measures, or with their entries."""
    named = zip(("found", "begun", "unused", "way"), values, strict=False)
    measures = [
        {"name": name, **(value if isinstance(value, dict) else {"value": value})}
        for name, value in named
    ]
    line = {"fitness": "GoodRun", "measures": measures, "conditions": [], "final": True, **more}
    return json.dumps(line)


def bag_of_ros2(
    path: Path,
    *messages: tuple[str, str, dict[str, Any]],
    plugin: StoragePlugin = StoragePlugin.MCAP,
) -> None:
    """Write a bag with messages: their topic, their type, and their fields."""
    types = get_typestore(Stores.ROS2_JAZZY)
    with Writer(path, version=9, storage_plugin=plugin) as writer:
        topics: dict[str, Any] = {}
        for number, (topic, kind, fields) in enumerate(messages):
            if topic not in topics:
                topics[topic] = writer.add_connection(topic, kind, typestore=types)
            data = types.serialize_cdr(types.types[kind](**fields), kind)
            writer.write(topics[topic], number, data)


def line_in_bag(topic: str, text: str) -> tuple[str, str, dict[str, Any]]:
    return topic, "std_msgs/msg/String", {"data": text}


def way(seconds: int) -> tuple[str, str, dict[str, Any]]:
    return "/way", "builtin_interfaces/msg/Duration", {"sec": seconds, "nanosec": 500_000_000}


@pytest.mark.parametrize("plugin", StoragePlugin)
def test_what_a_monitor_tells_is_read_in_a_bag_of_ros2(
    run: Run, tmp_path: Path, plugin: StoragePlugin
) -> None:
    bag_of_ros2(
        tmp_path / "bag",
        way(1),
        line_in_bag("/fleet/monitor/measures", told(1, 2.0, None)),
        line_in_bag("/fleet/monitor/measures", told(8, 30.0, 0.5, conditions=["uav[1] not heard"])),
        line_in_bag("/other/monitor/measures", told(7, 7.0).replace("GoodRun", "Other")),
        line_in_bag("/others/measures", "length: 3 m"),
        line_in_bag("/found", "not read: the monitor tells it"),
        ("/pose", "geometry_msgs/msg/Point", {"x": 1.0, "y": 1.0, "z": 1.0}),
        way(89),
        plugin=plugin,
    )
    ran = run(MEASURED, path="bag")
    assert (ran.returncode, ran.stdout) == (0, f"fitness={8 - 0.5 - 89.5 / 60}\n")
    assert ran.stderr == "note: uav[1] not heard\n"


@pytest.mark.parametrize(
    ("lines", "says"),
    [
        ([told(8)], "no value in run.jsonl of: begun, unused, way"),
        ([told({"value": 300, "fault": "300 is out of range of uint8"})], "found: 300 is out of"),
        (["{", "[]"], "no value in run.jsonl of: found, begun, unused, way"),
        ([], "no value in run.jsonl of: found, begun, unused, way"),
    ],
)
def test_what_a_trace_does_not_tell(run: Run, tmp_path: Path, lines: list[str], says: str) -> None:
    text = "".join(f"{line}\n" for line in lines)
    (tmp_path / "run.jsonl").write_text(text, encoding="utf-8")
    ran = run(MEASURED, path="run.jsonl")
    assert (ran.returncode, ran.stdout) == (1, "")
    assert says in ran.stderr
    assert "Traceback" not in ran.stderr


def test_the_last_line_of_a_trace_counts(run: Run, tmp_path: Path) -> None:
    model = MEASURED.replace("  in way    : duration\n", "").replace(" - way / 1 min", "")
    late = {"value": 60.0, "unit": "s", "reached": False}
    lines = [told(9, 1.0, 1.0), '{"property": "P", "verdict": "true"}', told(8, late, None), '{"f']
    (tmp_path / "run.jsonl").write_text("\n".join(lines), encoding="utf-8")
    ran = run(model, path="run.jsonl")
    assert (ran.returncode, ran.stdout) == (0, "fitness=7.0\n")
    assert ran.stderr == "note: begun is not reached, and its value a lower bound\n"


def test_several_monitors_and_what_is_no_bag(run: Run, tmp_path: Path) -> None:
    first, second = (f"/{each}/monitor/measures" for each in "ab")
    bag_of_ros2(
        tmp_path / "bag", *(line_in_bag(each, told(1, 1.0, 1.0)) for each in (second, first))
    )
    ran = run(MEASURED, path="bag")
    assert (ran.returncode, ran.stdout) == (1, "")
    assert f"several monitors tell the inputs: {first}, {second}" in ran.stderr
    (tmp_path / "empty").mkdir()
    for path in ("empty", "none.jsonl"):
        ran = run(MEASURED, path=path)
        assert ran.returncode == 1
        assert f"{path} cannot be read: " in ran.stderr
        assert "Traceback" not in ran.stderr


def test_what_cannot_be_measured(compiled: Compile) -> None:
    system = compiled(
        """
        fitness GoodRun {
          in where : geometry_msgs/Pose
          in names : string[]
          in found : int32
          param weight : float64
          maximize found * weight
        }
        """
    )
    report = Diagnostics()

    assert list(fitness.emit(system, NoOptions(), report)) == []
    assert [found.name for found in report] == ["no-place"] * 3
    assert [found.primary.span.text for found in report if found.primary] == [
        "where",
        "names",
        "weight",
    ]
