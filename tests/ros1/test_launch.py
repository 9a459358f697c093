"""Launch files and the rostest of generated packages, by the tools of ROS."""

from __future__ import annotations

import signal
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
import yaml

pytestmark = pytest.mark.long


World = Callable[..., Any]

MODEL = """
package lab
swarm event Stop : swarmros/SimpleEvent
message swarmros/SimpleEvent { eventHeader : swarmros/EventHeader }
message swarmros/EventHeader { name : string, node : string }
statemachine Look {
  param wait : duration
  param name : string = "-"
  initial A
  state A { on Stop -> B; after wait -> B }
  final B
}
sensor Eye { behavior Look; param wait : duration = 1 h }
member Uav {
  behavior Look
  param wait : duration = 2 h
  param name : string = "a b"
  left : Eye { wait = 3 h }
}
swarm Search { uav : Uav[2..3] }
"""


def _run(world: Any, *command: str) -> subprocess.CompletedProcess[str]:
    """Run a tool of ROS for the package."""
    environment = world.graph.environment(world.modules)
    paths = (environment["ROS_PACKAGE_PATH"], str(world.package.parent))
    environment["ROS_PACKAGE_PATH"] = ":".join(filter(None, paths))
    done = subprocess.run(
        [world.graph.python, f"/usr/bin/{command[0]}", *command[1:]],
        env=environment,
        capture_output=True,
        text=True,
        check=False,
        timeout=60,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    return done


@pytest.fixture(autouse=True)
def tools() -> None:
    """The tools that start nodes."""
    if not Path("/usr/bin/roslaunch").exists():
        pytest.skip("no roslaunch: apt-get install python3-roslaunch")


def test_nodes_of_a_swarm(world: World) -> None:
    lab = world(MODEL)
    two = _run(lab, "roslaunch", "--nodes", "lab_behavior", "search.launch").stdout
    nodes = [f"/uav_{number}/{name}" for number in range(3) for name in ("look", "left")]
    assert two.split() == nodes[:4]
    three = _run(
        lab, "roslaunch", "--nodes", "lab_behavior", "search.launch", "uav_count:=3"
    ).stdout
    assert three.split() == nodes


def test_params_of_robots(world: World) -> None:
    lab = world(MODEL)
    own = lab.package / "param" / "search" / "uav_1.yaml"
    before = own.read_text(encoding="utf-8")
    own.write_text("look:\n  name: mine\n", encoding="utf-8")
    try:
        text = _run(lab, "roslaunch", "--dump-params", "lab_behavior", "search.launch").stdout
    finally:
        own.write_text(before, encoding="utf-8")
    params = yaml.safe_load(text)
    assert params["/uav_0/look/name"] == "a b"
    assert params["/uav_1/look/name"] == "mine"
    assert params["/uav_0/look/wait"] == 7200.0
    assert params["/uav_0/left/wait"] == 10800.0
    assert params["/uav_1/left/member"] == "uav[1]"
    assert params["/uav_1/left/self/count"] == 2


def test_robot_that_is_launched(world: World) -> None:
    lab = world(MODEL)
    environment = lab.graph.environment(lab.modules)
    paths = (environment["ROS_PACKAGE_PATH"], str(lab.package.parent))
    environment["ROS_PACKAGE_PATH"] = ":".join(filter(None, paths))
    command = ["/usr/bin/roslaunch", "lab_behavior", "uav.launch", f"name:={lab.namespace[1:]}"]
    launched = lab.graph.start([lab.graph.python, *command], output="roslaunch", env=environment)
    lab.graph.wait_for_node(f"{lab.namespace}/look")
    lab.graph.wait_for_node(f"{lab.namespace}/left")
    lab.publish("Stop")
    launched.send_signal(signal.SIGINT)
    assert launched.wait(10) == 0


@pytest.mark.parametrize(
    "example",
    [
        *("minimal", "search_and_rescue", "cpswarm"),
        *(
            pytest.param(each, marks=pytest.mark.thorough)
            for each in ("emergency_exit", "flocking", "storage")
        ),
    ],
)
def test_rostest_of_an_example(example: str, world: World) -> None:
    if not Path("/usr/bin/rostest").exists():
        pytest.skip("no rostest: apt-get install python3-rostest")
    made = world(example=example)
    done = _run(made, "rostest", "--text", made.package.name, "machines.test")
    assert "RESULT: SUCCESS" in done.stdout
