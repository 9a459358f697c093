"""Generated nodes that run their machines in YASMIN: what they do is what the engine does.

They run on the stand-in of tests/yasmin, and on the real YASMIN where SWARMDSL_YASMIN_PATH names
the folders of its packages. As for all nodes here, their traces are those of the model.
"""

from __future__ import annotations

import os
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

HERE = Path(__file__).resolve().parent
STAND_IN = HERE.parent / "yasmin" / "stand_in"
TAKE_OFF = ("/sar/uav_0/cmd/takeoff", "uav_mavros_takeoff/action/TakeOff")
COVERAGE = ("/sar/uav_0/uav_coverage", "cpswarm_msgs/action/Coverage")
LAND = ("/sar/uav_0/cmd/land", "std_srvs/srv/Empty")
# A program of somebody's own, in which the machine is a part of another one.
PROGRAM = """
import os
import sys
from threading import Thread
import rclpy
import yasmin
from sar_behavior.uav_search_fsm import build

class Count(yasmin.State):
    def __init__(self):
        super().__init__({'again', 'enough'})
        self.left = 2

    def execute(self, blackboard):
        print('altitude', blackboard['altitude'], flush=True)
        self.left -= 1
        return 'again' if self.left else 'enough'

def cancel():
    for _ in sys.stdin:
        search.cancel_state()

rclpy.init(args=sys.argv)
search = build()
outer = yasmin.StateMachine({'enough'})
outer.add_state('Search', search, {'canceled': 'Count'})
outer.add_state('Count', Count(), {'again': 'Search'})
Thread(target=cancel, daemon=True).start()
print('came out with', outer(yasmin.Blackboard()), flush=True)
os._exit(0)
"""


@pytest.fixture(params=["stand-in", "real"])
def robot(
    request: pytest.FixtureRequest, ros: Any, variant: Callable[..., Path]
) -> Callable[..., Any]:
    """Make nodes of a model."""
    if request.param == "real" and "SWARMDSL_YASMIN_PATH" not in os.environ:
        pytest.skip("no real YASMIN here; SWARMDSL_YASMIN_PATH names the folders of it")
    real = os.environ.get("SWARMDSL_YASMIN_PATH", "").split(os.pathsep)
    for place in [str(STAND_IN)] if request.param == "stand-in" else real:
        ros.prefer(Path(place))

    def robot(model: str, module: str, namespace: str, **parameters: Any) -> Any:
        ros.prefer(variant(model, target="yasmin"))
        return ros.node(module, namespace, **parameters) if module else None

    return robot


@pytest.fixture
def fakes(ros: Any) -> Any:
    """Servers of a UAV, and whoever starts and aborts missions."""
    made = ros.fakes()
    for event in ("start", "abort"):
        made.publisher(f"/sar/mission_{event}", "swarmros/msg/SimpleEvent")
    return made


def uav(robot: Callable[..., Any], fakes: Any, **parameters: Any) -> Any:
    """A UAV that waits for its mission."""
    given = {"member": "uav[0]", "timeouts__server": 1.0, **parameters}
    node = robot("examples/search_and_rescue", "sar_behavior.uav_search_fsm", "/sar/uav_0", **given)
    for event in ("start", "abort"):
        fakes.listeners(f"/sar/mission_{event}")
    node.wait_in("Mission.Idle")
    return node


def test_a_mission_that_is_aborted(robot: Callable[..., Any], fakes: Any) -> None:
    fakes.action(*TAKE_OFF, "succeeded")
    fakes.action(*COVERAGE, "never", stopping=0.3)
    fakes.service(*LAND, {"outcome": "succeeded", "after": 0.1})
    node = uav(robot, fakes, altitude=4.5)
    fakes.publish("/sar/mission_start")
    assert fakes.wait("goal", TAKE_OFF[0])["data"] == {"altitude": 4.5}
    fakes.wait("goal", COVERAGE[0])
    fakes.publish("/sar/mission_abort")

    line = node.wait_for("MissionAbort")
    assert (line["cancelled"], line["started"]) == (["uav_coverage"], ["uav_mavros_land"])
    fakes.wait("stopped", COVERAGE[0])
    fakes.wait("request", LAND[0])
    node.wait_in("Mission.Idle")


@pytest.mark.parametrize("number", [2, 15], ids=["SIGINT", "SIGTERM"])
def test_signals_cancel_goals(robot: Callable[..., Any], fakes: Any, number: int) -> None:
    fakes.action(*TAKE_OFF, "never", stopping=0.2)
    node = uav(robot, fakes)
    fakes.publish("/sar/mission_start")
    fakes.wait("goal", TAKE_OFF[0])

    assert node.terminate(number) == 0
    fakes.wait("stopped", TAKE_OFF[0])
    assert node.trace[-1]["cancelled"] == ["uav_mavros_takeoff"]
    assert "the machine of YASMIN has ended with canceled" in node.log
    assert "Traceback" not in node.log


def test_a_machine_in_a_program_of_somebody_else(
    robot: Callable[..., Any], ros: Any, fakes: Any, tmp_path: Path
) -> None:
    """It has a node of its own there, and begins anew each time."""
    robot("examples/search_and_rescue", "", "")
    program = tmp_path / "program.py"
    program.write_text(PROGRAM, encoding="utf-8")
    fakes.action(*TAKE_OFF, "never", "never")
    words = ["--ros-args", "-r", "__ns:=/sar/uav_0", "-p", "altitude:=3.5"]
    process = ros.start(program, *words, stdin=subprocess.PIPE, stdout=subprocess.PIPE)
    state = "/sar/uav_0/uav_search/state"
    fakes.do("subscribe", topic=state, kind="std_msgs/msg/String", latched=True)
    fakes.listeners("/sar/mission_start")
    for number in (1, 2):
        # It begins, takes off, ends, and begins anew.
        fakes.wait("message", state, 1 + 3 * (number - 1))
        fakes.publish("/sar/mission_start")
        assert fakes.wait("goal", TAKE_OFF[0], number)["data"] == {"altitude": 3.5}
        process.stdin.write("cancel\n")
        process.stdin.flush()
        fakes.wait("stopped", TAKE_OFF[0], number)
    output, _ = process.communicate(timeout=60)
    said = [line for line in output.splitlines() if not line.startswith("[")]  # YASMIN logs there
    assert said == ["altitude 3.5", "altitude 3.5", "came out with enough"]
