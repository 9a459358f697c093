"""Skeletons in Python under a real master of ROS 1: as they are made, and filled in by a person.

Where Debian's packages of ROS 1 are missing, the tests are skipped and say which.
"""

from __future__ import annotations

import re
import shutil
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from swarmdsl.cli import run as swarmc

from .conftest import HERE, MODEL, graph_module
from .ros1_nodes import FILLED, NODES, SENDER, SKELETONS

Write = Callable[..., Any]


@pytest.fixture(scope="module")
def python_nodes(write: Write, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("python")
    write(folder)
    return folder


def python_commands(graph: Any, folder: Path) -> dict[str, list[str]]:
    return {name: [graph.python, str(folder / name / "scripts" / f"{name}_node")] for name in NODES}


def test_python_skeletons_end_each_goal(graph: Any, python_nodes: Path, start: Any) -> None:
    ask = start(python_commands(graph, python_nodes), [python_nodes / n / "src" for n in NODES])

    assert ask("skeletons") == SKELETONS


def test_python_nodes_do_what_is_filled_in(
    graph: Any, python_nodes: Path, start: Any, tmp_path: Path
) -> None:
    shutil.copytree(python_nodes, tmp_path / "src")
    for name in ("climb", "camera"):
        target = tmp_path / "src" / name / "src" / name / "implementation.py"
        shutil.copy(HERE / "code" / f"{name}.py", target)
    folder = tmp_path / "src"
    ask = start(python_commands(graph, folder), [folder / name / "src" for name in NODES])

    assert ask("filled", "python") == {
        **FILLED,
        "raised": ["ABORTED", 0.0, "ValueError: too high", []],
        "nothing": ["ABORTED", 0.0, "TypeError: execute returned None, which is no Outcome", []],
        "wrong": ["ABORTED", 0.0, "SerializationError: field reached must be float type", []],
    }


def test_a_goal_has_a_result_when_its_node_is_stopped(
    graph: Any, python_nodes: Path, start: Any, tmp_path: Path
) -> None:
    shutil.copytree(python_nodes / "climb", tmp_path / "climb")
    source = tmp_path / "climb" / "src"
    shutil.copy(HERE / "code" / "climb.py", source / "climb" / "implementation.py")
    ask = start({"climb": python_commands(graph, tmp_path)["climb"]}, [source])
    climb = start.running["climb"]

    assert ask("stopped", str(climb.pid)) == ["ABORTED", 0.0, "left", []]
    assert climb.wait(60) == 0


NEVER = """
import os
import signal
import time
from climb.base import ClimbBase
class Climb(ClimbBase):
    def execute(self, goal):
        os.kill(os.getpid(), signal.SIGTERM)
        time.sleep(10**6)
"""


def test_a_node_ends_although_its_goal_does_not(
    graph: Any, python_nodes: Path, start: Any, tmp_path: Path
) -> None:
    shutil.copytree(python_nodes / "climb", tmp_path / "climb")
    source = tmp_path / "climb" / "src"
    (source / "climb" / "implementation.py").write_text(NEVER, encoding="utf-8")
    (command,) = (python_commands(graph, tmp_path)[name] for name in ["climb"])
    for file, name in ((Path(command[-1]), "LATE"), (source / "climb" / "base.py", "GRACE")):
        text = re.sub(rf"^{name} = .*", f"{name} = 2", file.read_text(), flags=re.MULTILINE)
        file.write_text(text, encoding="utf-8")
    start({"climb": command, "sender": [graph.python, "-c", SENDER]}, [source])

    assert start.running["climb"].wait(60) == 1


def test_python_tests_of_users_pass(graph: Any, messages: Path, python_nodes: Path) -> None:
    for name in NODES:
        environment = graph.environment([python_nodes / name / "src", messages])
        command = [graph.python, python_nodes / name / "test" / f"test_{name}.py"]
        run = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
        assert run.returncode == 0, run.stderr
        assert "OK" in run.stderr


def test_a_node_without_a_needed_param_says_so(
    graph: Any, messages: Path, python_nodes: Path
) -> None:
    environment = graph.environment(
        [python_nodes / "climb" / "src", messages], ROS_NAMESPACE="/no_param"
    )
    command = python_commands(graph, python_nodes)["climb"]
    run = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=100)

    assert run.returncode == 1
    assert "ROS parameter /no_param/climb/frame has no value" in run.stderr
    assert "Traceback" not in run.stderr


@pytest.mark.parametrize("call", ["registerPublisher", "registerService", "getParam"])
def test_a_node_that_is_told_to_end_while_it_begins(
    graph: Any, messages: Path, python_nodes: Path, call: str
) -> None:
    graph.set_param("/begins/climb/frame", "map")
    folders = [python_nodes / "climb" / "src", messages]
    environment = graph.environment(folders, ROS_NAMESPACE="/begins")

    assert graph.interrupt(python_commands(graph, python_nodes)["climb"], call, environment) == 0


def test_a_launch_file_of_cpswarm_can_start_it(
    graph: Any, python_nodes: Path, tmp_path: Path
) -> None:
    (tmp_path / "all.launch").write_text(
        """<launch><group ns="uav_3"><include file="$(find climb)/launch/climb.launch">
        <arg name="id" value="3"/><arg name="output" value="log"/></include></group></launch>""",
        encoding="utf-8",
    )
    command = ["/usr/bin/roslaunch", "--nodes", str(tmp_path / "all.launch")]
    environment = graph.environment(ROS_PACKAGE_PATH=str(python_nodes))
    run = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)

    assert run.stdout.split() == ["/uav_3/climb_3"], run.stderr


HOOK = """
import rospy
from camera.base import CameraBase
class Camera(CameraBase):
    def on_exposure(self, message):
        raise ValueError('too bright')
"""
BRIGHT = """
import rospy, std_msgs.msg
rospy.init_node('sun')
publisher = rospy.Publisher('exposure', std_msgs.msg.Float64, queue_size=1, latch=True)
publisher.publish(1.0)
rospy.spin()
"""


def test_a_log_of_rospy_leads_to_the_model(
    graph: Any,
    messages: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capfdbinary: pytest.CaptureFixture[bytes],
) -> None:
    monkeypatch.chdir(tmp_path)
    shutil.copy(MODEL, tmp_path)
    assert swarmc(["build", MODEL.name, "--target", "skeleton", "-o", "src"]) == 0
    camera = tmp_path / "src" / "skeleton" / "camera"
    (camera / "src" / "camera" / "implementation.py").write_text(HOOK, encoding="utf-8")
    environment = graph.environment(
        [camera / "src", messages],
        ROS_NAMESPACE="/traced",
        ROSCONSOLE_FORMAT="[${severity}] [${file}:${line}]: ${message}",
    )
    commands = {
        "traced_camera": [graph.python, str(camera / "scripts" / "camera_node")],
        "traced_sun": [graph.python, "-c", BRIGHT],
    }
    running = []
    try:
        for name, command in commands.items():
            running.append(graph.start(command, output=name, env=environment))
        wanted = "ValueError: too bright"
        graph_module.wait_until(lambda: wanted in graph.printed("traced_camera"), wanted, 60)
    finally:
        for process in running:
            graph.end(process)
    log = graph.printed("traced_camera")
    (tmp_path / "node.log").write_text(log, encoding="utf-8")
    capfdbinary.readouterr()

    assert swarmc(["trace", "node.log"]) == 0
    said = capfdbinary.readouterr().out.decode()
    assert "bad callback" in log
    assert (
        "    self.on_exposure(message)\n"
        "  --> model.swarm:48:9\n"
        "   |\n"
        '48 |   in    exposure : float64 on "exposure"\n'
        "   |         ^^^^^^^^\n"
    ) in said
    assert "note: `implementation.py` is yours to implement, for model.swarm:47:8" in said
