"""Skeletons for ROS 2: those in Python on the real rclpy, those in C++ against stubs.

rclcpp is in no package registry. What C++ skeletons use of it stands in `stubs`, with its
signatures and with the states of a goal, so that a compiler reads the code and goals run.
"""

from __future__ import annotations

import json
import os
import shutil
import signal
import subprocess
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import pytest

from swarmdsl.cli import run as swarmc

from ..ros2.domains import free_domain
from ..ros2.installed import installed
from .conftest import MODEL, load_module

HERE = Path(__file__).parent
NODES = ("climb", "beep", "camera")
ROS2 = HERE.parent / "ros2"

Write = Callable[..., Any]
pytestmark = pytest.mark.timeout(900)  # interfaces are built


@pytest.fixture(scope="module")
def cpp(write: Write, tmp_path_factory: pytest.TempPathFactory) -> Path:
    if shutil.which("g++") is None:
        pytest.skip("no g++: apt-get install g++")
    folder = tmp_path_factory.mktemp("rclcpp")
    write(folder, ros="2", language="cpp")
    return folder


def compiled(sources: list[Path], package: Path, *more: object) -> str:
    command = ["g++", "-std=c++17", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-pthread"]
    command += [f"-I{package / 'include'}", f"-I{HERE / 'stubs'}", *map(str, (*more, *sources))]
    run = subprocess.run(command, capture_output=True, text=True, check=False)
    return run.stderr


@pytest.mark.parametrize("name", NODES)
def test_cpp_compiles_against_stubs(cpp: Path, name: str) -> None:
    sources = sorted((cpp / name / "src").glob("*.cpp"))

    assert len(sources) == 3
    assert compiled(sources, cpp / name, "-fsyntax-only") == ""


def test_cpp_goals_end_on_stubs(cpp: Path, tmp_path: Path) -> None:
    """Optimised: the compiler warns most then."""
    sources = [
        cpp / "climb" / "src" / "climb_base.cpp",
        *((HERE / "code" / "ros2" / name) for name in ("climb.cpp", "drive.cpp")),
    ]
    program = tmp_path / "drive"
    assert compiled(sources, cpp / "climb", "-O2", "-o", program) == ""
    run = subprocess.run([program], capture_output=True, text=True, timeout=60, check=True)

    assert run.stdout.splitlines() == [
        "parameter 'frame' is not initialized",
        "reached succeeded 1.1",
        "raised aborted 0",
        "nothing aborted 0",
        "cancelled canceled 0",
        "replaced aborted 0",
        "newer succeeded 1.1",
        "early canceled 0",
        "ended 1",
        "stopped aborted 0",
    ]


# A climb whose goal never ends, and the signal during it.
NEVER = """
#include <thread>
#include "climb/climb.hpp"
namespace climb
{
Climb::Outcome Climb::execute(const Goal &, Result &, std::string &)
{
  std::this_thread::sleep_for(std::chrono::hours(1));
  return Outcome::succeeded;
}
void Climb::on_state(const demo::msg::Sample &) {}
}
void rclcpp::executors::MultiThreadedExecutor::spin()
{
  using Goal = rclcpp_action::ServerGoalHandle<demo::action::Climb>;
  std::static_pointer_cast<rclcpp_action::Server<demo::action::Climb>>(
    node->actions.at("cmd/climb"))->accepted(std::make_shared<Goal>(demo::action::Climb::Goal()));
  rclcpp::shutdown();
}
"""


def test_cpp_node_ends_although_its_goal_does_not_on_stubs(cpp: Path, tmp_path: Path) -> None:
    node = (cpp / "climb" / "src" / "climb_node.cpp").read_text(encoding="utf-8")
    (tmp_path / "node.cpp").write_text(node.replace("LATE{20}", "LATE{1}"), encoding="utf-8")
    base = (cpp / "climb" / "src" / "climb_base.cpp").read_text(encoding="utf-8")
    # Its parameter is needed.
    base = base.replace('"frame", described', '"frame", std::string(), described')
    (tmp_path / "base.cpp").write_text(base, encoding="utf-8")
    (tmp_path / "climb.cpp").write_text(NEVER, encoding="utf-8")
    sources = [tmp_path / f"{name}.cpp" for name in ("node", "base", "climb")]
    assert compiled(sources, cpp / "climb", "-o", tmp_path / "node") == ""
    run = subprocess.run(
        [tmp_path / "node"], capture_output=True, text=True, timeout=60, check=False
    )

    assert (run.returncode, run.stderr) == (1, "the node does not end, and is killed\n")


def test_cpp_service_that_fails_is_withdrawn_on_stubs(cpp: Path, tmp_path: Path) -> None:
    sources = [*(cpp / "camera" / "src" / f"camera{part}.cpp" for part in ("", "_base"))]
    sources.append(HERE / "code" / "ros2" / "request.cpp")
    program = tmp_path / "request"
    assert compiled(sources, cpp / "camera", "-o", program) == ""
    run = subprocess.run([program], capture_output=True, text=True, timeout=60, check=True)

    assert run.stdout.splitlines() == ["offered", "0 responses", "withdrawn", "offered"]
    wanted = "Camera.snap is not implemented; the service is withdrawn for 10 s\n"
    assert run.stderr == wanted


@pytest.fixture(scope="module")
def ros2(
    write: Write, tmp_path_factory: pytest.TempPathFactory
) -> Iterator[tuple[Path, dict[str, str]]]:
    """The Python of an environment with ROS 2, and the variables with the interfaces built."""
    given = installed()
    environment = load_module("skeleton_environment", ROS2 / "environment.py")
    folder = tmp_path_factory.mktemp("interfaces")
    (folder / "venv").symlink_to(given / "venv")
    write(folder / "made", ros="2")
    (folder / "ws" / "src").mkdir(parents=True)
    shutil.copytree(folder / "made" / "demo", folder / "ws" / "src" / "demo")
    environment.build(folder, "demo")
    harness = load_module("skeleton_harness", ROS2 / "harness.py")
    with free_domain() as domain:
        ros = harness.Ros(folder, [], domain, folder)
        yield ros.python, {**ros.environment, "ROS_LOG_DIR": str(folder / "log")}


@pytest.fixture
def start(ros2: tuple[Path, dict[str, str]], tmp_path: Path) -> Iterator[Any]:
    """Start the nodes below a folder in a namespace of their own, and ask them from a client."""
    python, variables = ros2
    running: list[subprocess.Popen[bytes]] = []
    log = tmp_path / "log.txt"

    def start(folder: Path) -> Callable[..., Any]:
        path = os.pathsep.join([*(str(folder / name) for name in NODES), variables["PYTHONPATH"]])
        environment = {**variables, "PYTHONPATH": path}
        for name in NODES:
            command = [python, "-m", f"{name}.node", "--ros-args", "-p", "frame:=map"]
            with log.open("ab") as file:
                running.append(subprocess.Popen(command, env=environment, stderr=file, stdout=file))

        def ask(what: str, *stopped: str) -> Any:
            processes = (str(running[NODES.index(name)].pid) for name in stopped)
            run = subprocess.run(
                [python, HERE / "client_ros2.py", what, *processes],
                env=environment, capture_output=True, text=True, timeout=200, check=False,
            )  # fmt: skip
            assert run.returncode == 0, run.stderr + log.read_text()
            return json.loads(run.stdout.splitlines()[-1])

        return ask

    yield start
    ends = []
    for process in running:
        process.send_signal(signal.SIGTERM)
    for process in running:
        try:
            ends.append(process.wait(60))
        except subprocess.TimeoutExpired:
            process.kill()
            ends.append(process.wait())
    said = log.read_text()
    assert set(ends) <= {0}, said
    assert "never retrieved" not in said


def test_python_skeletons_end_each_goal(write: Write, start: Any, tmp_path: Path) -> None:
    write(tmp_path / "src", ros="2")

    assert start(tmp_path / "src")("skeletons") == {
        "beep": {"success": False, "message": "beep is not implemented"},
        "snap": None,
        "goal": ["ABORTED", 0.0, []],
    }


def test_a_goal_has_a_result_when_its_node_is_stopped(
    write: Write, start: Any, tmp_path: Path
) -> None:
    write(tmp_path / "src", ros="2")
    code = HERE / "code" / "ros2" / "climb.py"
    shutil.copy(code, tmp_path / "src" / "climb" / "climb" / "implementation.py")

    assert start(tmp_path / "src")("stopped", "climb") == ["ABORTED", 0.0]
    assert "Traceback" not in (tmp_path / "log.txt").read_text()


# A signal shuts ROS down, and may do so without waking who waits: here it does not.
TOLD_TO_STOP = """
import sys, threading
import beep.node
import rclpy
works = threading.Event()
class Executor(beep.node.MultiThreadedExecutor):
    def spin_once(self, **options):
        works.set()
        super().spin_once(**options)
beep.node.MultiThreadedExecutor = Executor
def stop():
    with rclpy.get_default_context().handle:
        rclpy.get_default_context().handle.shutdown()
def stop_later():
    works.wait()
    assert rclpy.ok()
    stop()
if sys.argv[1] == 'begun':
    threading.Thread(target=stop_later, daemon=True).start()
else:
    init = rclpy.init
    rclpy.init = lambda **options: (init(**options), stop())
beep.node.main()
"""


@pytest.mark.parametrize("when", ["begun", "not begun"])
def test_a_node_ends_whenever_it_is_told_to(
    write: Write, ros2: tuple[Path, dict[str, str]], tmp_path: Path, when: str
) -> None:
    write(tmp_path, ros="2")
    python, variables = ros2
    path = os.pathsep.join([str(tmp_path / "beep"), variables["PYTHONPATH"]])
    run = subprocess.run(
        [python, "-c", TOLD_TO_STOP, when],
        env={**variables, "PYTHONPATH": path},
        capture_output=True, text=True, timeout=60, check=False,
    )  # fmt: skip
    assert (run.returncode, run.stderr) == (0, "")


# A node that takes a while to begin, and is told to stop in the middle of it.
SLOW_TO_BEGIN = """
import os, signal, sys, time
import beep.node
import rclpy
def begin():
    os.kill(os.getpid(), getattr(signal, sys.argv[1]))
    while rclpy.ok():
        time.sleep(0.01)
beep.node.Beep = begin
beep.node.main()
"""


@pytest.mark.parametrize("number", ["SIGINT", "SIGTERM"])
def test_a_node_ends_when_it_is_told_to_while_it_begins(
    write: Write, ros2: tuple[Path, dict[str, str]], tmp_path: Path, number: str
) -> None:
    write(tmp_path, ros="2")
    python, variables = ros2
    path = os.pathsep.join([str(tmp_path / "beep"), variables["PYTHONPATH"]])
    run = subprocess.run(
        [python, "-c", SLOW_TO_BEGIN, number],
        env={**variables, "PYTHONPATH": path},
        capture_output=True, text=True, timeout=60, check=False,
    )  # fmt: skip
    assert (run.returncode, run.stderr) == (0, "")


# A node that is told to stop, in which WHAT hangs.
HANGING = """
import ctypes, os, signal, time
import beep.node
import rclpy
from rclpy.node import Node
def hang(*_, **more):
    os.kill(os.getpid(), signal.SIGTERM)
    {hang}
class Beep(beep.node.Beep):
    def __init__(self):
        super().__init__()
        self.create_timer(0.01, self.look)
    def look(self):
        os.kill(os.getpid(), signal.SIGTERM)
beep.node.LATE = 3.0
beep.node.Beep = Beep
{what} = hang
beep.node.main()
"""
FREE = "time.sleep(10**6)"
HELD = "ctypes.PyDLL(None).sleep(10**6)"


@pytest.mark.parametrize(
    ("what", "hang", "code"),
    [
        ("Beep.look", FREE, 0),
        ("Node.__init__", FREE, 1),
        ("Node.destroy_node", FREE, 1),
        ("Node.destroy_node", HELD, 1),
        ("rclpy.try_shutdown", HELD, 1),
    ],
    ids=["callback", "start", "free", "held", "shutdown"],
)
def test_a_node_ends_although_something_hangs(
    write: Write, ros2: tuple[Path, dict[str, str]], tmp_path: Path, what: str, hang: str, code: int
) -> None:
    write(tmp_path, ros="2")
    python, variables = ros2
    path = os.pathsep.join([str(tmp_path / "beep"), variables["PYTHONPATH"]])
    run = subprocess.run(
        [python, "-c", HANGING.format(what=what, hang=hang)],
        env={**variables, "PYTHONPATH": path},
        capture_output=True, text=True, timeout=60, check=False,
    )  # fmt: skip
    assert run.returncode == code, run.stderr
    assert ("in hang" in run.stderr) == (code == 1)


def test_python_nodes_do_what_is_filled_in(write: Write, start: Any, tmp_path: Path) -> None:
    write(tmp_path / "src", ros="2")
    for name in ("climb", "camera"):
        code = HERE / "code" / "ros2" / f"{name}.py"
        shutil.copy(code, tmp_path / "src" / name / name / "implementation.py")

    assert start(tmp_path / "src")("filled") == {
        "beep": {"success": False, "message": "beep is not implemented"},
        "snap": {"stored": True},
        "zoomed": {"stored": False},
        "stumbled": None,
        "seen": [0.5],
        "position": 7,
        "reached": ["SUCCEEDED", 1.1, [0.5]],
        "replaced": ["ABORTED", 0.0],
        "raised": ["ABORTED", 0.0, []],
        "cancelled": ["CANCELED", 0.0, []],
        "nothing": ["ABORTED", 0.0, []],
        "wrong": ["ABORTED", 0.0, []],
    }


def test_python_tests_of_users_pass(
    ros2: tuple[Path, dict[str, str]], write: Write, tmp_path: Path
) -> None:
    python, variables = ros2
    write(tmp_path, ros="2")
    for name in NODES:
        path = os.pathsep.join([str(tmp_path / name), variables["PYTHONPATH"]])
        command = [python, "-m", "pytest", "-q", "-p", "no:cacheprovider", tmp_path / name / "test"]
        run = subprocess.run(
            command, cwd=tmp_path, env={**variables, "PYTHONPATH": path},
            capture_output=True, text=True, check=False,
        )  # fmt: skip
        assert run.returncode == 0, run.stdout


def test_a_node_without_a_needed_param_says_so(
    ros2: tuple[Path, dict[str, str]], write: Write, tmp_path: Path
) -> None:
    python, variables = ros2
    write(tmp_path, ros="2")
    path = os.pathsep.join([str(tmp_path / "climb"), variables["PYTHONPATH"]])
    run = subprocess.run(
        [python, "-m", "climb.node"], env={**variables, "PYTHONPATH": path},
        capture_output=True, text=True, timeout=60, check=False,
    )  # fmt: skip

    assert run.returncode == 1
    assert "frame" in run.stderr
    assert "Traceback" not in run.stderr


CAMERA = """
from camera.base import CameraBase
class Camera(CameraBase):
    def __init__(self, *words, **options):
        super().__init__(*words, **options)
        self.create_timer(0.05, self.see)
    def see(self):
        message = self.outputs.image.msg_type()
        message.data = self.parameters.rate
        self.outputs.image.publish(message)
"""
STEREO = """
from stereo.base import StereoBase
class Stereo(StereoBase):
    def on_left(self, message):
        if self.inputs.right is not None:
            message.data = message.data * 10 + self.inputs.right.data
            self.outputs.depth.publish(message)
"""
WITNESS = """
import sys, rclpy, std_msgs.msg
rclpy.init()
node = rclpy.create_node('witness')
heard = []
node.create_subscription(std_msgs.msg.Float64, sys.argv[1], heard.append, 10)
while not heard:
    rclpy.spin_once(node)
print(heard[0].data)
"""


def test_a_message_goes_through_connectors(
    write: Write, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The nodes run with the names and remappings that the launch file gives them."""
    given = installed()
    made = tmp_path / "src"
    write(made, model=HERE / "connected.swarm", ros="2")
    for name, code in (("camera", CAMERA), ("stereo", STEREO)):
        (made / name / name / "implementation.py").write_text(code, encoding="utf-8")
    launching = load_module("skeleton_launching", ROS2 / "launching.py")
    packages = {path.name: path for path in made.iterdir()}
    path = made / "lab_bringup" / "launch" / "uav.launch.py"
    nodes = launching.launch(path, packages, monkeypatch.setitem, namespace="seeing")
    harness = load_module("skeleton_harness", ROS2 / "harness.py")
    with ExitStack() as stack:
        domain = stack.enter_context(free_domain())
        ros = harness.Ros(given, [made / "camera", made / "stereo"], domain, tmp_path)
        stack.callback(ros.close)
        for node in nodes:
            if node["package"] != "memory":
                ros.start("-m", f"{node['package']}.node", "--ros-args", *_as_arguments(node))
        witness = ros.start("-c", WITNESS, "/seeing/range/depth", stdout=subprocess.PIPE)
        assert witness.communicate(timeout=60)[0].split() == ["24.0"]


def _as_arguments(node: dict[str, Any]) -> Iterator[str]:
    """Yield the arguments with which launch would start a node."""
    yield from ("-r", f"__ns:={node['namespace']}", "-r", f"__node:={node['name']}")
    for name, topic in node["remappings"]:
        yield from ("-r", f"{name}:={topic}")
    for file in node["parameters"][1:]:
        yield from ("--params-file", str(file))


GREETING = """package greeting
function bow : abstraction { service "bow" : std_srvs/Empty }
statemachine Greet {
  initial Bowing
  state Bowing {
    do bow
    on succeeded -> Done
    on aborted   -> Failed
  }
  final Done
  final Failed
}
member Robot { behavior Greet }
"""
# The service is offered again after its failure, and fails again.
BOW = """
import bow.base
import bow.node
bow.base.WITHDRAWN = 2.0
bow.node.main()
"""


def test_a_robot_does_not_take_for_done_what_is_not_implemented(tmp_path: Path) -> None:
    """The response `std_srvs/Empty` has no field that could say so."""
    given = installed()
    model = tmp_path / "greeting.swarm"
    model.write_text(GREETING, encoding="utf-8")
    words = ["--target", "ros2", "--target", "skeleton", "--option", "skeleton.ros=2"]
    assert swarmc(["build", str(model), *words, "-o", str(tmp_path / "src")]) == 0
    harness = load_module("skeleton_harness", ROS2 / "harness.py")
    packages = [tmp_path / "src" / "ros2" / "greeting_behavior"]
    packages.append(tmp_path / "src" / "skeleton" / "bow")
    with ExitStack() as stack:
        ros = harness.Ros(given, packages, stack.enter_context(free_domain()), tmp_path)
        stack.callback(ros.close)
        ros.start("-c", BOW)
        for _ in range(2):
            node = ros.node("greeting_behavior.greet", timeouts__server=1.0)
            assert node.exit_code() == 0
            assert node.trace[-1]["event"] == "do.Bowing.aborted", node.log


HOOK = """
from camera.base import CameraBase
class Camera(CameraBase):
    def on_exposure(self, message):
        raise ValueError('too bright')
"""
HEAR = """
import rclpy, std_msgs.msg
from camera.implementation import Camera
rclpy.init()
Camera()._hear_exposure(std_msgs.msg.Float64())
"""


def test_a_log_of_rclpy_leads_to_the_model(
    ros2: tuple[Path, dict[str, str]],
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capfdbinary: pytest.CaptureFixture[bytes],
) -> None:
    python, variables = ros2
    monkeypatch.chdir(tmp_path)
    shutil.copy(MODEL, tmp_path)
    options = ["--option", "skeleton.ros=2", "-o", "src"]
    assert swarmc(["build", MODEL.name, "--target", "skeleton", *options]) == 0
    camera = tmp_path / "src" / "skeleton" / "camera"
    (camera / "camera" / "implementation.py").write_text(HOOK, encoding="utf-8")
    environment = {
        **variables,
        "PYTHONPATH": os.pathsep.join([str(camera), variables["PYTHONPATH"]]),
        "RCUTILS_CONSOLE_OUTPUT_FORMAT": "[{severity}] ({file_name}:{line_number}): {message}",
    }
    run = subprocess.run(
        [python, "-c", HEAR], env=environment, capture_output=True, timeout=60, check=True
    )
    (tmp_path / "node.log").write_bytes(run.stderr)
    capfdbinary.readouterr()

    assert swarmc(["trace", "node.log"]) == 0
    first, place, *said = capfdbinary.readouterr().out.decode().splitlines()
    assert first.startswith("[ERROR] (")
    assert place == "  --> model.swarm:48:9"
    assert said[1] == '48 |   in    exposure : float64 on "exposure"'
    # Once for the place that has logged it, once for the frame of the traceback.
    assert said.count("  --> model.swarm:48:9") == 1
    assert "ValueError: too bright" in said
