"""Connectors in launch files: which nodes are started, and under which names they find topics."""

from __future__ import annotations

import json
import re
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
import yaml
from lxml import etree

from swarmdsl.cli import run as swarmc
from swarmdsl.codegen.api import Support
from swarmdsl.codegen.registry import load

from .conftest import HERE, load_module

Emit = Callable[..., Any]
MODEL = HERE / "connected.swarm"
REMAPS = {
    "left": [("image", "left/image")],
    "right": [("image", "right/image")],
    "stereo": [("left", "left/image"), ("right", "right/image"), ("depth", "range/depth")],
    "memory": [("seen", "range/depth"), ("notes", "bus")],
}
PARTS = list(REMAPS)
launching = load_module("skeleton_launching", HERE.parent / "ros2" / "launching.py")


@pytest.fixture(scope="module")
def built(tmp_path_factory: pytest.TempPathFactory) -> Callable[[int], Path]:
    """The behaviours and the components of the model, built together for a generation of ROS."""

    def built(ros: int) -> Path:
        target = "smach" if ros == 1 else "ros2"
        folder = tmp_path_factory.mktemp(target)
        words = ["--target", target, "--target", "skeleton", "--option", f"skeleton.ros={ros}"]
        assert swarmc(["build", str(MODEL), *words, "-o", str(folder)]) == 0
        return folder

    return built


@pytest.mark.parametrize(
    ("ros", "command"), [("1", "roslaunch"), ("2", "ros2 launch")], ids=["ros1", "ros2"]
)
def test_the_readme_draws_the_robots(ros: str, command: str, emit: Emit) -> None:
    files, _ = emit(MODEL, ros=ros)
    text = files["lab_bringup/README.md"].text

    assert f"| `{command} lab_bringup uav.launch" in text
    assert "`left` (camera), `right` (camera)" in text
    drawn = text.partition("## Member `Uav`\n\n```mermaid\n")[2].partition("```")[0]
    assert all(f"  {part}[" in drawn for part in PARTS)
    assert '  left -->|"image' in drawn


def test_a_launch_file_for_ros1(emit: Emit) -> None:
    files, complaints = emit(MODEL)
    assert complaints == []
    root = etree.fromstring(files["lab_bringup/launch/uav.launch"].text.encode())

    nodes = {node.get("name"): node for node in root.iter("node")}
    assert list(nodes) == PARTS
    for name, node in nodes.items():
        remaps = [(remap.get("from"), remap.get("to")) for remap in node.iter("remap")]
        assert remaps == REMAPS[name], name
    assert (nodes["right"].get("pkg"), nodes["right"].get("type")) == ("camera", "camera_node")
    assert yaml.safe_load(files["lab_bringup/param/uav.yaml"].text) == {
        "left": {"rate": 2.0},
        "right": {"rate": 4.0},
    }
    manifest = etree.fromstring(files["lab_bringup/package.xml"].text.encode())
    assert [each.text for each in manifest.iter("exec_depend")] == [
        *("roslaunch", "camera", "memory", "stereo"),
    ]


def test_only_what_is_written_is_started(emit: Emit) -> None:
    files, complaints = emit(MODEL, only="Camera")
    assert complaints == []
    root = etree.fromstring(files["lab_bringup/launch/uav.launch"].text.encode())
    assert [node.get("name") for node in root.iter("node")] == ["left", "right"]

    function = 'function beep : swarm { service "beep" : std_srvs/Empty }'
    files, complaints = emit(function)
    assert complaints == []
    assert not any("bringup" in path for path in files)

    # Launch files of behaviours start the package, whatever is in it.
    for ros in ("1", "2"):
        model = f"{MODEL.read_text(encoding='utf-8')}\n{function}\n"
        files, complaints = emit(model, only="beep", ros=ros)
        assert complaints == []
        assert "camera/package.xml" not in files
    assert "PARTS = [\n]" in files["lab_bringup/launch/uav.launch.py"].text


BETWEEN = """
swarm event Found : std_msgs/Empty
sensor Camera { out seen : std_msgs/Empty on "found" }
controller Pilot { in seen : std_msgs/Empty; in told : std_msgs/Empty on "bridge/events/found" }
member Uav {
  behavior Wait
  eye   : Camera
  pilot : Pilot
  connect eye.seen -> pilot.seen
}
"""


def test_what_no_bridge_takes_to_other_robots(emit: Emit) -> None:
    _, complaints = emit(BETWEEN + REST, ros="2")
    said = [(each.name, each.message) for each in complaints]
    port = "target `skeleton` cannot represent a port between robots, `{}` on `{}`".format
    assert said == [
        ("no-place", port("eye.seen", "found")),
        ("no-place", port("pilot.told", "bridge/events/found")),
    ]
    assert emit(BETWEEN + REST)[1] == []


TIED = """
sensor Camera { out image : bool }
controller Stereo { in left : bool; in right : bool; out seen : bool on "left" }
actuator Lamp { in light : bool }
member Uav {
  behavior Wait
  eye    : Camera
  other  : Camera
  stereo : Stereo
  lamp   : Lamp
  connect eye.image   -> stereo.right
  connect other.image -> stereo.left
  connect stereo.seen -> lamp.light
}
"""
THROUGH = """
controller Relay { in data : bool }
member Uav {
  behavior Wait
  in  first  : bool
  in  second : bool
  out third  : bool
  relay : Relay
  connect first  -> third
  connect second -> relay.data
}
"""
REST = """
event Go : std_msgs/Empty
statemachine Wait { initial A; state A { on Go -> B } final B }
swarm Search { uav : Uav }
"""


@pytest.mark.parametrize("target", ["skeleton", "smach", "ros2"])
@pytest.mark.parametrize(
    ("model", "line", "message"),
    [
        (TIED, 12, "a connector that separates `stereo.left` from `stereo.seen`"),
        (THROUGH, 8, "a connection of the member's ports `first` and `third`"),
    ],
)
def test_what_no_remapping_can_connect(
    target: str,
    model: str,
    line: int,
    message: str,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
) -> None:
    path = tmp_path / "lab.swarm"
    path.write_text(model.lstrip() + REST, encoding="utf-8")
    words = ["--target", target, "-o", str(tmp_path / "out"), "--format", "concise"]

    assert swarmc(["build", str(path), *words]) == 1
    said = capsys.readouterr()
    (error,) = [each for each in (said.out + said.err).splitlines() if "SW0903" in each]
    assert f"lab.swarm:{line}:" in error
    assert f"target `{target}` cannot express {message}" in error


def test_the_table_is_true(emit: Emit) -> None:
    """Output contains what `swarmc targets skeleton` names for each construct."""
    made, _ = emit(MODEL)
    functions, _ = emit()
    text = "\n".join(file.text for file in (*made.values(), *functions.values()))
    for mapped in load("skeleton").mapping:
        if mapped.support is Support.EXACT:
            words = re.findall("`([^`]*)`", mapped.means)
            assert words
            assert all(word in text for word in words), mapped.means


def test_launch_files_for_ros2(
    built: Callable[[int], Path], monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = built(2)
    behavior = folder / "ros2" / "lab_behavior"
    packages = {"lab_behavior": behavior}
    path = behavior / "launch" / "search.launch.py"

    def launch(**arguments: str) -> list[dict[str, Any]]:
        made: list[dict[str, Any]] = launching.launch(
            path, packages, monkeypatch.setitem, **arguments
        )
        return made

    alone = [(node["namespace"], node["name"]) for node in launch()]
    assert alone == [(f"/search/uav_{n}", m) for n in (0, 1) for m in ("fly", "memory_behavior")]

    packages |= {path.name: path for path in (folder / "skeleton").iterdir()}
    assert len(launch(components="false")) == len(alone)
    nodes = {(node["namespace"], node["name"]): node for node in launch(use_sim_time="true")}
    assert nodes.keys() == {*alone, *((f"/search/uav_{n}", part) for n in (0, 1) for part in PARTS)}
    for name, remaps in REMAPS.items():
        node = nodes["/search/uav_1", name]
        assert node["remappings"] == remaps
        assert (node["package"], node["executable"]) in {
            ("camera", "camera_node"), ("stereo", "stereo_node"), ("memory", "memory_node")
        }  # fmt: skip
        first, *files = node["parameters"]
        assert first == {"use_sim_time": True}
        read = [yaml.safe_load(Path(file).read_text(encoding="utf-8")) for file in files]
        assert read[-1] == {"/**": {"ros__parameters": {}}}
        if name == "right":
            assert read[0] == {"/**": {"ros__parameters": {"rate": 1.0}}}
            assert read[1]["/**/right"] == {"ros__parameters": {"rate": 4.0}}
    # A file that is asked for and is not there is for ROS to tell of.
    path = packages["lab_bringup"] / "launch" / "uav.launch.py"
    for node in launching.launch(path, packages, monkeypatch.setitem, params_file="/no.yaml"):
        assert node["parameters"][-1] == "/no.yaml"
    # The behaviour of a part hears what the part hears.
    assert nodes["/search/uav_0", "memory_behavior"]["remappings"] == REMAPS["memory"]
    assert nodes["/search/uav_0", "fly"]["remappings"] is None


# Under a master of ROS 1.

CAMERA = """
import rospy
from camera.base import CameraBase


class Camera(CameraBase):
    def start(self):
        super().start()
        rospy.Timer(rospy.Duration(0.05), self.see)

    def see(self, event):
        self.outputs.image.publish(self.parameters.rate)
"""
STEREO = """
from stereo.base import StereoBase


class Stereo(StereoBase):
    def on_left(self, message):
        if self.inputs.right is not None:
            self.outputs.depth.publish(message.data * 10 + self.inputs.right.data)
"""
READ = """
import json
from roslaunch import rlutil
from roslaunch.config import ROSLaunchConfig
from roslaunch.xmlloader import XmlLoader
(file,) = rlutil.resolve_launch_arguments(['lab_behavior', 'search.launch'])
found = []
for words in ([], ['components:=false']):
    config = ROSLaunchConfig()
    XmlLoader().load(file, config, argv=words, verbose=False)
    nodes = {node.namespace + node.name: node.remap_args for node in config.nodes}
    params = {name: param.value for name, param in config.params.items()}
    found.append({'nodes': nodes, 'params': params})
print(json.dumps(found))
"""
HEAR = """
import sys
import rospy
from std_msgs.msg import Float64
rospy.init_node('witness')
print(rospy.wait_for_message(sys.argv[1], Float64, 30).data)
"""


@pytest.fixture(scope="module")
def launch(graph: Any, built: Callable[[int], Path]) -> Callable[..., list[str]]:
    """A command of roslaunch, and the environment in which it finds the packages."""
    if not Path("/usr/bin/roslaunch").exists():
        pytest.skip("no roslaunch: apt-get install python3-roslaunch")
    folder = built(1)
    for name, code in (("camera", CAMERA), ("stereo", STEREO)):
        path = folder / "skeleton" / name / "src" / name / "implementation.py"
        path.write_text(code, encoding="utf-8")
    modules = [*(folder / "skeleton").glob("*/src"), *(folder / "smach").glob("*/src")]
    environment = graph.environment(
        modules, ROS_PACKAGE_PATH=f"{folder / 'skeleton'}:{folder / 'smach'}"
    )

    def launch(*words: str, **options: Any) -> Any:
        command = [graph.python, *words]
        if options:
            return graph.start(command, env=environment, **options)
        run = subprocess.run(
            command, env=environment, capture_output=True, text=True, timeout=60, check=False
        )
        assert run.returncode == 0, run.stdout + run.stderr
        return run.stdout

    return launch


def test_roslaunch_reads_the_launch_files(launch: Callable[..., Any]) -> None:
    """They are built together, so that the components are started with the behaviours."""
    together, alone = json.loads(launch("-c", READ))
    names = [*PARTS, "fly", "memory_behavior"]
    assert sorted(together["nodes"]) == sorted(f"/uav_{n}/{each}" for n in (0, 1) for each in names)
    assert together["nodes"]["/uav_1/stereo"] == [list(remap) for remap in REMAPS["stereo"]]
    # The behaviour of a part hears what the part hears.
    assert alone["nodes"]["/uav_1/memory_behavior"] == [list(remap) for remap in REMAPS["memory"]]
    assert sorted(alone["nodes"]) == sorted(
        f"/uav_{n}/{each}" for n in (0, 1) for each in names[4:]
    )
    assert together["params"]["/uav_0/left/rate"] == 2.0
    assert together["params"]["/uav_1/right/rate"] == 4.0


def test_roslaunch_without_the_package_of_the_components(
    graph: Any, built: Callable[[int], Path]
) -> None:
    if not Path("/usr/bin/roslaunch").exists():
        pytest.skip("no roslaunch: apt-get install python3-roslaunch")
    environment = graph.environment([], ROS_PACKAGE_PATH=str(built(1) / "smach"))
    command = [graph.python, "/usr/bin/roslaunch", "--nodes", "lab_behavior", "search.launch"]

    def nodes(*words: str) -> tuple[int, list[str], str]:
        run = subprocess.run(
            [*command, *words], env=environment, capture_output=True, text=True, check=False
        )
        return run.returncode, run.stdout.split(), run.stderr

    code, _, said = nodes()
    assert (code, "Resource not found: lab_bringup" in said) == (1, True)
    wanted = [f"/uav_{n}/{each}" for n in (0, 1) for each in ("fly", "memory_behavior")]
    assert nodes("components:=false")[:2] == (0, wanted)


def test_a_message_goes_through_connectors(graph: Any, launch: Callable[..., Any]) -> None:
    """Each camera's messages reach one port, and the result leaves the robot."""
    started = launch(
        "/usr/bin/roslaunch", "lab_bringup", "uav.launch", "name:=seeing", output="bringup"
    )
    try:
        heard = launch("-c", HEAR, "/seeing/range/depth")
    finally:
        graph.end(started)
    assert json.loads(heard) == 24.0, graph.printed("bringup")
