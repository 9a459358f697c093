"""Generated nodes on a real ROS 2 fly in the flat world as machines in the simulation do."""

from __future__ import annotations

import json
import math
import os
import subprocess
import sysconfig
from collections.abc import Callable
from pathlib import Path
from threading import Thread
from typing import Any

import pytest
from tests.preview.test_live_run import Browser

from swarmdsl.cli import run

pytest.importorskip("numpy")

from .conftest import load_module

launching = load_module("launching")
ROOT = Path(__file__).resolve().parents[2]
MEADOW = ROOT / "examples" / "meadow"
PATIENCE = 240.0
"""Real time that the flight may take, in seconds."""
MEMBERS = {"scout[0]": "patrol", "scout[1]": "patrol", "post[0]": "listening"}
LATE = 0.5
"""Time of the world by which a node may do something later than in the simulation, in seconds."""
SPEED = 5.0

MODEL = """
package patrol

message cpswarm_msgs/TargetPositionEvent {
  header : std_msgs/Header
  id     : string
  pose   : geometry_msgs/PoseStamped
}
action cpswarm_msgs/Coverage {
  goal   { altitude : float64 in m }
  result { target_id : string, target_pose : geometry_msgs/PoseStamped }
}
action cpswarm_msgs/MoveTo {
  goal { goal : geometry_msgs/PoseStamped }
}

function survey : swarm {
  action "survey" : cpswarm_msgs/Coverage
  model coverage(height = altitude, width = 6 m, area = "meadow", target = "person")
}
function go : swarm {
  action "go" : cpswarm_msgs/MoveTo
  model go_to(height = 6 m)
}
swarm event Found : cpswarm_msgs/TargetPositionEvent on "target_found"

environment Field {
  size 100 m x 80 m x 30 m
  area meadow : (0 m, 0 m) .. (60 m, 40 m)
  target person at (25 m, 10 m)
}
sensor Camera {
  out target : cpswarm_msgs/TargetPositionEvent on "target_found"
  senses person { range = 9 m, rate = 2 Hz }
}
/// It searches until it or another one has seen somebody, and ends where the finder saw him.
statemachine Patrol {
  param altitude : float64 in m = 6 m
  var seen : geometry_msgs/PoseStamped
  initial Search
  state Search {
    do survey(altitude = altitude)
    on succeeded -> Wait
    on aborted   -> Seen
    on Found / seen = event.pose -> Come
  }
  state Wait { after 2 s -> Seen }
  state Come {
    do go(goal = seen)
    on succeeded -> Met
    on aborted   -> Seen
  }
  final Seen
  final Met
}
member Scout {
  behavior Patrol
  camera : Camera
  body    { radius = 0.3 m, speed = 5 m/s, climb = 2 m/s }
  battery { capacity = 60 Wh, moving = 180 W, hovering = 150 W, idling = 4 W }
  radio   { range = 45 m }
}
/// No radio reaches it where it stands.
endless statemachine Listening {
  initial Listen
  state Listen { on Found -> Told }
  state Told { }
}
member Post {
  behavior Listening
  radio { range = 45 m }
}
swarm S {
  scout : Scout[2]
  post  : Post at (95 m, 75 m)
  scout[0] at (45 m, 5 m)
  scout[1] at (5 m, 20 m)
  environment Field
  fitness Ways
}
property Comes of S : each scout : hears Found leads to in Met within 1 min
property NobodyMeets of S : never some scout in Met
fitness Ways {
  in way : float64 in m = distance(scout)
  in used : float64 in J = energy(scout)
  in seen : uint32 = found(person)
  maximize seen * 1000 - way / 1 m
}
"""


def simulated(folder: Path, model: Path, *more: str) -> tuple[dict[str, Any], list[dict[str, Any]]]:
    """Results and trace of the simulation."""
    results, trace = folder / "pure.json", folder / "pure.jsonl"
    words = ["simulate", str(model), "--results", str(results)]
    run([*words, "--trace-file", str(trace), *more])
    return json.loads(results.read_text()), read(trace)


def read(trace: Path) -> list[dict[str, Any]]:
    lines = map(json.loads, trace.read_text(encoding="utf-8").splitlines())
    return [line for line in lines if "configuration" in line and not line.get("ignored")]


def served(ros: Any, model: Path, *more: str) -> subprocess.Popen[str]:
    """A process that serves the robots of the model."""
    site = sysconfig.get_paths()["purelib"]
    paths = [ros.environment["PYTHONPATH"], str(ROOT / "src"), site]
    nodes = ros.environment
    ros.environment = {**nodes, "PYTHONPATH": os.pathsep.join(paths)}
    words = ["-m", "swarmdsl", "simulate", model, "--ros2", *more]
    made: subprocess.Popen[str] = ros.start(*words, stderr=subprocess.PIPE)
    ros.environment = nodes
    return made


def agree(pure: list[dict[str, Any]], flown: list[dict[str, Any]], said: str) -> None:
    """Check that robots did the same, at nearly the same time and place."""
    kept = ("event", "configuration", "started", "cancelled")
    for member in {each["member"] for each in pure}:
        ours = [line for line in pure if line["member"] == member]
        theirs = [line for line in flown if line["member"] == member]
        assert [[each.get(key) for key in kept] for each in theirs] == [
            [each.get(key) for key in kept] for each in ours
        ], said
        for one, other in zip(ours, theirs, strict=True):
            assert abs(one["t"] - other["t"]) <= LATE * 1000, (one, other)
            assert math.dist(one["at"], other["at"]) <= LATE * SPEED


def verdicts(results: dict[str, Any]) -> dict[str, str]:
    return {each["name"]: each["verdict"] for each in results["properties"]}


@pytest.fixture
def patrol(ros: Any, variant: Callable[..., Path], tmp_path: Path) -> Path:
    """The folder with the model; nodes that start are of its package."""
    (tmp_path / "patrol.swarm").write_text(MODEL, encoding="utf-8")
    ros.prefer(variant(tmp_path / "patrol.swarm"))
    return tmp_path


def start(ros: Any, member: str, **more: str) -> subprocess.Popen[str]:
    """Start the node of a robot as the launch file does with `world:=true`."""
    space = f"/s/{member[:-1].replace('[', '_')}"
    settings = {"member": member, "use_sim_time": True, **more}
    settings["swarm"] = f"{space}/radio"
    words = ["-m", f"patrol_behavior.{MEMBERS[member]}", "--ros-args", "-r", f"__ns:={space}"]
    for name, value in settings.items():
        words += ["-p", f"{name}:={json.dumps(value)}"]
    with (ros.scratch / f"{member}.txt").open("w") as log:
        made: subprocess.Popen[str] = ros.start(*words, stdout=log, stderr=log)
    return made


def test_nodes_fly_as_the_simulation(ros: Any, patrol: Path) -> None:
    """One sees the person, one hears of it by radio and comes, one is out of reach."""
    until = ("--until", "16s")
    model = patrol / "patrol.swarm"
    expected, lines = simulated(patrol, model, *until)
    results, trace = patrol / "ros.json", patrol / "ros.jsonl"
    world = served(
        ros,
        model,
        *until,
        *("--real-time-factor", "4", "--results", str(results), "--trace-file", str(trace)),
        "--live",
    )
    assert world.stderr is not None
    browser, address = Browser(), world.stderr.readline().split()[1]
    page = Thread(target=browser.look, args=(address,), daemon=True)
    page.start()
    for member in MEMBERS:
        start(ros, member)
    _, said = world.communicate(timeout=PATIENCE)
    page.join(PATIENCE)

    assert results.exists(), said
    told = [browser.told.get() for _ in range(browser.told.qsize())]
    drawn = [each["redrawn"]["svg"] for each in told if "redrawn" in each]
    assert "after 16 s, 1 of 1 targets found" in drawn[-1]
    active = {who: states for each in told for who, states in each.get("active", {}).items()}
    assert active == {"scout[0]": ["Met"], "scout[1]": ["Met"], "post[0]": ["Listen"]}
    found = json.loads(results.read_text())
    flown = read(trace)
    agree(lines, flown, said)
    ends = {line["member"]: line["configuration"] for line in flown}
    assert ends == {"scout[0]": ["Met"], "scout[1]": ["Met"], "post[0]": ["Listen"]}
    assert verdicts(found) == verdicts(expected) == {"Comes": "true", "NobodyMeets": "false"}
    assert found["fitness"] == pytest.approx(expected["fitness"], abs=3 * LATE * SPEED)
    assert world.returncode == 1  # a property is violated


def launch(ros: Any, package: Path, monkeypatch: pytest.MonkeyPatch, **arguments: str) -> None:
    """Start the nodes of a swarm as its launch file says."""
    robot = package / "launch" / "robot.launch.py"
    (file,) = set(robot.parent.glob("*.launch.py")) - {robot}
    described = launching.launch(file, {package.name: package}, monkeypatch.setitem, **arguments)
    for number, each in enumerate(described):
        words = ["-m", f"{package.name}.{each['executable']}", "--ros-args"]
        words += ["-r", f"__ns:={each['namespace']}", "-r", f"__node:={each['name']}"]
        for given in each["parameters"]:
            if isinstance(given, dict):
                values = ((name, json.dumps(value)) for name, value in given.items())
                words += [word for name, value in values for word in ("-p", f"{name}:={value}")]
            else:
                words += ["--params-file", given]
        with (ros.scratch / f"node_{number}.txt").open("w") as log:
            ros.start(*words, stdout=log, stderr=log)


def test_search_and_rescue_flies_as_the_simulation(
    ros: Any, variant: Callable[..., Path], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """UAVs search, one finds a person and offers the task, and a rover drives there."""
    text = (MEADOW / "mission.toml").read_text(encoding="utf-8")
    scenario = tmp_path / "mission.toml"
    scenario.write_text(text.replace("uav   = 3", "uav   = 2").replace("rover = 2", "rover = 1"))
    given = ("--scenario", str(scenario), "--seed", "8", "--until", "23s")
    expected, lines = simulated(tmp_path, MEADOW, *given)
    results, trace, map_ = (tmp_path / f"ros.{end}" for end in ("json", "jsonl", "svg"))
    world = served(
        ros,
        MEADOW,
        *given,
        *("--real-time-factor", "4", "--results", str(results), "--trace-file", str(trace)),
        *("--animation", str(map_)),
    )
    package = variant("examples/meadow")
    ros.prefer(package)
    counts = {"uav_count": "2", "rover_count": "1"}
    launch(ros, package, monkeypatch, world="true", components="false", **counts)
    _, said = world.communicate(timeout=PATIENCE)

    assert results.exists(), said
    found = json.loads(results.read_text())
    agree(lines, read(trace), said)
    begun = {line["member"]: set() for line in lines}
    for line in lines:
        begun[line["member"]] |= set(line["started"])
    assert begun["rover[0]"] >= {"bid_action", "ugv_move_to"}
    assert {"auction_action", "uav_tracking"} <= begun["uav[0]"] | begun["uav[1]"]
    assert verdicts(found) == verdicts(expected)
    assert set(verdicts(found).values()) <= {"true", "open"}
    assert found["fitness"] == pytest.approx(expected["fitness"], abs=LATE / 60)
    assert "sees person[" in map_.read_text(encoding="utf-8")
    assert world.returncode == 0, said
