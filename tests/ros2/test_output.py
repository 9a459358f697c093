"""The text of generated packages: valid, as the linters of ROS 2 want it, complete."""

from __future__ import annotations

import ast
import re
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
import yaml
from lxml import etree

import swarmdsl.execution.engine
from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.codegen.api import OutputFile
from swarmdsl.codegen.options import parse_options
from swarmdsl.codegen.registry import load
from swarmdsl.driver import pipeline
from swarmdsl.execution.engine import Machine
from swarmdsl.execution.simulate.machines.table import table
from swarmdsl.ir import System

from .conftest import load_module

launching = load_module("launching")

Files = dict[str, OutputFile]
Generate = Callable[..., Files]

MODEL = '''
/// A lab with a "difficult" text \\\\ in it: """
package lab

struct Spot { x : float64, y : float32[<=4] }
/// What was seen.
message Seen {
  const FAR : uint8 = 3
  const WORD : string = "a \\"b\\" "
  /// where
  spot  : Spot
  poses : geometry_msgs/Pose[]
  near  : Spot[4]
  after : duration
  label : string<=5
}
service Ask { request { times : int32 } response { answer : string } }
action Look { goal { at : Spot, name : string } result { found : bool } feedback { spot : Spot } }
function ask   : abstraction { service "ask" : Ask }
function look  : abstraction { action "look" : Look }
function other : abstraction { action "other" : other_msgs/Look }
event Saw : Seen on "seen"
swarm event Done : other_msgs/Done

/// Looks "around" \\\\
/// and says so, LONG
statemachine Watch {
  /// LONG
  param name  : string = "it's"
  param limit : duration
  param small : uint8 = 3
  var spot  : Spot
  var spots : Spot[]
  var wide  : float64 = 2.0 * 3
  var found : bool
  initial Looking

  /// Look here \\\\ """
  state Looking {
    do look(at = spot, name = name) gives (found => found)
    on succeeded -> Asking
    on aborted [spot.x > 1 and wide < 3.0 and found and POWER > 12.5 and not found]
      / send Saw(spot = spot) -> Other
    on aborted -> Asking
    after limit -> Other
  }
  state Asking {
    do ask(by make_request) gives by take_answer
    on succeeded, aborted -> Other
  }
  state Other {
    do other
    on succeeded, aborted -> End
    on Saw [event.after > 1 s] / spot = event.spot, spots = spots -> Asking
    on Done [event.level > 3 or event.why == "x"] -> Asking
  }
  final End
}
member Eye { behavior Watch; param limit : duration = 1500 ms }
sensor Lens { behavior Watch; param limit : duration = 2 s }
member Head { eye : Lens { limit = 3 s } }
swarm Eyes { left : Eye[2..4]; head : Head }
'''.replace("LONG", "which takes more than one line" * 5).replace("POWER", "*".join(["wide"] * 4))
LINTERS = (
    *("--isolated", "--target-version", "py310", "--line-length", "99"),
    *("--select", "E,F,W,I,Q,D,A,C4,UP", "--ignore", "D100,D101,D102,D103,D104,D105,D106,D107"),
    *("--ignore", "D203,D212,D404,D413,D407,D406,A005"),
    *("--config", "lint.flake8-quotes.inline-quotes='single'"),
    *("--config", "lint.isort.force-sort-within-sections=true"),
    *("--config", "lint.isort.order-by-type=false"),
    *("--config", "lint.isort.case-sensitive=false"),
)
FORMAT = ("--isolated", "--line-length", "99", "--config", "format.quote-style='single'")


def write(files: Files, folder: Path) -> None:
    for path, file in files.items():
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        (folder / path).write_text(file.text, encoding="utf-8")


def ruff(*arguments: object) -> str:
    ran = subprocess.run(
        [sys.executable, "-m", "ruff", *map(str, arguments)],
        capture_output=True,
        text=True,
        check=False,
    )
    return "" if ran.returncode == 0 else ran.stdout + ran.stderr


# A machine that needs nothing of all that.
BARE = """
package bare
event Go : std_msgs/Empty
statemachine Wait {
  initial Idle
  state Idle { on Go -> Gone }
  final Gone
}
"""


@pytest.mark.parametrize("lifecycle", ["false", "true"])
@pytest.mark.parametrize("model", [MODEL, BARE], ids=["full", "bare"])
def test_linters_of_ros_find_nothing(
    generate: Generate, tmp_path: Path, model: str, lifecycle: str
) -> None:
    write(generate(model, lifecycle=lifecycle), tmp_path)

    assert ruff("check", *LINTERS, tmp_path) == ""
    assert ruff("format", "--check", *FORMAT, tmp_path) == ""


def test_python_of_humble_reads_it(generate: Generate) -> None:
    for path, file in generate(MODEL).items():
        if path.endswith(".py"):
            tree = ast.parse(file.text, path, feature_version=(3, 10))
            assert tree.body or not file.text.strip(), path


def test_the_manifest_has_all_that_is_needed(generate: Generate) -> None:
    files = generate(MODEL, license="MIT", maintainer="Ada", email="ada@example.org")
    root = etree.fromstring(files["lab_behavior/package.xml"].text.encode())

    assert root.get("format") == "3"
    assert root.findtext("license") == "MIT"
    assert root.find("maintainer").attrib == {"email": "ada@example.org"}  # type: ignore[union-attr]
    assert {each.text for each in root.findall("depend")} >= {
        "lab",
        "other_msgs",
        "rclpy",
        "std_msgs",
    }
    assert root.findtext("export/build_type") == "ament_python"


def test_interfaces_are_those_of_ros_2(generate: Generate) -> None:
    files = generate(MODEL)

    assert files["lab/msg/Seen.msg"].text == (
        "# What was seen.\n"
        "uint8 FAR=3\n"
        'string WORD="a \\"b\\" "\n'
        "# where\n"
        "Spot spot\n"
        "geometry_msgs/Pose[] poses\n"
        "Spot[4] near\n"
        "builtin_interfaces/Duration after\n"
        "string<=5 label\n"
    )
    root = etree.fromstring(files["lab/package.xml"].text.encode())
    assert root.findtext("member_of_group") == "rosidl_interface_packages"
    assert [each.text for each in root.findall("depend")] == [
        *("action_msgs", "builtin_interfaces", "geometry_msgs"),
    ]
    cmake = files["lab/CMakeLists.txt"].text
    assert '  "action/Look.action"\n' in cmake
    assert "find_package(geometry_msgs REQUIRED)\n" in cmake


def test_packages_of_others_are_written_by_names_that_ros_2_takes(generate: Generate) -> None:
    model = """
      package lab
      event Done : other_msgs/Done
      statemachine Wait { initial A; state A { on Done -> B } final B }
      message other_msgs/Done { theEnd : far_msgs/Place, at : near_msgs/at }
      message near_msgs/at { x : float64 }
      message far_msgs/Place { x : float64 }
    """

    files = generate(model, interfaces="other_msgs,near_msgs,unused_msgs")

    assert files["other_msgs/msg/Done.msg"].text == ("far_msgs/Place the_end\nnear_msgs/At at\n")
    assert files["near_msgs/msg/At.msg"].text == "float64 x\n"
    assert not [path for path in files if path.startswith(("far_msgs", "unused_msgs"))]
    root = etree.fromstring(files["other_msgs/package.xml"].text.encode())
    assert [each.text for each in root.findall("depend")] == ["far_msgs", "near_msgs"]


def test_only_what_is_the_users_is_kept(generate: Generate) -> None:
    kept = [path for path, file in generate(MODEL).items() if file.keep]

    assert kept == [
        "lab_behavior/lab_behavior/callbacks.py",
        "lab_behavior/config/eyes/left_0.yaml",
        "lab_behavior/config/eyes/left_1.yaml",
        "lab_behavior/config/eyes/head_0.yaml",
    ]


def test_roles_and_parts_have_their_values(generate: Generate) -> None:
    files = generate(MODEL)

    left = yaml.safe_load(files["lab_behavior/config/eyes/left.yaml"].text)
    head = yaml.safe_load(files["lab_behavior/config/eyes/head.yaml"].text)
    assert left == {"/**/watch": {"ros__parameters": {"limit": 1.5}}}
    assert head == {"/**/eye": {"ros__parameters": {"limit": 3.0}}}
    own = yaml.safe_load(files["lab_behavior/config/eyes/left_0.yaml"].text)
    assert own == {"/**": {"ros__parameters": {}}}


def test_a_robot_of_a_role_has_its_own_values(generate: Generate) -> None:
    role = "left : Eye[2..4]"
    model = MODEL.replace(role, role + " { limit = 2 s } left[1] { limit = 4 s }")
    files = generate(model)

    role = yaml.safe_load(files["lab_behavior/config/eyes/left.yaml"].text)
    robot = yaml.safe_load(files["lab_behavior/config/eyes/left_1.model.yaml"].text)
    assert role["/**/watch"]["ros__parameters"]["limit"] == 2.0
    assert robot["/**/watch"]["ros__parameters"]["limit"] == 4.0
    assert not files["lab_behavior/config/eyes/left_1.model.yaml"].keep
    assert "lab_behavior/config/eyes/left_0.model.yaml" not in files


def test_the_copyright_stands_in_each_file(generate: Generate) -> None:
    files = generate(MODEL, copyright="2026 Example Robotics")

    for path, file in files.items():
        if path.endswith(".py") and file.text:
            assert file.text.startswith("# Copyright 2026 Example Robotics\n#\n# Licensed"), path


@pytest.mark.parametrize("lifecycle", ["false", "true"])
def test_the_launch_file_starts_every_member(
    generate: Generate, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, lifecycle: str
) -> None:
    """`launch` is in no package index: what is asked of it is looked at on a stand-in."""
    files = generate(MODEL, lifecycle=lifecycle)
    write(files, tmp_path)
    package = tmp_path / "lab_behavior"

    def launch(**arguments: str) -> list[dict[str, Any]]:
        path = package / "launch" / "eyes.launch.py"
        return launching.launch(path, {"lab_behavior": package}, monkeypatch.setitem, **arguments)

    members = []
    for node in launch():
        values, *paths = node["parameters"]
        assert all(Path(path).is_file() for path in paths)
        assert len(paths) == 2
        assert node["package"] == "lab_behavior"
        assert node["kind"] == ("LifecycleNode" if lifecycle == "true" else "Node")
        count = values["self.count"]
        members.append((node["namespace"], node["name"], values["member"], count))
    assert members == [
        ("/eyes/left_0", "watch", "left[0]", 2),
        ("/eyes/left_1", "watch", "left[1]", 2),
        ("/eyes/head_0", "eye", "head[0].eye", 1),
    ]
    some = launch(members="left[2] head_0, head", left_count="4")
    assert [each["namespace"] for each in some] == ["/eyes/left_2", "/eyes/head_0"]
    assert [each["parameters"][0]["self.count"] for each in some] == [4, 1]


def test_the_digest_is_that_of_what_a_model_means(generate: Generate) -> None:
    def digest(text: str) -> str:
        module = generate(text)["lab_behavior/lab_behavior/model.py"].text
        (found,) = re.findall(r"^DIGEST = '([0-9a-f]{12})'$", module, re.MULTILINE)
        return found

    said = MODEL.replace("swarm Eyes", "// Eyes.\n/// All eyes.\nswarm   Eyes")
    assert said != MODEL
    assert digest(said) == digest(MODEL)
    assert digest(MODEL.replace("Eye[2..4]", "Eye[2..5]")) != digest(MODEL)


def test_one_robot_is_launched_on_its_own_computer(
    generate: Generate, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    write(generate(MODEL), tmp_path)
    package = tmp_path / "lab_behavior"

    def launch(**arguments: str) -> list[dict[str, Any]]:
        path = package / "launch" / "robot.launch.py"
        return launching.launch(path, {"lab_behavior": package}, monkeypatch.setitem, **arguments)

    traces, logs = tmp_path / "out" / "traces", tmp_path / "out" / "logs"
    folders = {"trace_dir": str(traces), "log_dir": str(logs)}
    (node,) = launch(
        member="left_2", other_models="refuse", respawn="true", respawn_delay="0.5", **folders
    )
    assert node["namespace"] == "/eyes/left_2"
    values, *files = node["parameters"]
    assert values == {
        "member": "left[2]",
        "self.count": 3,  # as many as its number needs
        "model.others": "refuse",
        "stay": True,
        "use_sim_time": False,
        "trace.file": str(traces / "left[2].jsonl"),
        "trace.keep": True,
    }
    assert [Path(file).name for file in files] == ["left.yaml"]
    assert (node["respawn"], node["respawn_delay"]) == (True, 0.5)
    assert node["additional_env"] == {"ROS_LOG_DIR": str(logs)}
    assert traces.is_dir()
    assert logs.is_dir()
    for given, said in (
        ({}, "`member` names one robot, not ``: left_0, head_0 and so on"),
        ({"member": "left"}, "names one robot, not `left`"),
        ({"member": "right_0"}, "there is no robot right_0, but left_0, head_0 and so on"),
        ({"member": "head_0", "swarm": "ears"}, "there is no swarm ears, but eyes"),
        (
            {"member": "left_4"},
            "no left_4: there is left_0 to left_3, and left_count can be 2 to 4",
        ),
        ({"member": "left_2", "left_count": "2"}, "no left_2: there is left_0 to left_1"),
        ({"member": "left_0", "left_count": "5"}, "there cannot be 5 of left, but 2 to 4"),
        ({"member": "head_0", "head_count": "9" * 5000}, "9 of head, but exactly 1"),
        ({"member": "left_" + "9" * 5000}, "its number is too great"),
        ({"member": "left_0", "left_count": "two"}, "must be a number of robots, not `two`"),
        *(
            ({"member": "left_0", "respawn_delay": each}, f"from 0 to 86400, not `{each}`")
            for each in ("soon", "nan", "inf", "-1")
        ),
        ({"member": "left_0", "respawn": "yes"}, "respawn must be true or false, not `yes`"),
        ({"member": "left_0", "log_dir": str(package / "setup.py")}, "log_dir cannot be made"),
    ):
        with pytest.raises(Exception, match=re.escape(said)) as error:
            launch(**given)
        assert type(error.value).__name__ == "RobotError"
    path = package / "launch" / "eyes.launch.py"
    with pytest.raises(Exception, match="there is no robot left2: there is left_0 to left_1"):
        launching.launch(path, {"lab_behavior": package}, monkeypatch.setitem, members="left2")


def test_launch_files_have_a_limit_of_robots(
    generate: Generate, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Also if the model has another one, or none."""
    package = tmp_path / "lab_behavior"

    def launch(number: str, **arguments: str) -> list[dict[str, Any]]:
        write(generate(MODEL.replace("Eye[2..4]", f"Eye[{number}]")), tmp_path)
        path = package / "launch" / "eyes.launch.py"
        return launching.launch(path, {"lab_behavior": package}, monkeypatch.setitem, **arguments)

    assert len(launch("*", left_count="1000", members="left_999")) == 1
    refused = "there cannot be 100000000 of left, but 1 to 1000"
    for number, given, said in (
        ("1..*", {"left_count": "100000000"}, refused),
        ("1..100000000", {"left_count": "100000000"}, refused),
        ("1..1001", {"members": "left_1000"}, "is left_0 to left_999, and left_count can"),
        ("2000", {"members": "left_1"}, "a launch has 1000 of left at most, and there are 2000"),
    ):
        with pytest.raises(Exception, match=re.escape(said)) as error:
            launch(number, **given)
        assert type(error.value).__name__ == "RobotError"


WATCHED = """
package lab
function lift : abstraction { service "lift" : std_srvs/Trigger }
event Take : std_msgs/Int32 on "take"
swarm event Home : std_msgs/Empty
swarm event Seen : std_msgs/Empty
statemachine Carrying {
  param most : int32 = 3
  var load : int32 = 0
  initial Empty
  state Empty { on Take / load = event.data, send Home -> Loaded }
  state Loaded {
    var homes : int32 = 0
    do lift
    on aborted -> Empty
    on succeeded
    on Home / homes = homes + 1 -> Empty
    on Seen -> Away
  }
  final Away
}
member Carrier { behavior Carrying }
member Spare {}
swarm Depot { carrier : Carrier[2]; fitness Moved }
swarm Empty { spare : Spare }
fitness Moved {
  in away : uint8 = count(carrier in Away)
  in time : duration = max each carrier : time(has [homes > 2])
  in begun : duration = time until some carrier in Loaded
  in way : float64
  maximize away - way
}
property Alone of Carrying : never in Loaded and has [load > 7]
property Light of Depot : each carrier : never has [load > most]
property Rare of Depot : each carrier : never has [homes > 9]
property Few of Depot : 1..2 carrier in Loaded leads to no carrier in Loaded within 1500 ms
property Lifted of Depot : each carrier : never ends lift as aborted and in Loaded
property Home1 of Depot : between Seen and carrier[1] in Away, carrier[1] hears Home at most 2 times
"""


def test_monitors_have_the_properties_of_a_swarm(generate: Generate, tmp_path: Path) -> None:
    files = generate(WATCHED, monitors="true")
    write(files, tmp_path)
    text = files["lab_behavior/lab_behavior/depot_monitor.py"].text
    for written in (
        "Fact('has', condition='load > most')",
        "Fact('has', condition='loaded_homes > 9')",
        "origin='each carrier : never has [homes > 9] (",
        "Sentence('leads', within=1_500_000_000)",
        "Fact('in', 'Loaded', robots=Robots('carrier', 'number', least=1, most=2))",
        "Sentence('times', scope='between', times=2)",
        "robots=Robots('carrier', 'index', number=1)",
        "'carrying',\n        ('Empty', 'Loaded', 'Away'),\n        most=2,\n",
        "properties=OF_CARRYING,\n        functions=(('Loaded', 'lift'),),",
        "Fact('ends', 'lift', outcome='aborted')",
        "'Alone',\n        Sentence('never'),",
        "Measure('away', 'count', Fact('in', 'Away', robots=Robots('carrier', 'every'))),",
        "bound='uint8',",
        "Fact('has', condition='loaded_homes > 2'),\n            aggregate='max',",
        "            each='carrier',",
        "'max each carrier : time(has [homes > 2]) (",
        "robots=Robots('carrier', 'some'))),\n        'time until some carrier in Loaded (",
        "SWARM = Swarm('Depot', MACHINES, PROPERTIES, 'Moved', MEASURES)",
    ):
        assert written in text, text
    machine = files["lab_behavior/lab_behavior/carrying.py"].text
    assert "return machine.data.load > machine.data.most" in machine
    assert "'load > most': holds_carrying," in machine
    assert "'loaded_homes > 2': " in machine
    assert "'load > 7': " in machine
    assert "'way'" not in text
    setup = files["lab_behavior/setup.py"].text
    assert "'depot_monitor = lab_behavior.depot_monitor:main'," in setup
    assert "## Monitor of Depot" in files["lab_behavior/README.md"].text
    assert not any("monitor" in path for path in generate(MODEL))


def test_what_monitors_cannot_watch_is_reported(
    reported: Callable[..., list[tuple[str, str, str]]],
) -> None:
    without = WATCHED[: WATCHED.index("fitness Moved {")].replace("; fitness Moved", "")
    more = """
property Outside of Depot : eventually Home
property Alone of Idling : eventually in Away
property Nobody of Empty : never spare in Away
"""
    more += "endless statemachine Idling { initial Away; state Away { on Take -> Away } }\n"
    assert reported(without + more) == []
    found = reported(without + more.replace("spare in Away", "Seen"), monitors="true")
    assert [(name, place) for name, _, place in found] == [
        ("no-place", "Home"),
        ("no-place", "Alone"),
        ("no-place", "Nobody"),
    ]
    assert "robots send it too, and do not tell who sent it" in found[0][1]
    measures = "in away : uint32 = count(carrier in Away); in home : duration = time until Home"
    fitness = f"fitness Moved of Depot {{ {measures}; maximize away }}\n"
    found = reported(f"{without}{fitness}", monitors="true")
    assert [place for _, _, place in found] == ["away", "home"]
    assert "monitors measure the fitness of swarms with nodes" in found[0][1]
    used = without.replace("Carrier[2]", "Carrier[2]; fitness Moved")
    (outside,) = reported(f"{used}{fitness}", monitors="true")
    assert outside[2] == "Home"
    param = without.replace("member Carrier {", "member Carrier { param size : float64 = 1.0;")
    big = fitness.replace("carrier in Away", "some carrier has [size > 2.0]")
    measured = param.replace("Carrier[2]", "Carrier[2]; fitness Moved")
    found = reported(f"{measured}{big}", monitors="true")
    assert "measure `away`: the state machine of `carrier` does not have its param" in found[0][1]
    (left_out,) = reported(
        f"{param}property Big of Depot : never some carrier has [size > 2.0]\n", monitors="true"
    )
    assert "property `Big`: the state machine of `carrier` does not have its param" in left_out[1]
    (nothing,) = reported(without, monitors="true")
    assert "option `monitors`, because the model has no property and no measure" in nothing[1]


@pytest.mark.parametrize("lifecycle", ["false", "true"])
def test_the_launch_file_starts_the_monitor(
    generate: Generate, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, lifecycle: str
) -> None:
    text = WATCHED
    write(generate(text, monitors="true", lifecycle=lifecycle), tmp_path)
    package = tmp_path / "lab_behavior"

    def launch(**arguments: str) -> list[dict[str, Any]]:
        path = package / "launch" / "depot.launch.py"
        return launching.launch(path, {"lab_behavior": package}, monkeypatch.setitem, **arguments)

    traces = tmp_path / "traces"
    first, *others = launch(trace_dir=str(traces))
    assert (first["kind"], first["namespace"], first["name"]) == ("Node", "/depot", "monitor")
    assert first["executable"] == "depot_monitor"
    assert first["parameters"] == [
        {
            "members": "carrier[0] carrier[1]",
            "use_sim_time": False,
            "trace.file": str(traces / "monitor.jsonl"),
        }
    ]
    assert [each["name"] for each in others] == ["carrying", "carrying"]
    assert [each["name"] for each in launch(monitor="false")] == ["carrying", "carrying"]
    assert [each["name"] for each in launch(members="carrier[1]")] == ["carrying"]


def test_whole_numbers_stay_in_their_types(generate: Generate) -> None:
    files = generate(
        BARE.replace("on Go -> Gone", "on Go / n = n * n, wide = n, n = m -> Gone").replace(
            "initial", "var n : int32 = 2; var m : int32 = 3; var wide : int64 = 0; initial"
        )
    )

    lines = [line.strip() for line in files["bare_behavior/bare_behavior/wait.py"].text.split("\n")]
    assert "machine.data.n = bounded(machine.data.n * machine.data.n, 'int32')" in lines
    # What only is handed on fits.
    assert "machine.data.n = machine.data.m" in lines


def test_traces_call_what_regions_take_as_a_simulation_does(
    generate: Generate, compiled: Callable[[str], System]
) -> None:
    """Also where transitions of the state around them stand in one line."""
    text = """
      package lab
      event Stop : std_msgs/Empty
      event Halt : std_msgs/Empty
      endless statemachine Work {
        initial Both
        parallel state Both { internal on Stop -> A1; internal on Halt -> B1
          region A { initial A0; state A0 { on Halt -> A1 } state A1 { } }
          region B { initial B0; state B0 { on Stop -> B1 } state B1 { } }
        }
      }
    """
    files = generate(text)
    names = dict(vars(swarmdsl.execution.engine))
    for module, wanted in (("host", "tree"), ("work", "STATES")):
        made = ast.parse(files[f"lab_behavior/lab_behavior/{module}.py"].text)
        made.body = [node for node in made.body if wanted in (_name(node), _assigned(node))]
        exec(compile(made, module, "exec"), names)

    def called(machine: Machine) -> list[list[str]]:
        return [[machine.called(each) for each in s.transitions] for s in machine.states]

    system = compiled(text)
    found = called(Machine("Work", names["STATES"], ("Both",)))
    assert found == called(table(system.machines[0], system))
    assert ["Both->1"] in found


def _assigned(node: ast.stmt) -> str:
    return ast.unparse(node.targets[0]) if isinstance(node, ast.Assign) else ""


def test_the_engine_is_whole(generate: Generate) -> None:
    """Each class and function of the engine is in the file, with the same code."""
    made = ast.parse(generate(MODEL)["lab_behavior/lab_behavior/engine.py"].text)
    found = {_name(node): _code(node) for node in made.body if _name(node)}
    folder = Path(swarmdsl.execution.engine.__file__).parent
    for path in sorted(folder.glob("[a-z]*.py")):
        for node in ast.parse(path.read_text(encoding="utf-8")).body:
            if _name(node):
                assert found[_name(node)] == _code(node), (path.name, _name(node))


def _name(node: ast.stmt) -> str:
    return node.name if isinstance(node, (ast.ClassDef, ast.FunctionDef)) else ""


def _code(node: ast.stmt) -> str:
    """The code without docstrings, and without what stands for one that is a comment."""
    for inner in ast.walk(node):
        body = getattr(inner, "body", None)
        if isinstance(body, list):
            kept = [
                each
                for each in body
                if not isinstance(each, ast.Pass)
                and not (isinstance(each, ast.Expr) and isinstance(each.value, ast.Constant))
            ]
            inner.body = kept or [ast.Pass()]  # type: ignore[attr-defined]
    return ast.dump(node)


def test_values_have_their_names(generate: Generate) -> None:
    files = generate("""
      package weeds
      enum Species : int32 { DOCK, THISTLE = 3 }
      const STATES : duration = 2 s
      const MOST   : int32    = 9
      event Seen : std_msgs/Int32
      endless statemachine M {
        param wanted : Species = Species.THISTLE
        var last : Species = Species.THISTLE
        initial A
        state A {
          on Seen [event.data < MOST and last == wanted] / last = Species.DOCK -> A
          after STATES -> A
        }
      }
      member Robot { behavior M }
    """)
    text = files["weeds_behavior/weeds_behavior/m.py"].text

    # A module has states of its own.
    head = "MOST = 9\nSPECIES_DOCK = 0  # Species.DOCK\nSPECIES_THISTLE = 3  # Species.THISTLE\n"
    assert f"\n\n{head}STATES_ = 2_000_000_000  # STATES\n\n\nclass Data:" in text
    assert "Parameter('wanted', 'int32', SPECIES_THISTLE)" in text
    assert "self.last = SPECIES_THISTLE" in text
    assert "event.data.data < MOST" in text
    assert "machine.data.last = SPECIES_DOCK" in text
    assert text.count("STATES_") == 2


def test_a_contract_without_a_watchdog_is_told(tmp_path: Path) -> None:
    """Also one that a member inherits; one that an heir keeps is kept."""
    model = tmp_path / "model.swarm"
    model.write_text(
        "package p\n"
        'function land : abstraction { service "land" : std_srvs/Empty }\n'
        "statemachine Fly { initial A; state A { after 1 s -> B }; final B }\n"
        "member Base { behavior Fly; contract Dies : when dead call land }\n"
        "member Uav extends Base {}\n"
        "member Spare { behavior Fly; contract Falls : when dead call land }\n"
        "controller Pilot { behavior Fly }\n"
        "member Flown { pilot : Pilot; contract Sinks : when dead call land }\n"
        "swarm Team { uav : Uav; flown : Flown }\n"
    )
    system = pipeline.check([model]).system
    assert system is not None
    told: dict[tuple[str, ...], list[str]] = {}
    for target, options in (("ros2", {}), ("smach", {"ros": "2"}), ("smach", {"ros": "1"})):
        report = Diagnostics()
        generator = load(target)
        generator.emit(system, parse_options(generator, options, report), report)
        told[(target, *options.values())] = [
            each.message.partition("contract ")[2] for each in report if each.name == "no-place"
        ]
    # A watchdog watches the behaviour of a robot, not that of a part.
    unwatched = ["`Falls`: nothing calls `land`", "`Sinks`: nothing calls `land`"]
    assert told[("ros2",)] == told["smach", "2"] == unwatched
    assert told["smach", "1"] == ["`Dies`: nothing calls `land`", *unwatched]


def test_libraries_have_the_same_tables(compiled: Callable[[str], System]) -> None:
    """Their nodes have one more parameter, of their own."""

    def readme(target: str, **options: str) -> list[str]:
        generator, report = load(target), Diagnostics()
        chosen = parse_options(generator, options, report)
        files = {each.path: each.text for each in generator.emit(compiled(MODEL), chosen, report)}
        assert not list(report)
        lines = files["lab_behavior/README.md"].partition("## Diagrams")[0].splitlines()
        return [line for line in lines if line.startswith(("|", "#"))]

    plain = readme("ros2")
    assert "### Parameters of each node" in plain
    for (target, options), own in (
        (("yasmin", {}), "viewer.publish"),
        (("smach", {"ros": "2"}), "introspection.publish"),
    ):
        more = readme(target, **options)
        assert {*plain} <= {*more}
        nodes = [line for line in more[more.index("## Nodes") :] if own not in line]
        assert nodes == plain[plain.index("## Nodes") :]
        assert [line for line in more if line.startswith(f"| `{own}` |")]
