"""Generated nodes that run their machines in a library: what they do is what the engine does.

They run on a stand-in for YASMIN, and on the real one where SWARMDSL_YASMIN_PATH names the folders
of its packages; on the real SMACH where there is one, as in tests/smach, and on the stand-in
elsewhere. As for all nodes here, their
traces are those of the model.
"""

from __future__ import annotations

import os
import subprocess
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

from .conftest import load_module

HERE = Path(__file__).resolve().parent
TAKE_OFF = ("/sar/uav_0/cmd/takeoff", "uav_mavros_takeoff/action/TakeOff")
COVERAGE = ("/sar/uav_0/uav_coverage", "cpswarm_msgs/action/Coverage")
LAND = ("/sar/uav_0/cmd/land", "std_srvs/srv/Empty")
# Programs of somebody's own, in which the machine is a part of another one.
IN_YASMIN = """
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
IN_SMACH = """
import os
import sys
from threading import Thread
import rclpy
import smach
from sar_behavior.uav_search_smach import build

class Count(smach.State):
    def __init__(self):
        super().__init__(['again', 'enough'], ['altitude'])
        self.left = 2

    def execute(self, userdata):
        print('altitude', userdata.altitude, flush=True)
        self.left -= 1
        return 'again' if self.left else 'enough'

def preempt():
    for _ in sys.stdin:
        search.request_preempt()

rclpy.init(args=sys.argv)
search = build()
search.register_output_keys(['altitude'])
outer = smach.StateMachine(['enough'])
with outer:
    smach.StateMachine.add('Search', search, {'preempted': 'Count'})
    smach.StateMachine.add('Count', Count(), {'again': 'Search', 'enough': 'enough'})
Thread(target=preempt, daemon=True).start()
print('came out with', outer.execute(), flush=True)
os._exit(0)
"""
# The machine is stopped when its library has begun, and its engine is about to.
TOO_SOON = """
import os
import sys
import rclpy
from sar_behavior import runner
from sar_behavior.uav_search{suffix} import build

class Engine(runner.Engine):
    def begin_engine(self):
        {stop}
        super().begin_engine()

rclpy.init(args=sys.argv)
runner.Engine = Engine
search = build()
print('came out with', {run}, flush=True)
os._exit(0)
"""
# The machine begins anew while the thread that runs it has not come to its end.
ANEW = """
import os
import sys
from threading import Thread
import time
import rclpy
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from sar_behavior.runner import Fsm, Host
from sar_behavior.uav_search{suffix} import BEHAVIOR, CHART, build

class Slow:
    def __init__(self, search):
        self.search = search

    def execute(self, *memory):
        print('begins', flush=True)
        search = self.search
        outcome = {run}
        time.sleep(0.3)
        print('has ended', flush=True)
        return outcome

    __call__ = execute

class SlowHost(Host):
    def configure(self):
        super().configure()
        self._machine = Slow(self._machine)

def until_it_runs():
    while host._instance is None or not host._instance.running:
        time.sleep(0.01)

rclpy.init(args=sys.argv)
node = Node('uav_search')
host = SlowHost(node, Fsm(BEHAVIOR, CHART, build), lambda failed: ends.append(failed))
ends = []
host.configure()
executor = SingleThreadedExecutor()
executor.add_node(node)
Thread(target=executor.spin, daemon=True).start()
host.begin()
until_it_runs()
for _ in range(2):
    host.end()
    host.begin()
until_it_runs()
host.end()
while len(ends) < 3:
    time.sleep(0.01)
print(*ends, flush=True)
host.release()
Host.configure(host)
print('viewed', node.count_publishers('/fsm_viewer'), flush=True)
os._exit(0)
"""


@dataclass(frozen=True)
class Library:
    """A library, and the program in which a machine of it is a part of another one."""

    name: str
    options: dict[str, str]
    suffix: str
    stopped: str
    stand_in: tuple[Path, ...]
    real: str
    program: str
    stop: str
    run: str


YASMIN = Library(
    "YASMIN",
    {"target": "yasmin"},
    "_fsm",
    "canceled",
    (HERE.parent / "yasmin" / "stand_in",),
    "SWARMDSL_YASMIN_PATH",
    IN_YASMIN,
    "search.cancel_state()",
    "search()",
)
SMACH = Library(
    "SMACH",
    {"target": "smach", "ros": "2"},
    "_smach",
    "preempted",
    (HERE.parent / "smach" / "stand_in", HERE / "smach_stand_in"),
    "SWARMDSL_SMACH_PATH",
    IN_SMACH,
    "search.request_preempt()",
    "search.execute()",
)


def real(library: Library) -> Sequence[Path]:
    """The folders of a real library, those to prefer last; none if there is none."""
    if library is SMACH:
        environment = load_module("environment", HERE.parent / "smach")
        return tuple(reversed(environment.installed(HERE / "smach_stand_in")))
    return [Path(each) for each in os.environ.get(library.real, "").split(os.pathsep) if each]


# Where the real SMACH is installed, the stand-in would only cost time.
KINDS = [(YASMIN, False), (YASMIN, True), (SMACH, False), (SMACH, True)]
if real(SMACH):
    KINDS.remove((SMACH, False))


@pytest.fixture(
    params=KINDS, ids=lambda each: f"{each[0].name}-{'real' if each[1] else 'stand-in'}"
)
def library(request: pytest.FixtureRequest, ros: Any) -> Library:
    """A library that nodes can import."""
    found, is_real = request.param
    places = real(found) if is_real else found.stand_in
    if not places:
        pytest.skip(f"no real {found.name}: {found.real} names the folders of it")
    for place in places:
        ros.prefer(place)
    made: Library = found
    return made


@pytest.fixture
def robot(library: Library, ros: Any, variant: Callable[..., Path]) -> Callable[..., Any]:
    """Make nodes of a model."""

    def robot(model: str, module: str, namespace: str, **parameters: Any) -> Any:
        ros.prefer(variant(model, **library.options))
        name = f"{module}{library.suffix}"
        return ros.node(name, namespace, **parameters) if module else None

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
    node = robot("examples/search_and_rescue", "sar_behavior.uav_search", "/sar/uav_0", **given)
    for event in ("start", "abort"):
        fakes.listeners(f"/sar/mission_{event}")
    node.wait_in("Mission.Idle")
    return node


def test_a_monitor_watches_it(library: Library, ros: Any, variant: Callable[..., Path]) -> None:
    ros.prefer(variant("tests/ros2/models", monitors="true", **library.options))
    fakes = ros.fakes()
    fakes.publisher("/depot/carrier_0/take", "std_msgs/msg/Int32")
    monitor = ros.node("lab_behavior.depot_monitor", "/depot", members="carrier[0]")
    space = "/depot/carrier_0"
    node = ros.node(f"lab_behavior.carrying{library.suffix}", space, member="carrier[0]")
    node.wait_in("Empty")
    fakes.listeners(f"{space}/take")
    fakes.publish(f"{space}/take", data=4)

    def is_false(trace: list[dict[str, Any]]) -> bool:
        return any(line.get("property") == "Light" and line["verdict"] == "false" for line in trace)

    monitor.until(is_false, "property Light is violated")
    assert monitor.terminate() == 0
    assert "Light: false by carrier[0] at " in monitor.log


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
def test_signals_cancel_goals(
    robot: Callable[..., Any], fakes: Any, library: Library, number: int
) -> None:
    fakes.action(*TAKE_OFF, "never", stopping=0.2)
    node = uav(robot, fakes)
    fakes.publish("/sar/mission_start")
    fakes.wait("goal", TAKE_OFF[0])

    assert node.terminate(number) == 0
    fakes.wait("stopped", TAKE_OFF[0])
    assert node.trace[-1]["cancelled"] == ["uav_mavros_takeoff"]
    assert f"the machine of {library.name} has ended with {library.stopped}" in node.log
    assert "Traceback" not in node.log


def test_a_machine_in_a_program_of_somebody_else(
    robot: Callable[..., Any], library: Library, ros: Any, fakes: Any, tmp_path: Path
) -> None:
    """It has a node of its own there, and begins anew each time."""
    robot("examples/search_and_rescue", "", "")
    program = tmp_path / "program.py"
    program.write_text(library.program, encoding="utf-8")
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
    said = [line for line in output.splitlines() if not line.startswith("[")]  # logs, too
    assert said == ["altitude 3.5", "altitude 3.5", "came out with enough"]


def test_a_machine_that_is_stopped_before_its_engine_has_begun(
    robot: Callable[..., Any], library: Library, ros: Any, tmp_path: Path
) -> None:
    """It ends, and does nothing of what it would do when it begins."""
    robot("examples/search_and_rescue", "", "")
    program = tmp_path / "program.py"
    text = TOO_SOON.format(suffix=library.suffix, stop=library.stop, run=library.run)
    program.write_text(text, encoding="utf-8")
    trace = tmp_path / "trace.jsonl"
    process = ros.start(program, "--ros-args", "-p", f"trace.file:={trace}", stdout=subprocess.PIPE)
    output, _ = process.communicate(timeout=60)
    assert f"came out with {library.stopped}" in output.splitlines()
    assert trace.read_text(encoding="utf-8") == ""


def test_a_machine_that_begins_anew_has_ended_before(
    robot: Callable[..., Any], library: Library, ros: Any, tmp_path: Path
) -> None:
    """However fast a node is deactivated and activated, one thread at a time runs its machine.

    Configured anew, it tells its states as often as before.
    """
    robot("examples/search_and_rescue", "", "")
    program = tmp_path / "program.py"
    program.write_text(ANEW.format(suffix=library.suffix, run=library.run), encoding="utf-8")
    process = ros.start(program, stdout=subprocess.PIPE)
    output, _ = process.communicate(timeout=60)
    said = [line for line in output.splitlines() if not line.startswith("[")]
    viewers = int(library is YASMIN)
    assert said == [*["begins", "has ended"] * 3, "False False False", f"viewed {viewers}"]
