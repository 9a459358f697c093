"""Skeletons for ROS 1 under a real master: as they are made, and filled in by a person.

Those in Python run as they are; those in C++ are built by catkin with all warnings as errors.
Where Debian's packages of ROS 1 are missing, the tests are skipped and say which.
"""

from __future__ import annotations

import json
import shutil
import subprocess
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

from swarmdsl.cli import run as swarmc

from .conftest import MODEL, graph_module

HERE = Path(__file__).parent
STAND_IN = HERE.parent / "smach" / "stand_in"
NODES = ("climb", "beep", "camera")
_CATKIN = (
    "/usr/bin/catkin_make",
    "/usr/include/ros/ros.h",
    "/usr/include/actionlib/action_definition.h",
)
_CPP = "-Wall -Wextra -Werror"

Write = Callable[..., Any]
Started = dict[str, Any]


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
def messages(graph: Any, write: Write, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The Python of the interfaces of the model."""
    folder = tmp_path_factory.mktemp("interfaces")
    write(folder / "src")
    (folder / "packages").mkdir()
    shutil.copytree(folder / "src" / "demo", folder / "packages" / "demo")
    script = HERE.parent / "ros1" / "messages.py"
    command = [graph_module.PYTHON, script, folder / "packages", folder / "python"]
    run = subprocess.run(command, capture_output=True, text=True, check=False)
    assert run.returncode == 0, run.stderr
    return folder / "python"


@pytest.fixture(scope="module")
def python_nodes(write: Write, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("python")
    write(folder)
    return folder


@pytest.fixture
def start(graph: Any, messages: Path, request: pytest.FixtureRequest) -> Iterator[Any]:
    """Start nodes by their names in a namespace of their own, and ask them from a client."""
    running: list[Any] = []
    namespace = f"/{request.node.name.replace('[', '_').replace(']', '').replace('-', '_')}"

    def start(commands: dict[str, list[str]], folders: list[Path]) -> Callable[..., Any]:
        graph.set_param(f"{namespace}/climb/frame", "map")
        environment = graph.environment([*folders, messages], ROS_NAMESPACE=namespace)
        for name, command in commands.items():
            running.append(graph.start(command, output=f"{namespace[1:]}_{name}", env=environment))

        def ask(*words: str) -> Any:
            run = subprocess.run(
                [graph.python, HERE / "client.py", *words],
                env=environment, capture_output=True, text=True, timeout=100, check=False,
            )  # fmt: skip
            printed = "\n".join(graph.printed(f"{namespace[1:]}_{name}") for name in commands)
            assert run.returncode == 0, f"{run.stderr}\n{printed}"
            return json.loads(run.stdout.splitlines()[-1])

        return ask

    yield start
    for process in running:
        graph.end(process)


SKELETONS = {
    "beep": None,
    "snap": None,
    "goal": ["ABORTED", 0.0, "climb is not implemented", []],
}
FILLED = {
    "beep": None,
    "snap": {"stored": True},
    "zoomed": {"stored": False},
    "seen": [0.5],
    "position": 7,
    "reached": ["SUCCEEDED", 1.1, "", [0.5]],
    "cancelled": ["PREEMPTED", 0.0, "left", []],
}


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
    run = subprocess.run(command, env=environment, capture_output=True, text=True, timeout=30)

    assert run.returncode == 1
    assert "ROS parameter /no_param/climb/frame has no value" in run.stderr
    assert "Traceback" not in run.stderr


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


@pytest.fixture(scope="module")
def catkin(graph: Any, write: Write, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A workspace of catkin in which all packages are built, without optimisation."""
    if (missing := missing_of_catkin()) is not None:
        pytest.skip(missing)
    folder = tmp_path_factory.mktemp("catkin")
    write(folder / "src", language="cpp")
    # A machine and the server that it calls, as the CPSwarm code generator was called for them.
    (folder / "lift.xml").write_text(SCXML, encoding="utf-8")
    (folder / "lift.json").write_text(json.dumps(ADF), encoding="utf-8")
    words = ["--scxml", f"{folder}/lift.xml", "--adf", f"{folder}/lift.json", "-o", f"{folder}/src"]
    assert swarmc(["codegen", "--env", "ROS", *words]) == 0
    make(graph, folder, "-O0", "all", "tests")
    return folder


def missing_of_catkin() -> str | None:
    """Why catkin cannot build C++ here; None where it can."""
    missing = next((path for path in _CATKIN if not Path(path).exists()), None)
    return f"no catkin for C++: {missing} is missing" if missing is not None else None


def make(graph: Any, folder: Path, optimisation: str, *targets: str) -> None:
    command = [
        *("catkin_make", "-C", str(folder), "-l99", "-DPYTHON_EXECUTABLE=/usr/bin/python3"),
        f"-DCMAKE_CXX_FLAGS={_CPP} {optimisation}",
        *targets,
    ]
    environment = {**graph.environment(), "HOME": str(graph.home), "PWD": str(folder)}
    del environment["ROS_DISTRO"]  # catkin_make finds another in Debian's setup
    run = subprocess.run(
        command, cwd=folder, env=environment, capture_output=True, text=True, check=False
    )
    assert run.returncode == 0, run.stdout[-3000:] + run.stderr[-3000:]


def cpp_commands(folder: Path) -> dict[str, list[str]]:
    return {name: [str(folder / "devel" / "lib" / name / f"{name}_node")] for name in NODES}


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
    assert "`climb_base.cpp` as a whole is made for this" in said


def test_cpp_tests_of_users_pass(graph: Any, catkin: Path) -> None:
    for name in NODES:
        run = subprocess.run(
            [catkin / "devel" / "lib" / name / f"{name}_test"],
            env=graph.environment(), capture_output=True, text=True, check=False,
        )  # fmt: skip
        assert run.returncode == 0, run.stdout
        assert "PASSED" in run.stdout


@pytest.mark.parametrize("optimisation", ["-O0", "-O2"])
def test_cpp_nodes_do_what_is_filled_in(
    graph: Any, catkin: Path, start: Any, optimisation: str
) -> None:
    for name in ("climb", "camera"):
        code = (HERE / "code" / f"{name}.cpp").read_text(encoding="utf-8")
        (catkin / "src" / name / "src" / f"{name}.cpp").write_text(code, encoding="utf-8")
    make(graph, catkin, optimisation, *(f"{name}_node" for name in NODES))

    assert start(cpp_commands(catkin), [])("filled") == {
        **FILLED,
        "raised": ["ABORTED", 0.0, "too high", []],
        "nothing": ["ABORTED", 0.0, "execute threw what is no std::exception", []],
    }


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
    assert "note: `implementation.py` is yours to fill in, for model.swarm:47:8" in said
