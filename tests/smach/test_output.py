"""The text of generated packages: valid, neat, complete."""

import ast
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest
from lxml import etree

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.codegen.api import OutputFile
from swarmdsl.codegen.registry import load
from swarmdsl.driver import pipeline
from swarmdsl.execution import engine
from swarmdsl.ir import System

from .ros1 import for_ros_1

ENGINE = Path(engine.__file__).parent
Files = dict[str, OutputFile]
Generate = Callable[..., Files]

MODEL = '''
/// A lab with a "difficult" text \\\\ in it: """
package lab

struct Spot { x : float64, class : int32 }
/// What was seen.
message Seen {
  /// where
  spot  : Spot
  poses : geometry_msgs/Pose[]
  near  : Spot[4]
}
service Ask { request { times : int32 } response { answer : string } }
action Look { goal { at : Spot, self : string } result { found : bool } feedback { spot : Spot } }
function ask   : abstraction { service "ask" : Ask }
function look  : abstraction { action "look" : Look }
function other : abstraction { action "other" : other_msgs/Look }
event Saw : Seen on "seen"

/// Looks "around" \\\\
/// and says so
statemachine Watch {
  param name  : string = "it's"
  param limit : duration
  var spot  : Spot
  var spots : Spot[]
  initial Looking

  /// Look here \\\\ """
  state Looking {
    do look(at = spot, self = name) gives (found => done_)
    on succeeded -> Asking
    on aborted [spot.class == 1] / send Saw(spot = spot) -> Other
    on aborted -> Asking
    after limit -> Other
  }
  var done_ : bool
  state Asking {
    do ask(by make_request) gives by take_answer
    on succeeded -> End
    on aborted -> Looking
  }
  state Other { do other(by make_goal); on succeeded -> End; on aborted -> End }
  final End
}
statemachine Unused { initial A; state A { on Saw -> B }  final B }
member Robot { behavior Watch; param limit : duration = 1 s }
member Other { behavior Watch; param limit : duration = 2 s }
'''


@pytest.fixture
def files(generate: Generate) -> Files:
    return generate(MODEL)


def test_files(files: Files) -> None:
    assert set(files) == {
        "lab/package.xml",
        "lab/CMakeLists.txt",
        "lab/msg/Spot.msg",
        "lab/msg/Seen.msg",
        "lab/srv/Ask.srv",
        "lab/action/Look.action",
        "package.xml",
        "CMakeLists.txt",
        "setup.py",
        "src/lab_behavior/__init__.py",
        "src/lab_behavior/actions.py",
        "src/lab_behavior/chart.py",
        "src/lab_behavior/containers.py",
        *(f"src/lab_behavior/engine/{file.name}" for file in ENGINE.glob("*.py")),
        "src/lab_behavior/node.py",
        "src/lab_behavior/services.py",
        "src/lab_behavior/states.py",
        "src/lab_behavior/topics.py",
        "src/lab_behavior/events.py",
        "src/lab_behavior/identity.py",
        "src/lab_behavior/callbacks.py",
        "src/lab_behavior/watch.py",
        "scripts/watch",
        "README.md",
        "launch/robot.launch",
        "launch/other.launch",
        "param/robot.yaml",
        "param/other.yaml",
        "test/machines.test",
        "test/test_machine.py",
    }
    assert [path for path, file in files.items() if file.executable] == [
        "test/test_machine.py",
        "scripts/watch",
    ]
    assert [path for path, file in files.items() if file.keep] == ["src/lab_behavior/callbacks.py"]


def test_interfaces(files: Files) -> None:
    assert files["lab/msg/Seen.msg"].text == (
        "# What was seen.\n# where\nSpot spot\ngeometry_msgs/Pose[] poses\nSpot[4] near\n"
    )
    assert files["lab/srv/Ask.srv"].text == "int32 times\n---\nstring answer\n"
    assert files["lab/action/Look.action"].text == (
        "Spot at\nstring self\n---\nbool found\n---\nSpot spot\n"
    )


def _depends(files: Files, path: str) -> list[tuple[str, str]]:
    root = etree.fromstring(files[path].text.encode())
    assert root.get("format") == "2"
    return [(child.tag, child.text) for child in root if child.tag.endswith("depend")]


def test_dependencies(files: Files) -> None:
    assert _depends(files, "package.xml") == [
        ("buildtool_depend", "catkin"),
        ("buildtool_depend", "python3-setuptools"),
        *(
            ("exec_depend", name)
            for name in (
                *("actionlib", "actionlib_msgs", "genpy", "lab", "other_msgs", "rospy"),
                *("smach", "smach_ros", "roslaunch"),
            )
        ),
        ("test_depend", "rostest"),
    ]
    cmake = files["CMakeLists.txt"].text
    assert "catkin_python_setup()" in cmake
    assert "message_generation" not in cmake
    assert "  scripts/watch\n" in cmake


def test_package_of_interfaces(files: Files) -> None:
    assert _depends(files, "lab/package.xml") == [
        ("buildtool_depend", "catkin"),
        ("build_depend", "message_generation"),
        ("depend", "actionlib_msgs"),
        ("depend", "geometry_msgs"),
        ("exec_depend", "message_runtime"),
    ]
    cmake = files["lab/CMakeLists.txt"].text
    assert "project(lab)" in cmake
    assert "add_message_files(\n  FILES\n  Spot.msg\n  Seen.msg\n)" in cmake
    assert "add_service_files(\n  FILES\n  Ask.srv\n)" in cmake
    assert "add_action_files(\n  FILES\n  Look.action\n)" in cmake
    assert "DEPENDENCIES\n  actionlib_msgs\n  geometry_msgs\n)" in cmake


def test_constants_enums_and_bounds(generate: Generate) -> None:
    files = generate(
        """package lab
        enum Mode : uint8 {
          Off
          /// at work
          On = 5
        }
        message Limits {
          const top : float64 = 2 * 1.5
          const quick : bool = true
          const motto : string = "go # on"
          mode : Mode
          name : string<=10
          notes : string<=5[<=3]
          spots : float64[<=4]
          fixed : float64[4]
        }
        statemachine M { initial A; state A { after 1 s -> B }  final B }"""
    )
    assert files["lab/msg/Mode.msg"].text == "uint8 Off=0\n# at work\nuint8 On=5\n"
    assert files["lab/msg/Limits.msg"].text == (
        "float64 top=3.0\nbool quick=True\nstring motto=go # on\n"
        "uint8 mode\n"
        "# At most 10 characters.\nstring name\n"
        "# At most 3 elements.\n# At most 5 characters.\nstring[] notes\n"
        "# At most 4 elements.\nfloat64[] spots\nfloat64[4] fixed\n"
    )


def test_a_package_without_interfaces_generates_none(generate: Generate) -> None:
    files = generate(
        'package p\nfunction f : swarm { action "f" : m/F }\n'
        "statemachine M { initial A; state A { do f; on succeeded -> B; on aborted -> B } final B }"
    )
    assert "message" not in files["CMakeLists.txt"].text
    assert "message" not in files["package.xml"].text


def test_two_types_of_one_name_are_called_by_their_modules(files: Files) -> None:
    text = files["src/lab_behavior/watch.py"].text
    assert "import lab.msg\n" in text
    assert "import other_msgs.msg\n" in text
    assert "'other', other_msgs.msg.LookAction" in " ".join(text.split())
    assert "lab.msg.LookGoal(at=userdata.spot, self_=userdata.name)" in text


def test_a_type_called_like_something_else_in_the_module(generate: Generate) -> None:
    files = generate(
        "package p\nevent E : m/State\n"
        "statemachine M { var t : m/State; initial A; "
        "state A { on E -> B; after 1 s -> B } final B }"
    )
    assert "userdata.t = m.msg.State()" in files["src/p_behavior/m.py"].text


def test_places_and_texts_of_the_model(files: Files) -> None:
    text = files["src/lab_behavior/watch.py"].text
    line = 1 + MODEL[: MODEL.index("state Looking")].count("\n")
    assert f'# model.swarm:{line}\n        # Look here \\\\ """\n' in text
    module = ast.parse(text)
    assert ast.get_docstring(module) == 'Looks "around" \\\\\nand says so'


def test_required_params(files: Files) -> None:
    assert "node.run('watch', watch, ('~limit',))" in files["scripts/watch"].text
    text = files["src/lab_behavior/watch.py"].text
    assert "userdata.limit = rospy.Duration(param('~limit', float))" in text
    assert "userdata.name = param('~name', str, \"it's\")" in text


def test_callbacks_are_functions_of_the_user(files: Files) -> None:
    module = ast.parse(files["src/lab_behavior/callbacks.py"].text)
    functions = {
        node.name: [argument.arg for argument in node.args.args]
        for node in module.body
        if isinstance(node, ast.FunctionDef)
    }
    assert functions == {
        "make_request": ["userdata", "request"],
        "take_answer": ["userdata", "response"],
        "make_goal": ["userdata", "goal"],
    }


def test_options(generate: Generate) -> None:
    files = generate(MODEL, package="watcher", maintainer="A & B", email="a@example.org")
    root = etree.fromstring(files["package.xml"].text.encode())
    assert root.findtext("name") == "watcher"
    assert (root.findtext("maintainer"), root.find("maintainer").get("email")) == (
        "A & B",
        "a@example.org",
    )
    assert "src/watcher/watch.py" in files


def test_a_machine_that_no_member_uses_when_some_member_uses_one(generate: Generate) -> None:
    files = generate(MODEL[: MODEL.index("member")].replace("duration", "duration = 1 s"))
    assert {"scripts/watch", "scripts/unused"} <= set(files)


def test_behaviour_of_a_component_gets_a_node(generate: Generate) -> None:
    text = MODEL[: MODEL.index("member")].replace("duration", "duration = 1 s")
    files = generate(f"{text}\ncontroller Brain {{ behavior Unused }}")
    assert [path for path in files if path.startswith("scripts/")] == ["scripts/unused"]


def test_params_have_the_values_of_the_parts_that_run_the_machine(generate: Generate) -> None:
    files = generate(
        "virtual Beacon { param period : duration = 250 ms; behavior Blink }\n"
        "endless statemachine Blink {\n"
        "  param period : duration\n"
        "  initial On\n"
        "  state On { after period -> On }\n"
        "}\n"
        "member Tug { beacon : Beacon { period = 2 s } }"
    )
    assert "param('~period', float, 2.0)" in files["src/model_behavior/blink.py"].text


def _systems(examples: Path, compiled: Callable[[str], System]) -> list[System]:
    """The model above, and the examples."""
    systems = [compiled(MODEL)]
    for folder in sorted(path for path in examples.iterdir() if path.is_dir()):
        system = pipeline.check(sorted(folder.glob("*.swarm"))).system
        assert system is not None
        systems.append(for_ros_1(system))
    assert len(systems) > 3
    return systems


@pytest.fixture
def folder(examples: Path, compiled: Callable[[str], System], tmp_path: Path) -> Path:
    """Output generated from the examples and from the model above."""
    generator = load("smach")
    for number, system in enumerate(_systems(examples, compiled)):
        report = Diagnostics()
        for file in generator.emit(system, generator.options_type(), report):
            path = tmp_path / "out" / str(number) / file.path
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(file.text, encoding="utf-8")
        assert not list(report)
    return tmp_path / "out"


def _python(folder: Path) -> list[Path]:
    """All but the engine, which is as it is in swarmdsl."""
    return sorted(
        path
        for path in [*folder.rglob("*.py"), *folder.rglob("scripts/*")]
        if path.parent.name != "engine"
    )


def test_python_is_that_of_noetic(folder: Path) -> None:
    assert _python(folder)
    for path in _python(folder):
        text = path.read_text(encoding="utf-8")
        compile(text, str(path), "exec")
        ast.parse(text, feature_version=(3, 8))


def test_the_engine_is_whole(files: Files) -> None:
    for file in ENGINE.glob("*.py"):
        made = files[f"src/lab_behavior/engine/{file.name}"].text
        assert made.partition("\n")[2] == file.read_text(encoding="utf-8")


def test_the_engine_runs_on_the_python_of_noetic(folder: Path) -> None:
    code = "import sys, engine\nif sys.version_info < (3, 9): print(engine.Machine.__name__)"
    package = next(folder.rglob("engine")).parent
    command = ["python3.8", "-B", "-c", code]
    try:
        found = subprocess.run(command, cwd=package, capture_output=True, text=True, check=False)
    except OSError:
        pytest.skip("no Python 3.8: `pyenv install 3.8`, with it in PATH")
    if found.returncode == 127:  # a command of pyenv that leads to no Python
        pytest.skip("no Python 3.8: `pyenv install 3.8`, with it in PATH")
    assert (found.stdout, found.stderr) == ("Machine\n", "")


def test_python_is_neat(folder: Path) -> None:
    """Nothing unused or undefined, and laid out as a formatter would."""
    paths = _python(folder)
    flakes = [sys.executable, "-m", "pyflakes", *paths]
    assert subprocess.run(flakes, capture_output=True, text=True, check=False).stdout == ""
    style = ["--isolated", "--line-length=100", "--target-version=py38"]
    quotes = ["--config", 'format.quote-style="single"']
    ruff = [sys.executable, "-m", "ruff"]
    layout = [*ruff, "format", "--diff", *style, *quotes, *paths]
    assert subprocess.run(layout, capture_output=True, text=True, check=False).stdout == ""
    rules = "--select=A,B,C4,E,F,I,N,PIE,RET,SIM,W"
    own = sorted(path.parent.name for path in folder.glob("*/*/setup.py"))
    first_party = ["--config", f"lint.isort.known-first-party={own}"]
    lint = [*ruff, "check", "--quiet", *style, rules, *first_party, *paths]
    assert subprocess.run(lint, capture_output=True, text=True, check=False).stdout == ""


def test_same_model_same_text(compiled: Callable[[str], System]) -> None:
    generator = load("smach")
    first, second = (
        list(generator.emit(compiled(MODEL), generator.options_type(), Diagnostics()))
        for _ in range(2)
    )
    assert first == second


def test_what_is_said_of_lines_in_a_state_stands_where_they_are_done(generate: Generate) -> None:
    """Each once: above the state or the decision it belongs to, or in the function that does it."""
    said = [
        *("At first.", "At last.", "Counted.", "Asks.", "Known.", "Tried again."),
        *("Given up.", "Enough.", "Not enough."),
    ]
    model = """
    event Saw : std_msgs/Empty
    function ask : abstraction { service "ask" : std_srvs/Trigger }
    statemachine Watch {
      var seen : int32 = 0
      initial Waiting
      state Waiting {
        /// At first.
        entry / seen = 0
        /// At last.
        exit / seen = seen + 1
        /// Counted.
        on Saw / seen = seen + 1
        after 1 s -> Asking
      }
      state Asking {
        /// Asks.
        do ask
        /// Known.
        on succeeded -> Which
        /// Tried again.
        on aborted [seen < 3] / seen = seen + 1 -> Asking
        /// Given up.
        on aborted -> End
      }
      choice Which {
        /// Enough.
        [seen > 1] -> End
        /// Not enough.
        else -> Waiting
      }
      final End
    }
    """
    (text,) = [file.text for path, file in generate(model).items() if path.endswith("/watch.py")]
    lines = [line.strip() for line in text.splitlines()]

    for each in said:
        assert lines.count(f"# {each}") == 1, each
        above = lines[lines.index(f"# {each}") - 1]
        assert above.startswith("# model.swarm:"), each
    doing = [lines[lines.index(f"# {each}") + 1] for each in ("Counted.", "At first.", "At last.")]
    counted = "userdata.seen = bounded(userdata.seen + 1, 'int32')"
    assert doing == [counted, "userdata.seen = 0", counted]


def test_the_server_of_an_operation_is_in_the_namespace_of_what_is_asked(
    generate: Generate,
) -> None:
    files = generate(
        """
        package lab
        sensor Camera { operation snap() }
        sensor ThermalCamera extends Camera {}
        member Uav {
          behavior Watch
          left  : Camera
          right : ThermalCamera
        }
        statemachine Watch {
          initial A
          state A { do Camera.snap;        on succeeded, aborted -> B }
          state B { do ThermalCamera.snap; on succeeded, aborted -> C }
          state C { do left.snap;          on succeeded, aborted -> D }
          state D { do right.snap;         on succeeded, aborted -> E }
          final E
        }
        """
    )
    calls = [
        [ast.unparse(argument) for argument in node.args[:2]]
        for node in ast.walk(ast.parse(files["src/lab_behavior/watch.py"].text))
        if isinstance(node, ast.Call) and ast.unparse(node.func) == "ServiceState"
    ]
    assert calls == [
        ["'camera/snap'", "CameraSnap"],
        ["'thermal_camera/snap'", "CameraSnap"],
        ["'left/snap'", "CameraSnap"],
        ["'right/snap'", "CameraSnap"],
    ]
    assert [path for path in files if path.endswith(".srv")] == ["lab/srv/CameraSnap.srv"]
