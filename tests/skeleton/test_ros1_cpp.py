"""Skeletons in C++ under a real master of ROS 1: as they are made, and filled in by a person.

catkin builds them with all warnings as errors. Where Debian's packages of ROS 1 are missing,
the tests are skipped and say which.
"""

from __future__ import annotations

import json
import shutil
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from swarmdsl.cli import run as swarmc

from .catkin_workspace import make, missing_of_catkin
from .conftest import HERE, MODEL, STAND_IN, graph_module
from .ros1_nodes import FILLED, NODES, SENDER, SKELETONS

Write = Callable[..., Any]
pytestmark = [pytest.mark.long, pytest.mark.timeout(900)]

# In the form of D5.4's appendix.
SCXML = """<scxml xmlns="http://www.w3.org/2005/07/scxml" version="1.0" name="rise" initial="Up">
  <state id="Up">
    <datamodel>
      <data id="adf"><name>lift</name></data>
      <data id="invoke">
        <rosaction>
          <name>cmd/lift</name><action>lift/Lift</action>
          <goal type="fixed"><param>1.5</param></goal><result type="empty"/>
        </rosaction>
      </data>
    </datamodel>
    <invoke type="ROS_ACTION"/>
    <transition event="succeeded" target="end"/><transition event="aborted" target="end"/>
  </state>
  <final id="end"/>
</scxml>
"""
ADF = {
    "runtime-env": "ROS",
    "functions": [
        {
            "name": "lift",
            "category": "abstraction-lib",
            "param_list": [{"class": "number", "name": "tolerance", "value": 0.1}],
            "api": {
                "inputs": [{"topic": "ready", "msg": {"class": "std_msgs/Bool"}}],
                "comm_model": {
                    "paradigm": "rosaction",
                    "definition": {
                        "name": "cmd/lift",
                        "class": "lift/Lift",
                        "goal": {"fields": [{"class": "float64", "name": "height"}]},
                    },
                },
            },
        }
    ],
}
# Says when it hears the server, and then what becomes of goals.
WITNESS = """
import rospy
from lift.msg import LiftActionResult
def tell(*words):
    print(*words, flush=True)
def end(message):
    tell(message.status.status, message.status.text)
rospy.init_node('witness')
topic = rospy.Subscriber('cmd/lift/result', LiftActionResult, end)
while not topic.get_num_connections():
    rospy.sleep(0.05)
tell('ready')
rospy.spin()
"""


@pytest.fixture(scope="module")
def catkin(
    graph: Any, write: Write, tmp_path_factory: pytest.TempPathFactory, request: Any
) -> Path:
    """A workspace of catkin in which one package is built, or with `--thorough` all, optimised.

    Without optimisation, the compiler warns less; with more, it takes a third longer.
    """
    if (missing := missing_of_catkin()) is not None:
        pytest.skip(missing)
    folder = tmp_path_factory.mktemp("catkin")
    write(folder / "src", language="cpp")
    if not request.config.getoption("--thorough"):
        for name in set(NODES) - {"climb"}:
            shutil.rmtree(folder / "src" / name)  # CMake would look at it
        fill_in(folder, "climb")
        make(graph, folder, "climb_node")
        return folder
    # A machine and the server that it calls, as the CPSwarm code generator was called for them.
    (folder / "lift.xml").write_text(SCXML, encoding="utf-8")
    (folder / "lift.json").write_text(json.dumps(ADF), encoding="utf-8")
    words = ["--scxml", f"{folder}/lift.xml", "--adf", f"{folder}/lift.json", "-o", f"{folder}/src"]
    assert swarmc(["codegen", "--env", "ROS", *words]) == 0
    make(graph, folder, "all", "tests")
    return folder


def cpp_commands(folder: Path) -> dict[str, list[str]]:
    return {name: [str(folder / "devel" / "lib" / name / f"{name}_node")] for name in NODES}


CPP_FILLED = {
    **FILLED,
    "raised": ["ABORTED", 0.0, "too high", []],
    "nothing": ["ABORTED", 0.0, "execute threw what is no std::exception", []],
}


def fill_in(folder: Path, name: str) -> None:
    """Give a skeleton the code of a person; what has it already is not compiled again."""
    code = (HERE / "code" / f"{name}.cpp").read_text(encoding="utf-8")
    file = folder / "src" / name / "src" / f"{name}.cpp"
    if file.read_text(encoding="utf-8") != code:
        file.write_text(code, encoding="utf-8")


@pytest.mark.thorough
def test_cpp_skeletons_end_each_goal(catkin: Path, start: Any) -> None:
    assert start(cpp_commands(catkin), [])("skeletons") == SKELETONS


def test_a_log_of_roscpp_leads_to_the_model(
    graph: Any,
    catkin: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capfdbinary: pytest.CaptureFixture[bytes],
) -> None:
    """The files were compiled in another folder than the one with the source map."""
    monkeypatch.chdir(tmp_path)
    shutil.copy(MODEL, tmp_path)
    options = ["--option", "skeleton.language=cpp", "-o", "src"]
    assert swarmc(["build", MODEL.name, "--target", "skeleton", *options]) == 0
    environment = graph.environment(
        ROS_NAMESPACE="/no_param_cpp",
        ROSCONSOLE_FORMAT="[${severity}] [${file}:${line}]: ${message}",
    )
    run = subprocess.run(
        cpp_commands(catkin)["climb"], env=environment, capture_output=True, timeout=60, check=False
    )
    (tmp_path / "node.log").write_bytes(run.stderr)
    capfdbinary.readouterr()

    assert run.returncode == 1
    assert b"ROS parameter /no_param_cpp/climb/frame has no value" in run.stderr
    assert swarmc(["trace", "node.log"]) == 0
    said = capfdbinary.readouterr().out.decode()
    assert "  --> model.swarm:28:10\n" in said
    assert "the whole of `climb_base.cpp` is generated from this" in said


@pytest.mark.thorough
def test_cpp_tests_of_users_pass(graph: Any, catkin: Path) -> None:
    for name in NODES:
        run = subprocess.run(
            [catkin / "devel" / "lib" / name / f"{name}_test"],
            env=graph.environment(), capture_output=True, text=True, check=False,
        )  # fmt: skip
        assert run.returncode == 0, run.stdout
        assert "PASSED" in run.stdout


@pytest.mark.thorough
def test_cpp_nodes_do_what_is_filled_in(graph: Any, catkin: Path, start: Any) -> None:
    for name in ("climb", "camera"):
        fill_in(catkin, name)
    make(graph, catkin, *(f"{name}_node" for name in NODES))

    assert start(cpp_commands(catkin), [])("filled") == CPP_FILLED


def test_a_goal_has_a_result_when_its_node_is_stopped(graph: Any, catkin: Path, start: Any) -> None:
    fill_in(catkin, "climb")
    make(graph, catkin, "climb_node")
    ask = start({"climb": cpp_commands(catkin)["climb"]}, [])
    climb = start.running["climb"]

    assert ask("stopped", str(climb.pid)) == ["ABORTED", 0.0, "left", []]
    assert climb.wait(60) == 0


NEVER = """
#include <climb/climb.h>
#include <csignal>
namespace climb
{
Climb::Outcome Climb::execute(const Goal&, Result&, std::string&)
{
  std::raise(SIGTERM);
  ros::WallDuration(3600).sleep();
  return Outcome::succeeded;
}
void Climb::on_state(const demo::Sample&) {}
}  // namespace climb
"""


@pytest.mark.thorough
def test_a_node_ends_although_its_goal_does_not(graph: Any, catkin: Path, start: Any) -> None:
    source = catkin / "src" / "climb" / "src"
    (source / "climb.cpp").write_text(NEVER, encoding="utf-8")
    node = (source / "climb_node.cpp").read_text(encoding="utf-8")
    (source / "climb_node.cpp").write_text(node.replace("LATE = 20", "LATE = 2"), encoding="utf-8")
    make(graph, catkin, "climb_node")
    command = cpp_commands(catkin)["climb"]
    modules = catkin / "devel" / "lib" / "python3" / "dist-packages"
    start({"climb": command, "sender": [graph.python, "-c", SENDER]}, [modules])

    assert start.running["climb"].wait(60) == 1


@pytest.mark.thorough
def test_a_generated_machine_is_answered_by_the_server_of_a_skeleton(
    graph: Any, catkin: Path
) -> None:
    modules = [catkin / "devel" / "lib" / "python3" / "dist-packages", STAND_IN]
    environment = graph.environment(modules, ROS_NAMESPACE="/answered")
    commands = {
        "witness": [graph.python, "-c", WITNESS],
        "server": [str(catkin / "devel" / "lib" / "lift" / "lift_node")],
        "machine": [graph.python, str(catkin / "src" / "fsm_behaviour" / "scripts" / "rise")],
    }
    running = {}
    try:
        for name, command in commands.items():
            running[name] = graph.start(command, output=f"answered_{name}", env=environment)
            if name == "server":
                graph_module.wait_until(lambda: graph.printed("answered_witness"), "ready", 30)
        graph_module.wait_until(lambda: running["machine"].poll() is not None, "it ends", 60)
    finally:
        for process in running.values():
            graph.end(process)

    assert running["machine"].returncode == 0, graph.printed("answered_machine")
    assert graph.printed("answered_witness").splitlines() == [
        "ready",
        "4 lift is not implemented",  # GoalStatus.ABORTED
    ]
