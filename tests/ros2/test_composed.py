"""Robots in one process, which begin, fail and end by themselves."""

from __future__ import annotations

import json
import signal
import subprocess
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from . import launching
from .conftest import write_package

MODEL = """
package guarded

function land : abstraction { service "land" : std_srvs/Empty }

event Go   : std_msgs/Empty on "go"
event Done : std_msgs/Int32 on "done"
event Stop : std_msgs/Empty on "stop"
event Spin : std_msgs/Empty on "spin"

statemachine Fly {
  param height : int32 = 5
  var turns    : int32 = 0
  initial Wait
  state Wait {
    on Go / send Done(data = height) -> Wait
    on Spin -> Round
    on Stop -> End
  }
  choice Round { [turns >= 0] -> Again; else -> End }
  choice Again { [turns >= 0] -> Round; else -> End }
  final End
}

member Uav {
  behavior Fly
  contract Dies : when dead call land
}

swarm Field { uav : Uav[5] }

property Low of Field : each uav : never sends Done [event.data > 6]
"""
"""Robots that answer, that end, and that fail in an endless loop, or for a wrong value."""
EMPTY = "std_msgs/msg/Empty"
PATIENCE = 60.0
Launch = Callable[..., list[dict[str, Any]]]


@pytest.fixture
def package(tmp_path: Path) -> Path:
    """The package, in which two robots have parameters of their own."""
    model = tmp_path / "guarded.swarm"
    model.write_text(MODEL, encoding="utf-8")
    made = write_package(model, tmp_path / "made", composed="true", monitors="true")
    for number, line in ((1, "height: 7"), (2, "height: high")):
        own = made / "config" / "field" / f"uav_{number}.yaml"
        own.write_text(f"/**/fly:\n  ros__parameters:\n    {line}\n", encoding="utf-8")
    return made


@pytest.fixture
def domain(ros: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    """Launch for the domain of the processes: robots of other tests have the same names."""
    monkeypatch.setenv("ROS_DOMAIN_ID", ros.environment["ROS_DOMAIN_ID"])


@pytest.fixture
def launch(package: Path, monkeypatch: pytest.MonkeyPatch) -> Launch:
    """Return what a launch file starts."""
    return lambda file="field", **given: launching.launch(
        package / "launch" / f"{file}.launch.py",
        {package.name: package},
        monkeypatch.setitem,
        **given,
    )


def test_launch_starts_one_process(launch: Launch) -> None:
    """Also of one robot; `composed:=false` starts a process for each node."""
    whole = [each["executable"] for each in launch()]
    assert whole == ["field_monitor", "container", *["watchdog"] * 5]
    apart = [each["executable"] for each in launch(composed="false")]
    assert apart == ["field_monitor", *["fly", "watchdog"] * 5]
    container, watchdog = launch("robot", member="uav_3", respawn="true", respawn_delay="0.5")
    assert (container["executable"], container["namespace"]) == ("container", "/field")
    assert watchdog["namespace"] == "/field/uav_3"
    arguments = container["arguments"]
    assert arguments[:2] == ["--respawn", "0.5"]
    ((module, namespace, words),) = json.loads(Path(arguments[2]).read_text(encoding="utf-8"))
    assert (module, namespace) == ("fly", "uav_3")
    assert words[words.index("-p") + 1] == 'member:="uav[3]"'
    assert container["respawn"] is True


def test_the_command_of_a_process_with_many_robots(
    launch: Launch, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It is as short as that of one; Linux has a limit of 2 MB, with all of the environment."""
    container = next(each for each in launch() if each["executable"] == "container")
    assert sum(len(_text(each)) for each in container["arguments"]) < 200
    nodes = json.loads(Path(container["arguments"][0]).read_text(encoding="utf-8"))
    assert [each[1] for each in nodes] == [f"uav_{number}" for number in range(5)]

    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path / "missing"))
    with pytest.raises(Exception, match="the nodes of a process cannot be written: ") as error:
        launch()
    assert type(error.value).__name__ == "RobotError"


def test_launch_of_no_robots(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """There is nothing to start a process for."""
    model = tmp_path / "guarded.swarm"
    model.write_text(MODEL.replace("Uav[5]", "Uav[0..5]"), encoding="utf-8")
    package = write_package(model, tmp_path / "made", composed="true")
    path = package / "launch" / "field.launch.py"

    def started(**given: str) -> list[str]:
        nodes = launching.launch(path, {package.name: package}, monkeypatch.setitem, **given)
        return [each["executable"] for each in nodes]

    assert started(uav_count="0") == []
    assert started(uav_count="1") == ["container", "watchdog"]


@pytest.mark.usefixtures("domain")
def test_robots_in_one_process(ros: Any, package: Path, launch: Launch, tmp_path: Path) -> None:
    """One has a value of its own, one has ended, two have failed; two go on until a kill."""
    ros.prefer(package)
    fakes = ros.fakes()
    uavs = [f"/field/uav_{number}" for number in range(5)]
    for uav in uavs:
        fakes.service(f"{uav}/land", "std_srvs/srv/Empty")
        for topic in ("go", "stop", "spin"):
            fakes.publisher(f"{uav}/{topic}", "std_msgs/msg/Empty")
        fakes.do("subscribe", topic=f"{uav}/done", kind="std_msgs/msg/Int32")
    log, traces = tmp_path / "log.txt", tmp_path / "traces"

    def answered(number: int, height: int, count: int) -> None:
        fakes.publish(f"{uavs[number]}/go")
        assert fakes.wait("message", f"{uavs[number]}/done", count)["data"] == {"data": height}

    def landed() -> list[int]:
        return [fakes.count("request", f"{uav}/land") for uav in uavs]

    with log.open("w", encoding="utf-8") as written:
        started = {}
        described = launch(trace_dir=str(traces))
        (lease,) = [
            Path(each["parameters"][0]["lease.file"])
            for each in described
            if (each["namespace"], each["executable"]) == (uavs[4], "watchdog")
        ]
        # A watchdog does not look at what has failed before it.
        for each in sorted(described, key=lambda each: each["executable"] == "container"):
            if each["executable"] == "container":
                for uav in uavs:
                    _wait_in(log, f"{uav.rpartition('/')[2]}.fly is watched")
            started[each["namespace"], each["executable"]] = _start(ros, each, written)
        container = started["/field", "container"]
        for number in (0, 1, 3, 4):
            fakes.listeners(f"{uavs[number]}/go", f"{uavs[number]}/stop", f"{uavs[number]}/spin")
        answered(0, 5, 1)
        answered(1, 7, 1)  # as its own file says, after the parameters of the launch
        fakes.wait("request", f"{uavs[2]}/land")  # it did not start
        _wait_in(log, "fly in uav_2 has failed")

        fakes.publish(f"{uavs[3]}/spin")
        fakes.wait("request", f"{uavs[3]}/land")  # it failed
        fakes.publish(f"{uavs[4]}/stop")
        _wait_until(lambda: lease.read_text(encoding="utf-8") != "running", log)  # it has left
        answered(0, 5, 2)
        answered(1, 7, 2)
        assert container.poll() is None
        assert landed() == [0, 0, 1, 1, 0]

        container.kill()
        for number in (0, 1):
            fakes.wait("request", f"{uavs[number]}/land")
        assert landed() == [1, 1, 1, 1, 0]
        monitor = started["/field", "field_monitor"]
        monitor.send_signal(signal.SIGINT)
        assert monitor.wait(PATIENCE) == 0
    lines = (traces / "monitor.jsonl").read_text(encoding="utf-8").splitlines()
    told = [line for line in map(json.loads, lines) if "verdict" in line][-1]
    assert (told["property"], {each["robot"] for each in told["violations"]}) == ("Low", {"uav[1]"})


@pytest.mark.usefixtures("domain")
def test_a_robot_that_starts_again(ros: Any, package: Path, launch: Launch, tmp_path: Path) -> None:
    """It fails, and starts again beside the others; a signal ends them all, and none lands."""
    ros.prefer(package)
    fakes = ros.fakes()
    log = tmp_path / "log.txt"
    traces = tmp_path / "traces"
    given = {"respawn": "true", "respawn_delay": "0.1", "trace_dir": str(traces)}
    (container,) = [
        each for each in launch(members="uav_0 uav_3", **given) if each["executable"] == "container"
    ]
    fakes.publisher("/field/uav_3/spin", "std_msgs/msg/Empty")
    with log.open("w", encoding="utf-8") as written:
        process = _start(ros, container, written)
        fakes.listeners("/field/uav_3/spin")
        fakes.publish("/field/uav_3/spin")
        _wait_in(log, "fly in uav_3 has failed, and starts again")
        _wait_in(traces / "uav[3].1.jsonl", "Spin")
        _wait_in(traces / "uav[3].jsonl", "Wait")
        process.send_signal(signal.SIGTERM)
        assert process.wait(PATIENCE) == 0, log.read_text(encoding="utf-8")
    for number in (0, 3):
        assert "node.shutdown" in (traces / f"uav[{number}].jsonl").read_text(encoding="utf-8")


@pytest.mark.parametrize(
    ("nodes", "said"), [(None, "usage: container "), ('[["fly"]]', "is no file with nodes: ")]
)
def test_arguments_that_are_wrong(
    ros: Any, package: Path, tmp_path: Path, nodes: str | None, said: str
) -> None:
    ros.prefer(package)
    words = []
    if nodes is not None:
        words = [str(tmp_path / "nodes.json")]
        Path(words[0]).write_text(nodes, encoding="utf-8")
    container = ros.start("-m", f"{package.name}.container", *words, stderr=subprocess.PIPE)
    assert said in container.stderr.read()
    assert container.wait(PATIENCE) == 1


def _start(ros: Any, node: dict[str, Any], log: Any) -> subprocess.Popen[str]:
    """Start what a launch file describes, as launch does."""
    words = [_text(each) for each in node.get("arguments", ())]
    words += ["-r", f"__ns:={node['namespace']}"]
    if node.get("name"):
        words += ["-r", f"__node:={node['name']}"]
    for values in node.get("parameters", ()):
        for name, value in values.items():
            words += ["-p", f"{name}:={json.dumps(value)}"]
    module = f"{node['package']}.{node['executable']}"
    made: subprocess.Popen[str] = ros.start("-m", module, *words, stderr=log)
    return made


def _text(word: Any) -> str:
    """Return a word of a command; the only one that launch fills in is the level of the log."""
    return word if isinstance(word, str) else "info"


def _wait_in(file: Path, text: str) -> None:
    """Wait until a file has a text."""
    _wait_until(lambda: file.exists() and text in file.read_text(encoding="utf-8"), file)


def _wait_until(is_so: Callable[[], bool], log: Path) -> None:
    """Wait until something is so; a failure shows the log."""
    end = time.monotonic() + PATIENCE
    while not is_so():
        assert time.monotonic() < end, log.read_text(encoding="utf-8") if log.exists() else log
        time.sleep(0.02)
