"""The text of skeletons: valid, neat, complete; and what no skeleton can be made of."""

from __future__ import annotations

import ast
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
import yaml
from lxml import etree

Emit = Callable[..., Any]

VARIANTS = [("1", "python"), ("1", "cpp"), ("2", "python"), ("2", "cpp")]
CANNOT = "target `skeleton` cannot express "
NO_NAME = "target `skeleton` cannot use "
ACTION = "action a/A { goal { x : int32 } }\n"


@pytest.fixture(params=VARIANTS, ids="-".join)
def variant(request: pytest.FixtureRequest) -> dict[str, str]:
    """A generation of ROS, and a language."""
    ros, language = request.param
    return {"ros": ros, "language": language}


def test_each_node_has_a_package(emit: Emit, variant: dict[str, str]) -> None:
    files, complaints = emit(**variant)

    assert complaints == []
    assert {path.partition("/")[0] for path in files} == {"climb", "beep", "camera", "demo"}
    for package in ("climb", "beep", "camera"):
        names = [path for path in files if path.startswith(f"{package}/")]
        assert f"{package}/package.xml" in names
        assert any("launch" in name for name in names)
        assert any(name.startswith(f"{package}/test/") for name in names)


def test_a_user_owns_what_there_is_to_fill_in(emit: Emit) -> None:
    def kept(**variant: str) -> list[str]:
        files, _ = emit(only="climb", **variant)
        return [path for path, file in files.items() if file.keep]

    assert kept(language="python") == [
        "climb/src/climb/implementation.py",
        "climb/test/test_climb.py",
    ]
    assert kept(language="cpp") == [
        "climb/include/climb/climb.h",
        "climb/src/climb.cpp",
        "climb/test/climb_test.cpp",
    ]


def test_interfaces(emit: Emit) -> None:
    files, _ = emit()

    assert files["demo/action/Climb.action"].text == (
        "# Climb to a height.\n# How high, in metres.\nfloat64 height\n"
        "---\nfloat64 reached\n---\nfloat64 now\n"
    )
    assert files["demo/msg/Sample.msg"].text == (
        "time at\n# At most 4 elements.\nfloat32[] value\nint32 code\n"
    )
    assert files["demo/srv/CameraSnap.srv"].text == (
        "# Take a picture.\nfloat64 zoom\n---\nbool stored\n"
    )
    of_ros2, _ = emit(ros="2")
    assert of_ros2["demo/msg/Sample.msg"].text == (
        "builtin_interfaces/Time at\nfloat32[<=4] value\nint32 code\n"
    )
    text = of_ros2["demo/CMakeLists.txt"].text
    assert '  "action/Climb.action"\n' in text
    assert "DEPENDENCIES action_msgs builtin_interfaces" in text
    without, _ = emit(interfaces="false")
    assert files.keys() - without.keys() == {path for path in files if path.startswith("demo/")}


def test_manifests_and_launch_files_are_xml(emit: Emit, variant: dict[str, str]) -> None:
    files, _ = emit(**variant)
    for path, file in files.items():
        if path.endswith((".xml", ".launch")):
            etree.fromstring(file.text.encode())
    root = etree.fromstring(files["climb/package.xml"].text.encode())
    depends = {child.text for child in root if str(child.tag).endswith("depend")}
    assert {"demo"} <= depends
    assert "geometry_msgs" not in depends


def test_launch_files_say_what_the_model_says(emit: Emit, variant: dict[str, str]) -> None:
    files, _ = emit(**variant)
    end = ".launch" if variant["ros"] == "1" else ".launch.py"

    assert "Send the take-off command." in files[f"climb/launch/climb{end}"].text


def test_functions_are_launched_as_those_of_libraries_are(emit: Emit) -> None:
    files, _ = emit()

    def arguments(name: str) -> dict[str, str]:
        root = etree.fromstring(files[f"{name}/launch/{name}.launch"].text.encode())
        return {arg.attrib["name"]: arg.attrib["default"] for arg in root.iter("arg")}

    assert arguments("beep") == {"id": "1", "name": "beep_$(arg id)", "output": "screen"}
    assert arguments("camera") == {
        "name": "camera",
        "output": "screen",
        "param": "$(find camera)/param/camera.yaml",
    }


EVIL = r"""package demo
/// a --- b --> c -
/// </launch> ''' \""" \
///
/// # d
function f_x : swarm {
  service "x" : std_srvs/Empty
  /// a --- b --> c -
  /// </launch> ''' \""" \
  param p : int32 = 1
}
"""


def test_documentation_cannot_leave_its_comment(emit: Emit, variant: dict[str, str]) -> None:
    files, complaints = emit(EVIL, **variant)

    assert complaints == []
    for path, file in files.items():
        if path.endswith((".xml", ".launch")):
            etree.fromstring(file.text.encode())
        elif path.endswith(".py"):
            ast.parse(file.text)
        elif path.endswith(".yaml"):
            assert "'p': 1" in str(yaml.safe_load(file.text))


def test_params_are_documented_and_have_their_defaults(emit: Emit, variant: dict[str, str]) -> None:
    files, _ = emit(**variant)
    folder = "param" if variant["ros"] == "1" else "config"
    text = files[f"climb/{folder}/climb.yaml"].text
    values = yaml.safe_load(text)
    if variant["ros"] == "2":
        values = values["/**"]["ros__parameters"]
    assert values == {
        "tolerance": 0.1,
        "patience": 2.0,
        "steps": 3,
        "name": '100 % "quoted" \\',
        "slow": True,
    }
    assert type(yaml.safe_load(files[f"camera/{folder}/camera.yaml"].text).popitem()[1]) in (
        float,
        dict,
    )
    assert "# How near is near, in metres." in text
    assert "# frame: string, required" in text


def python_files(emit: Emit, ros: str) -> dict[str, str]:
    files, _ = emit(language="python", ros=ros)
    return {
        path: file.text
        for path, file in files.items()
        if path.endswith(".py") or path.startswith(("climb/scripts", "beep/scripts"))
    }


@pytest.mark.parametrize("ros", [ros for ros, language in VARIANTS if language == "python"])
def test_python_is_neat(emit: Emit, ros: str, tmp_path: Path) -> None:
    for name, text in python_files(emit, ros).items():
        ast.parse(text, feature_version=(3, 8) if ros == "1" else (3, 10))
        path = tmp_path / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    command = [sys.executable, "-m", "ruff", "check", "--isolated", "--no-cache"]
    rules = "E,F,W,B,PIE,RET,D2,D3,D4,D101,D103"
    # Of docstrings that say what the model does, in its lines.
    ignored = "D203,D205,D209,D212,D213,D301,D401,D406,D407,D413,E501"
    run = subprocess.run(
        [*command, "--select", rules, "--ignore", ignored, str(tmp_path)],
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert run.returncode == 0, run.stdout


def test_only_what_is_asked_for(emit: Emit) -> None:
    files, complaints = emit(only="beep, Camera")
    assert complaints == []
    assert {path.partition("/")[0] for path in files} == {"beep", "camera", "demo"}

    files, complaints = emit(only="bep")
    assert files == {}
    assert [found.message for found in complaints] == [
        "target `skeleton`: unknown function or component `bep`"
    ]


def test_what_a_library_has_is_not_written(emit: Emit) -> None:
    model = (
        "import cpswarm.functions.*\nstatemachine M { initial A; state A { do uav_mavros_land"
        "; on succeeded, aborted -> F } final F }\n"
    )
    assert emit(model)[0] == {}


def test_an_action_in_the_package_of_its_function_is_described_there(emit: Emit) -> None:
    """As the libraries of CPSwarm do it: nobody else describes it."""
    model = ACTION.replace("a/A", "lift_off/Go") + (
        'function lift_off : abstraction { action "cmd/go" : lift_off/Go }\n'
    )
    files, complaints = emit(model, language="cpp")

    assert complaints == []
    assert files["lift_off/action/Go.action"].text == "int32 x\n---\n---\n"
    text = files["lift_off/CMakeLists.txt"].text
    assert "add_action_files(\n  FILES\n  Go.action\n)" in text
    assert "generate_messages(DEPENDENCIES actionlib_msgs)" in text
    root = etree.fromstring(files["lift_off/package.xml"].text.encode())
    depends = [(child.tag, child.text) for child in root if str(child.tag).endswith("depend")]
    assert ("build_depend", "message_generation") in depends
    assert ("exec_depend", "message_runtime") in depends
    assert ("depend", "lift_off") not in depends


def test_a_package_of_interfaces_with_the_name_of_a_function_keeps_it(emit: Emit) -> None:
    model = (
        "package lift\naction Go { goal { x : int32 } }\n"
        'function lift : abstraction { action "cmd/go" : Go }\n'
    )
    files, complaints = emit(model)

    assert complaints == []
    assert "lift/action/Go.action" in files
    assert "lift_node/src/lift_node/implementation.py" in files


@pytest.mark.parametrize(
    ("model", "said"),
    [
        (
            'function go : abstraction { action "g" : go/Go }',
            CANNOT + "`go/Go`, which the model does not describe, in a package that it writes",
        ),
        (
            "sensor Cam { out o : float64[] }",
            CANNOT + "a topic of type `float64[]`, which is not a message",
        ),
        (
            ACTION + 'function go : abstraction { action "g" : a/A; param t : time }',
            CANNOT + "a param of type `time`",
        ),
        (
            ACTION + 'function go : abstraction { action "g" : a/A; param t : int64 = 3000000000 }',
            CANNOT + "a param of 3000000000",
        ),
        (
            ACTION + 'function copy : abstraction { action "g" : a/A }',
            NO_NAME + "`copy` as the name of a ROS package",
        ),
        (
            ACTION + 'function cam : abstraction { action "g" : a/A } sensor Cam { out o : bool }',
            NO_NAME + "`cam` as the package of both `cam` and `Cam`",
        ),
    ],
)
def test_what_no_skeleton_can_be_made_of_is_said(emit: Emit, model: str, said: str) -> None:
    files, complaints = emit(model)

    assert files == {}
    assert [found.message for found in complaints] == [said]
    assert complaints[0].primary is not None


@pytest.mark.parametrize(("ros", "bits"), [("1", 32), ("2", 64)])
def test_whole_numbers_that_no_parameter_holds(emit: Emit, ros: str, bits: int) -> None:
    greatest = 2 ** (bits - 1) - 1
    model = f"""
    package p
    sensor Gps {{
      out fixes : std_msgs/Empty
      param low : int64 = -{greatest} - 1
      param high : uint64 = {greatest}
      param real : float64 = {greatest + 1}
    }}
    member Uav {{ gps : Gps {{ high = {greatest} }} }}
    """

    assert emit(model, ros=ros)[1] == []
    (found,) = emit(model.replace(f"{{ high = {greatest}", f"{{ high = {greatest + 1}"), ros=ros)[1]
    assert found.message == f"{CANNOT}a param of {greatest + 1}"
    assert found.help == f"an integer parameter of ROS {ros} is at most {greatest}"


def test_words_of_cpp_are_no_fields(emit: Emit) -> None:
    model = "package p\naction A { goal { class : int32 } }\n"
    model += 'function f : swarm { action "a" : A }\n'

    assert [found.message for found in emit(model, language="cpp")[1]] == [
        NO_NAME + "`class` as the name of a field in C++"
    ]
    files, complaints = emit(model)
    assert complaints == []
    assert "goal.class_ : int32" in files["f/src/f/implementation.py"].text
