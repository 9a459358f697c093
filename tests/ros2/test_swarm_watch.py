"""The monitor node judges and measures like a simulation, whose lines it is given."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator
from pathlib import Path
from types import SimpleNamespace
from typing import Any, NamedTuple

import pytest
from swarmdsl.codegen.bundled.ros2.runtime.robot_lines import Machine, RobotLines
from swarmdsl.codegen.bundled.ros2.runtime.swarm_watch import Watches

from swarmdsl.cli import run
from swarmdsl.execution import monitor
from swarmdsl.execution.monitor import Fact, Property, Robots, Sentence

MODEL = """
package test
function go : abstraction { service "go" : std_srvs/Trigger }
event Start : std_msgs/Empty
event Stop : std_msgs/Empty
swarm event Found : std_msgs/Empty
endless statemachine Work {
  initial Idle
  state Idle { on Start -> Busy }
  state Busy {
    initial Going
    on Stop -> Idle
    state Going { do go; on succeeded / send Found -> Resting; on aborted -> Resting }
    state Resting { after 4 s -> Going; on Found -> Resting }
  }
}
member Robot { behavior Work }
swarm Crew { robot : Robot[3]; fitness Pace }
property Short of Crew : each robot : in Going leads to in Resting within 500 ms
property NotBusy of Work : never in Busy
property Rests of Work : in Going leads to in Resting within 900 ms
fitness Pace {
  in a : uint32   = count(robot in Busy)
  in b : uint32   = count(all robot in Busy)
  in c : uint32   = max count(robot in Going)
  in d : uint32   = min count(robot in Idle)
  in e : float64  = mean count(robot in Busy)
  in f : uint32   = total(robot sends Found)
  in g : uint32   = total(robot starts go)
  in h : uint32   = total(Start)
  in i : duration = time(some robot in Going and not robot[1] in Going)
  in j : duration = time until some robot in Busy
  in k : duration = time until all robot in Busy
  in l : duration = max each robot : time(in Going)
  in m : duration = mean each robot : time until in Busy
  in n : float64  = mean each robot : total(hears Found)
  in o : duration = time(robot[1] in Busy)
  maximize a
}
"""
EVENTS = [
    {"event": "Start", "member": "robot[0]", "after": 1000},
    {"event": "Start", "member": "robot[1]", "after": 500},
    {"event": "Stop", "member": "robot[0]", "after": 9250},
]
END = 40_000_000_000


class Input(NamedTuple):
    """Stand-in for that of a module that needs ROS."""

    measure: Any
    origin: str
    bound: str = ""
    unit: str = ""


def generated(path: Path) -> SimpleNamespace:
    """Return the swarm in the module of a monitor, without what runs its node."""
    text = path.read_text(encoding="utf-8").partition("\ndef main")[0]
    tables = "\n".join(line for line in text.splitlines() if not line.startswith("from "))
    classes = {name: getattr(monitor, name) for name in monitor.__all__}

    def swarm(name: str, machines: Any, properties: Any, fitness: str, measures: Any) -> Any:
        assert (name, fitness) == ("Crew", "Pace")
        return SimpleNamespace(machines=machines, properties=properties, measures=measures)

    names = {**classes, "Machine": Machine, "Input": Input, "Swarm": swarm}
    exec(compile(tables, path, "exec"), names)
    return names["SWARM"]  # type: ignore[return-value]


def lines_of(machines: Any, records: Iterable[dict[str, Any]]) -> Iterator[Any]:
    """Yield lines as the node sees them, those of one robot after the other."""
    lines = RobotLines(machines, (), wait=0, start=0)
    numbers: dict[str, int] = {}
    for record in sorted(records, key=lambda each: str(each["member"])):
        number = numbers[record["member"]] = numbers.get(record["member"], -1) + 1
        lines.hear(json.dumps({"began": 0, "number": number, **record}), record["t"])
    yield from lines.rest()
    assert list(lines.conditions()) == []


def test_a_node_has_the_verdicts_and_values_of_a_simulation(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("model.swarm").write_text(MODEL, encoding="utf-8")
    text = "".join(f"{json.dumps(each)}\n" for each in EVENTS)
    Path("events.jsonl").write_text(text, encoding="utf-8")
    words = ["simulate", "model.swarm", "--until", "40s", "--events", "events.jsonl"]
    assert run([*words, "--trace-file", "t.jsonl", "--results", "r.json"]) == 1
    monitors = ["--target", "ros2", "--option", "ros2.monitors=true"]
    assert run(["build", "model.swarm", *monitors, "-o", "out"]) == 0
    (path,) = Path("out").rglob("crew_monitor.py")
    swarm = generated(path)
    records = [json.loads(line) for line in Path("t.jsonl").read_text("utf-8").splitlines()]
    expected = json.loads(Path("r.json").read_text("utf-8"))

    watches = Watches(swarm, lambda *_: None)
    assert watches.readings(0) is None
    for line in lines_of(swarm.machines, records):
        watches.see(line)
    watches.advance(END)
    found = {
        each.measure.name: {
            "value": reading.value / 1e9 if each.unit else reading.value,
            "reached": reading.reached,
        }
        for each, reading in zip(swarm.measures, watches.last_readings(END), strict=True)
    }
    assert found == {
        each["name"]: {"value": each["value"], "reached": each.get("reached", True)}
        for each in expected["measures"]
    }
    assert len(found) == 15
    by_name = {each["name"]: each for each in expected["properties"]}
    results = {each.property.name: each for each in watches.results(END)}
    assert results["Short"].verdict == by_name["Short"]["verdict"] == "false"
    violations = [(each.property.name, each.robot) for each in watches.new_violations()]
    assert violations.count(("NotBusy", "robot[0]")) == 1
    assert {each for each in violations if each[0] != "Short"} == {
        *(("NotBusy", f"robot[{number}]") for number in range(2)),
        *(("Rests", f"robot[{number}]") for number in range(2)),
    }
    assert list(watches.new_violations()) == []


def record(began: int, at: int, number: int, member: str, state: str) -> dict[str, Any]:
    """Write a line of a node, at a time since the first start in seconds."""
    lists = ("entered", "exited", "taken", "started", "cancelled", "sent")
    return {
        "t": (at - began) * 1000,
        "began": began * 1000,
        "number": number,
        "member": member,
        "event": "Go" if number else None,
        "configuration": [state],
        **{key: [] for key in lists},
    }


def test_each_machine_is_alone_and_begins_with_its_node() -> None:
    soon = Property(
        "Soon", Sentence("eventually", within=3_000_000_000), (Fact("in", "Busy"),), origin="soon"
    )
    up = Property("Up", Sentence("never"), (Fact("in", "Down"),), origin="up")
    machines = {
        "robot": Machine("work", ("Idle", "Busy"), 3, (soon,)),
        "robot.arm": Machine("arm", ("Up", "Down"), 3, (up,)),
    }
    swarm = SimpleNamespace(machines=machines, properties=(), measures=())
    told: list[tuple[str, str, int]] = []
    watches = Watches(swarm, lambda p, verdict, time: told.append((p.name, verdict, time)))
    lines = RobotLines(machines, (), wait=0, start=0)
    for each in (
        record(0, 0, 0, "robot[0]", "Idle"),
        record(0, 0, 0, "robot[0].arm", "Up"),
        record(7, 7, 0, "robot[1]", "Idle"),
        record(7, 9, 1, "robot[1]", "Busy"),
        record(0, 12, 1, "robot[0].arm", "Down"),
    ):
        lines.hear(json.dumps(each), 0)
    for line in lines.rest():
        watches.see(line)
    watches.advance(20_000_000_000)
    # The second robot comes late, and is in time.
    found = [(each.property.name, each.robot, each.time) for each in watches.new_violations()]
    assert sorted(found) == [
        ("Soon", "robot[0]", 3_000_000_000),
        ("Up", "robot[0].arm", 12_000_000_000),
    ]
    results = {each.property.name: each for each in watches.results(20_000_000_000)}
    assert (results["Soon"].verdict, results["Soon"].robots) == ("false", ("robot[0]",))
    assert (results["Up"].verdict, results["Up"].robots) == ("false", ("robot[0].arm",))
    assert [each for each in told if each[1] == "false"] == [
        ("Up", "false", 12_000_000_000),
        ("Soon", "false", 3_000_000_000),
    ]


def test_a_function_ends_with_an_event_of_its_state() -> None:
    fact = Fact("ends", "dig", Robots("robot", "some"), outcome="aborted")
    never = Property("Digs", Sentence("never"), (fact,), origin="digs")
    machines = {"robot": Machine("work", ("Idle", "Busy"), functions=(("Busy", "dig"),))}
    swarm = SimpleNamespace(machines=machines, properties=(never,), measures=())
    watches = Watches(swarm, lambda *_: None)
    lines = RobotLines(machines, (), wait=0, start=0)
    events = ["do.Busy.succeeded", "do.Idle.aborted", "do.Busy.aborted"]
    for number, event in enumerate([None, *events]):
        heard = record(0, number, number, "robot[0]", "Busy") | {"event": event}
        lines.hear(json.dumps(heard), 0)
    for line in lines.rest():
        watches.see(line)
    watches.advance(9_000_000_000)
    (found,) = watches.new_violations()
    assert (found.property, found.time) == (never, 3_000_000_000)


def test_without_a_robot_verdicts_on_machines_say_so() -> None:
    up = Property("Up", Sentence("never"), (Fact("in", "Down"),), origin="up")
    machines = {"robot": Machine("arm", ("Up", "Down"), 3, (up,))}
    swarm = SimpleNamespace(machines=machines, properties=(), measures=())
    (result,) = Watches(swarm, lambda *_: None).results(0)
    assert (result.verdict, result.remark) == ("true", "there was no robot")
