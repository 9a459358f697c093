"""The command of D5.4's appendix, on its files: what it makes is built by catkin, and runs.

SWARMDSL_CATKIN=1 asks for it; `test_ros1_cpp.py` always runs a smaller one of its kind. What
the packages need of others is made here: interfaces of CPSwarm and mavros, which Debian has not.
"""

from __future__ import annotations

import os
import shutil
from pathlib import Path
from typing import Any

import pytest

from swarmdsl.cli import run as swarmc

from .catkin_workspace import make, missing_of_catkin
from .conftest import STAND_IN, graph_module

pytestmark = pytest.mark.timeout(900)

ROOT = Path(__file__).parents[2]
CORPUS = Path(os.environ.get("SWARMDSL_CORPUS", ROOT.parent / "shared" / "corpus"))
FSM = CORPUS / "scxml" / "head_UAV_sar_FSM4.xml"
ADF = CORPUS / "adf" / "head_scxml.json"

# What the ADF file says of it is what mavros has.
STATE = """std_msgs/Header header
bool connected
bool armed
bool guided
bool manual_input
string mode
uint8 system_status
"""
NEEDED = {
    "mavros_msgs": ("add_message_files(FILES State.msg)", "std_msgs"),
    "cpswarm_msgs": ("add_action_files(FILES Coverage.action)", "actionlib_msgs geometry_msgs"),
}
CMAKE = """cmake_minimum_required(VERSION 3.0.2)
project({name})
find_package(catkin REQUIRED COMPONENTS message_generation {needs})
{adds}
generate_messages(DEPENDENCIES {needs})
catkin_package(CATKIN_DEPENDS message_runtime {needs})
"""
PACKAGE = """<package format="2">
<name>{name}</name><version>0.0.0</version><description>-</description>
<maintainer email="a@example.org">-</maintainer><license>-</license>
<buildtool_depend>catkin</buildtool_depend><build_depend>message_generation</build_depend>
{depends}<exec_depend>message_runtime</exec_depend>
</package>
"""
# Says when it hears both sides, then the goal and what becomes of it.
WITNESS = """
import rospy
from uav_mavros_takeoff.msg import TakeOffActionGoal, TakeOffActionResult
def tell(*words):
    print(*words, flush=True)
rospy.init_node('witness')
rospy.Subscriber('cmd/takeoff/goal', TakeOffActionGoal, lambda m: tell(m.goal.altitude))
end = rospy.Subscriber(
    'cmd/takeoff/result', TakeOffActionResult, lambda m: tell(m.status.status, m.status.text)
)
while not end.get_num_connections():
    rospy.sleep(0.05)
tell('ready')
rospy.spin()
"""


@pytest.fixture(scope="module")
def workspace(graph: Any, tmp_path_factory: pytest.TempPathFactory) -> Path:
    if "SWARMDSL_CATKIN" not in os.environ:
        pytest.skip("slow: `SWARMDSL_CATKIN=1 pytest tests/skeleton/test_appendix.py`")
    if not (FSM.is_file() and ADF.is_file()):
        pytest.skip(f"no files of the CPSwarm project at {CORPUS} (set SWARMDSL_CORPUS)")
    if (missing := missing_of_catkin()) is not None:
        pytest.skip(missing)
    folder = tmp_path_factory.mktemp("appendix")
    source = folder / "src"
    words = ["--env", "ROS", "--scxml", str(FSM), "--adf", str(ADF), "--output", str(source)]
    assert swarmc(["codegen", *words]) == 0
    (source / "mavros_msgs" / "msg").mkdir(parents=True)
    (source / "mavros_msgs" / "msg" / "State.msg").write_text(STATE, encoding="utf-8")
    (source / "cpswarm_msgs" / "action").mkdir(parents=True)
    coverage = Path("cpswarm_msgs", "action", "Coverage.action")
    shutil.copy(CORPUS / "interfaces" / coverage, source / coverage)
    for name, (adds, needs) in NEEDED.items():
        text = CMAKE.format(name=name, adds=adds, needs=needs)
        (source / name / "CMakeLists.txt").write_text(text, encoding="utf-8")
        depends = "".join(f"<depend>{each}</depend>\n" for each in needs.split())
        text = PACKAGE.format(name=name, depends=depends)
        (source / name / "package.xml").write_text(text, encoding="utf-8")
    make(graph, folder, optimisation="-O0")
    return folder


def test_the_take_off_server_answers_the_goal_of_the_machine(graph: Any, workspace: Path) -> None:
    devel = workspace / "devel"
    environment = graph.environment(
        [devel / "lib" / "python3" / "dist-packages", STAND_IN], ROS_NAMESPACE="/appendix"
    )
    server = devel / "lib" / "uav_mavros_takeoff" / "uav_mavros_takeoff_node"
    machine = workspace / "src" / "fsm_behaviour" / "scripts" / "sar"
    running = {}
    try:
        for name, command in (
            ("witness", [graph.python, "-c", WITNESS]),
            ("server", [str(server)]),
            ("machine", [graph.python, str(machine)]),
        ):
            running[name] = graph.start(command, output=f"appendix_{name}", env=environment)
            if name == "server":
                graph_module.wait_until(lambda: graph.printed("appendix_witness"), "ready", 30)
        graph_module.wait_until(lambda: running["machine"].poll() is not None, "it ends", 60)
    finally:
        for process in running.values():
            graph.end(process)

    assert running["machine"].returncode == 0, graph.printed("appendix_machine")
    assert graph.printed("appendix_witness").splitlines() == [
        "ready",
        "1.1",
        "4 uav_mavros_takeoff is not implemented",  # GoalStatus.ABORTED
    ]
