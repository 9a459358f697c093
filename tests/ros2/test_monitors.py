"""The monitor of a swarm on a real ROS 2: violations, silence, and robots that come and go."""

from __future__ import annotations

import json
import signal
import subprocess
import sys
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from typing import Any

import pytest
from rosbags.rosbag2 import Writer
from rosbags.typesys import Stores, get_typestore

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Source
from swarmdsl.codegen.api import NoOptions
from swarmdsl.codegen.exchange import fitness as fitness_script
from swarmdsl.driver import pipeline
from swarmdsl.execution.monitor import LOST
from swarmdsl.execution.simulate.evaluation.measures import FitnessResult, fitness_of
from swarmdsl.execution.simulate.evaluation.properties import watchable
from swarmdsl.execution.simulate.evaluation.results import fitness_values
from swarmdsl.execution.simulate.evaluation.verdicts import Recording
from swarmdsl.execution.simulate.machines.actors import actors
from swarmdsl.execution.simulate.machines.subject import Subject
from swarmdsl.execution.simulate.replay.replay import replay
from swarmdsl.execution.simulate.scenario.scenario import Scenario

HERE = Path(__file__).parent
DIAGNOSTICS = "/diagnostics"
MEASURES = "/depot/depot_monitor/measures"
OK, WARN, ERROR = [0], [1], [2]


class Depot:
    """Two carriers, their monitor, and a tool that reads diagnostics."""

    def __init__(self, ros: Any, variant: Callable[..., Path], **options: str) -> None:
        self.ros = ros
        ros.prefer(variant("tests/ros2/models", monitors="true", **options))
        self.fakes = ros.fakes()
        self.fakes.do("subscribe", topic=DIAGNOSTICS, kind="diagnostic_msgs/msg/DiagnosticArray")
        self.fakes.do("subscribe", topic=MEASURES, kind="std_msgs/msg/String")
        self.carriers: list[Any] = []
        for number in range(2):
            self.fakes.publisher(f"/depot/carrier_{number}/take", "std_msgs/msg/Int32")
            self.fakes.publisher(f"/depot/carrier_{number}/leave", "std_msgs/msg/Empty")

    def monitor(self, **parameters: Any) -> Any:
        """Start the monitor."""
        given = {"members": "carrier[0] carrier[1]", **parameters}
        return self.ros.node("lab_behavior.depot_monitor", "/depot", **given)

    def carrier(self, number: int, module: str = "carrying") -> Any:
        """Start a carrier."""
        member = f"carrier[{number}]"
        space = f"/depot/carrier_{number}"
        node = self.ros.node(f"lab_behavior.{module}", space, member=member)
        node.wait_in("Empty")
        self.fakes.listeners(f"{space}/take", f"{space}/leave")
        self.carriers.append(node)
        return node

    def take(self, number: int, load: int) -> None:
        self.fakes.publish(f"/depot/carrier_{number}/take", data=load)

    def leave(self, number: int) -> None:
        self.fakes.publish(f"/depot/carrier_{number}/leave")

    def status(self, property_: str, level: list[int], text: str) -> dict[str, Any]:
        """Wait until a property is told on that level."""

        def of_property(message: dict[str, Any]) -> Iterator[dict[str, Any]]:
            for status in message["data"]["status"]:
                wanted = status["level"] == level and text in str(status)
                if status["name"] == f"depot/depot_monitor: {property_}" and wanted:
                    yield status

        found = self.fakes.wait_for("message", DIAGNOSTICS, lambda m: any(of_property(m)))
        return next(of_property(found))


Told = dict[str, tuple[str, list[tuple[str | None, int]]]]
"""Verdict on each property, and who violated it at what time in milliseconds."""


def told(lines: Iterable[dict[str, Any]]) -> Told:
    """Return what a monitor has told at last."""
    return {
        line["property"]: (
            line["verdict"],
            [(each["robot"], each["t"]) for each in line["violations"]],
        )
        for line in lines
        if "property" in line
    }


def replayed(*traces: Iterable[dict[str, Any]]) -> Told:
    """Replay traces of the depot on the model, as `swarmc simulate --replay` does."""
    return replay_of_swarm(*traces)[0]


def replay_of_swarm(*traces: Iterable[dict[str, Any]]) -> tuple[Told, FitnessResult]:
    """Return the verdicts and the fitness of a replay."""
    system = pipeline.check([HERE / "models"]).system
    assert system is not None
    (swarm,) = (each for each in system.swarms if each.name == "Depot")
    told, fitness = replay_of(Subject("Depot", system, swarm=swarm), *traces)
    assert fitness is not None
    return told, fitness


def replay_of_machine(trace: Iterable[dict[str, Any]]) -> Told:
    """Replay the trace of one robot on its machine alone."""
    system = pipeline.check([HERE / "models"]).system
    assert system is not None
    machine = system.machines_by_name["Carrying"]
    return replay_of(Subject("Carrying", system, machine=machine), trace)[0]


def replay_of(
    subject: Subject, *traces: Iterable[dict[str, Any]]
) -> tuple[Told, FitnessResult | None]:
    report = Diagnostics()
    cast = actors(subject, subject.create_robots({}), Scenario(), report)
    text = "".join(f"{json.dumps(line)}\n" for trace in traces for line in trace)
    recording = Recording(watchable(subject), fitness_of(subject))
    found = replay(Source("trace.jsonl", text), subject, cast, report, recording.see)
    assert not list(report)
    verdicts, fitness = recording.results(found.end)
    told = {
        result.property.name: (
            result.verdict,
            [(each.robot, each.time // 1_000_000) for each in result.violations],
        )
        for result in verdicts
    }
    return told, fitness


def of_machines(found: Told) -> Told:
    """Take the verdicts on properties of machines out of all, and return them."""
    return {name: found.pop(name) for name in ("TakesOnce", "GetsAway")}


def compute(folder: Path, run: Path) -> subprocess.CompletedProcess[str]:
    """Compute the fitness of a run with the script that is generated of the model."""
    system = pipeline.check([HERE / "models"]).system
    assert system is not None
    (file,) = fitness_script.emit(system, NoOptions(), Diagnostics())
    script = folder / "fitness.py"
    script.write_text(file.text, encoding="utf-8")
    return subprocess.run(
        [sys.executable, "-W", "error", script, run], capture_output=True, text=True, timeout=60
    )


def bag(path: Path, messages: Iterable[dict[str, Any]]) -> Path:
    """Write messages of the topic of measures to a bag of ROS 2."""
    types = get_typestore(Stores.ROS2_JAZZY)
    kind = "std_msgs/msg/String"
    with Writer(path, version=9) as writer:
        topic = writer.add_connection(MEASURES, kind, typestore=types)
        for number, message in enumerate(messages):
            text = types.types[kind](data=message["data"]["data"])
            writer.write(topic, number, types.serialize_cdr(text, kind))
    return path


def test_verdicts_and_measures_are_those_of_a_replay(
    ros: Any, variant: Callable[..., Path], tmp_path: Path
) -> None:
    depot = Depot(ros, variant)
    monitor = depot.monitor()
    first, second = depot.carrier(0), depot.carrier(1)
    depot.take(0, 3)
    depot.take(0, 1)
    first.wait_for("Take", 2)
    depot.take(1, 1)
    second.wait_in("Loaded")
    depot.leave(0)
    first.wait_in("Empty")
    status = depot.status("OneLoaded", ERROR, "false at ")
    assert {"key": "verdict", "value": "false"} in status["values"]
    assert status["hardware_id"] == "/depot"
    depot.status("Light", ERROR, "false by carrier[0] at ")
    depot.status("Small", ERROR, "false by carrier[0] at ")

    # The second one is silent, so time alone breaks a promise.
    depot.status("Brought", ERROR, "by carrier[1] at ")
    depot.leave(1)
    depot.status("SomeLoad", WARN, "false in this run at ")
    depot.leave(1)
    second.wait_in("Away")
    assert second.exit_code() == 0
    assert first.terminate() == 0
    depot.status("AllAway", OK, "open")
    assert monitor.terminate() == 0
    found = told(monitor.trace)
    alone = of_machines(found)
    assert {name: verdict for name, (verdict, _) in found.items()} == {
        "Light": "false",
        "Small": "false",
        "Little": "false",
        "OneLoaded": "false",
        "Brought": "false",
        "OnlyTaken": "true",
        "AllAway": "open",
        "SomeLoad": "false",
    }
    assert found == replayed(first.trace, second.trace)
    again, fitness = replay_of_swarm(monitor.trace)
    assert found == again

    # Each robot alone: the first one takes twice and does not leave, the second one is away.
    of_first, of_second = map(replay_of_machine, (first.trace, second.trace))
    ((verdict, [(name, time)]), gets_away) = alone["TakesOnce"], alone["GetsAway"]
    assert (verdict, name) == ("false", "carrier[0]")
    ((_, own),) = of_first["TakesOnce"][1]
    began = [node.trace[0]["began"] for node in (first, second)]
    assert time == own + began[0] - min(began)
    assert gets_away == of_first["GetsAway"] == ("open", [])
    assert of_second == {"TakesOnce": ("true", []), "GetsAway": ("true", [])}

    # The values are those of the replay, and so is the fitness.
    (last,) = (line for line in monitor.trace if "measures" in line)
    values = fitness_values(fitness)
    assert last["measures"] == values["measures"]
    assert [each["value"] for each in last["measures"] if each["name"] in ("taken", "heavy")] == [
        3,
        1,
    ]
    assert last["conditions"] == []
    message = depot.fakes.wait_for("message", MEASURES, lambda m: '"final": true' in str(m))
    assert json.loads(message["data"]["data"]) == last
    assert "Moved: taken 3, loaded " in monitor.log
    messages = depot.fakes.found("message", MEASURES)
    for run in (monitor.trace_file, bag(tmp_path / "bag", messages)):
        ran = compute(tmp_path, run)
        assert ran.stderr == "note: over is not reached, and its value a lower bound\n"
        assert ran.stdout.startswith("fitness=")
        assert float(ran.stdout.partition("=")[2]) == pytest.approx(fitness.value, rel=1e-12)
    ran = compute(tmp_path, bag(tmp_path / "shorter", messages[:-1]))
    assert "note: the monitor had not ended" in ran.stderr
    assert "property Light is violated by carrier[0] at " in monitor.log
    assert "each carrier : never has [load > 3] (depot.swarm:31)" in monitor.log
    assert "OnlyTaken: true" in monitor.log
    assert not any(line["conditions"] for line in monitor.trace if "property" in line)


def test_a_monitor_that_comes_late_and_a_robot_that_is_killed(
    ros: Any, variant: Callable[..., Path]
) -> None:
    depot = Depot(ros, variant)
    first, second = depot.carrier(0), depot.carrier(1)
    depot.take(0, 4)
    first.wait_in("Loaded")
    depot.leave(0)
    first.wait_in("Empty")

    # It hears what the nodes have kept for it.
    monitor = depot.monitor(wait__start=30.0)
    depot.status("Light", ERROR, "false by carrier[0] at ")
    second.process.send_signal(signal.SIGKILL)
    monitor.until(lambda t: any(each.get("event") == LOST for each in t), "a robot is lost")

    # Lost robots do not count.
    depot.leave(0)
    first.wait_in("Away")
    depot.status("AllAway", OK, "true")
    again = depot.carrier(1)
    depot.take(1, 1)
    again.wait_in("Loaded")
    depot.leave(1)
    again.wait_in("Empty")
    monitor.until(
        lambda t: any(each.get("taken") == ["Loaded->1"] and own(each, again) for each in t),
        "the robot that has started again is heard",
    )

    assert monitor.terminate() == 0
    found = told(monitor.trace)
    assert found["AllAway"] == ("true", [])
    assert found["OneLoaded"] == ("true", [])
    of_machines(found)
    again_told, fitness = replay_of_swarm(monitor.trace)
    assert found == again_told
    (measured,) = (line["measures"] for line in monitor.trace if "measures" in line)
    assert measured == fitness_values(fitness)["measures"]
    assert [each["event"] for each in monitor.trace if own(each, again)][:3] == [None, LOST, None]
    assert not any(line["conditions"] for line in monitor.trace if "property" in line)


def own(line: dict[str, Any], node: Any) -> bool:
    """Return True for a line of the robot of a node."""
    return bool(line.get("member") == node.parameters["member"])


def test_who_is_not_heard_is_told(ros: Any, variant: Callable[..., Path], tmp_path: Path) -> None:
    depot = Depot(ros, variant)
    monitor = depot.monitor(wait__start=0.1, wait=0.1)
    depot.carrier(0)
    depot.status("OneLoaded", WARN, "true, but carrier[1] not heard")
    assert monitor.terminate() == 0
    assert "OneLoaded: true, but carrier[1] not heard" in monitor.log
    last = [each for each in monitor.trace if each.get("property") == "SomeLoad"][-1]
    assert last["conditions"] == ["carrier[1] not heard"]
    # Nothing was loaded.
    assert "SomeLoad: true, but its scope never began, carrier[1] not heard" in monitor.log
    assert last["remark"] == "its scope never began"
    (measures,) = (line for line in monitor.trace if "measures" in line)
    assert measures["conditions"] == ["carrier[1] not heard"]
    ran = compute(tmp_path, monitor.trace_file)
    assert "note: carrier[1] not heard" in ran.stderr


def test_robots_that_the_swarm_does_not_have_are_told(
    ros: Any, variant: Callable[..., Path]
) -> None:
    depot = Depot(ros, variant)
    monitor = depot.monitor(members="carrier[0]", wait=0.1)
    depot.carrier(0)
    depot.fakes.publisher("/depot/carrier_2/take", "std_msgs/msg/Int32")
    depot.fakes.publisher("/depot/carrier_2/leave", "std_msgs/msg/Empty")
    depot.carrier(2)
    left_out = "1 line left out, because carrier[2] is none of the 2 robots of role carrier"
    depot.status("OneLoaded", WARN, left_out)
    assert monitor.terminate() == 0
    wrong = depot.monitor(members="carrier[0] carrier[2]")
    assert wrong.exit_code() == 1
    assert "`members`: carrier[2] is none of the 2 robots of role carrier" in wrong.log
