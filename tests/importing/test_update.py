"""Imports into a model that is there: what changes, and what stays as somebody wrote it."""

from __future__ import annotations

import json
import shutil
import stat
from pathlib import Path
from typing import Any

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.cli import run
from swarmdsl.importing.update import read_model, update

from .corpus import CORPUS

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"
# Those that import all others of their folder.
MODELS = [
    EXAMPLES / path
    for path in (
        *("cpswarm/cpswarm.swarm", "flocking/flocking.swarm", "minimal/blinker.swarm"),
        *("search_and_rescue/sar.swarm", "storage/storage.swarm"),
    )
]
REAL = [
    *sorted((CORPUS / "scxml").glob("*.xml")),
    # Three letters stand in the middle of the one that is left out.
    *(path for path in sorted((CORPUS / "adf").glob("*.json")) if path.stem != "2019-11-18_json"),
]
MODEL = """\
// Of the lab.
package uav  // short

import "more.swarm"

/// Lift something.
function lift : swarm {
  service "cmd/lift" : arm_msgs/Raise  // how it is called
  in "arm/state" : arm_msgs/State

  // Chosen by hand.
  param speed   : float32  = 0.5  // slow
  param mine    : int32    = 3
  param wait    : duration = 2 s
  param ratio   : float64  = 2 * 0.5
}

// A machine of ours.
statemachine Keep {
  initial A
  state A { after 1 s -> B }
  final B
}
"""
MORE = "package more\n\nsensor Camera { out image : sensor_msgs/Image }\n"


@pytest.fixture
def model(tmp_path: Path) -> Path:
    path = tmp_path / "uav.swarm"
    path.write_text(MODEL, encoding="utf-8")
    path.with_name("more.swarm").write_text(MORE, encoding="utf-8")
    return path


def described(**changes: Any) -> dict[str, Any]:
    """A function of an ADF file."""
    function: dict[str, Any] = {
        "name": "lift",
        "description": "Another description.",
        "category": "abstraction-lib",
        "api": {
            "comm_model": {
                "paradigm": "rosaction",
                "definition": {"name": "cmd/raise", "class": "arm_msgs/Lift"},
            },
            "inputs": [{"topic": "arm/state", "msg": {"class": "arm_msgs/Joints"}}],
            "outputs": [{"topic": "arm/goal", "msg": {"class": "arm_msgs/Goal"}}],
        },
        "param_list": [
            {"class": "number", "name": "speed", "value": 0.75, "description": "In m/s."},
            {"class": "number", "name": "wait", "value": 2.5},
            {"class": "number", "name": "ratio", "value": 2.0},
            {"class": "number", "name": "force", "value": 4},
        ],
    }
    return function | changes


def adf(folder: Path, *functions: dict[str, Any], **others: Any) -> str:
    path = folder / "arm.json"
    path.write_text(json.dumps({"functions": functions, **others}), encoding="utf-8")
    return str(path)


def test_what_is_there_is_changed_in_its_place(
    model: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = adf(tmp_path, described())

    assert run(["import", "adf", file, "-o", str(model)]) == 0
    out, err = capsys.readouterr()
    assert (
        model.read_text(encoding="utf-8")
        == """\
// Of the lab.
package uav  // short

import "more.swarm"

/// Lift something.
function lift : abstraction {
  action "cmd/raise" : arm_msgs/Lift  // how it is called
  in  "arm/state" : arm_msgs/Joints
  out "arm/goal"  : arm_msgs/Goal

  // Chosen by hand.
  /// In m/s.
  param speed : float32  = 0.75  // slow
  param mine  : int32    = 3
  param wait  : duration = 2500 ms
  param ratio : float64  = 2 * 0.5
  param force : float64  = 4
}

// A machine of ours.
statemachine Keep {
  initial A
  state A { after 1 s -> B }
  final B
}
"""
    )
    assert "-  param mine    : int32    = 3\n" in out
    assert '+  action "cmd/raise" : arm_msgs/Lift  // how it is called\n' in out
    assert err.count("SW1212") == 1
    assert "the value of `ratio` is not updated" in err


def test_a_second_import_changes_nothing(
    model: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file = adf(tmp_path, described())
    run(["import", "adf", file, "-o", str(model)])
    before = model.read_bytes()
    capsys.readouterr()

    assert run(["import", "adf", file, "-o", str(model)]) == 0
    assert run(["import", "adf", file, "-o", str(model), "--dry-run"]) == 0
    out, err = capsys.readouterr()
    assert out == ""
    assert f"{model} is up to date" in err
    assert model.read_bytes() == before


def test_values_that_are_computed_are_replaced_by_force(model: Path, tmp_path: Path) -> None:
    assert run(["import", "adf", adf(tmp_path, described()), "-o", str(model), "--force"]) == 0
    assert "param ratio : float64  = 2.0\n" in model.read_text(encoding="utf-8")


def test_a_dry_run_writes_nothing_and_tells_by_its_exit_code(
    model: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    file, new = adf(tmp_path, described()), tmp_path / "new.swarm"

    assert run(["import", "adf", file, "-o", str(model), "--dry-run"]) == 1
    assert f"--- {model}\n+++ {model}\n" in capsys.readouterr().out
    assert model.read_text(encoding="utf-8") == MODEL
    assert run(["import", "adf", file, "-o", str(new), "--dry-run"]) == 1
    assert "+package new\n" in capsys.readouterr().out
    assert not new.exists()
    assert run(["import", "adf", file, "--dry-run"]) == 2


def test_declarations_of_imported_files_are_changed_there(model: Path, tmp_path: Path) -> None:
    port = {"topic": "camera/info", "msg": {"class": "sensor_msgs/CameraInfo"}}
    camera = {"name": "Camera", "category": "Sensor", "api": {"outputs": [port]}}
    model.chmod(0o640)
    file = adf(tmp_path, **{"sensors/actuators": [camera]})

    assert run(["import", "adf", file, "-o", str(model)]) == 0
    assert model.read_text(encoding="utf-8") == MODEL
    assert model.with_name("more.swarm").read_text(encoding="utf-8") == (
        "package more\n\nsensor Camera {\n  out image : sensor_msgs/Image\n"
        '  out info  : sensor_msgs/CameraInfo on "camera/info"\n}\n'
    )
    assert stat.S_IMODE(model.stat().st_mode) == 0o640


def test_what_a_library_has_is_not_declared_again(tmp_path: Path) -> None:
    model = tmp_path / "uav.swarm"
    text = "package uav\n\nimport cpswarm.functions.*\nimport cpswarm.interfaces.*\n"
    model.write_text(text, encoding="utf-8")
    land = {"paradigm": "rosservice", "definition": {"name": "cmd/land", "class": "std_srvs/Empty"}}
    same = {"name": "uav_mavros_land", "category": "abstraction-lib", "api": {"comm_model": land}}
    file = adf(tmp_path, same)

    assert run(["import", "adf", file, "-o", str(model)]) == 0
    assert model.read_text(encoding="utf-8") == text
    more = {**same, "param_list": [{"class": "number", "name": "rate", "value": 1}]}
    assert run(["import", "adf", adf(tmp_path, more), "-o", str(model)]) == 0
    assert model.read_text(encoding="utf-8") == (
        f"{text}\nfunction uav_mavros_land : abstraction {{\n"
        '  service "cmd/land" : std_srvs/Empty\n  param rate : float64 = 1\n}\n'
    )


def test_what_is_an_operation_is_not_declared_as_a_function(tmp_path: Path) -> None:
    model = tmp_path / "cart.swarm"
    text = "package cart\n\nactuator Hoist { operation lift(in height : float64) }\n"
    model.write_text(text, encoding="utf-8")

    assert run(["build", str(model), "-t", "adf", "-o", str(tmp_path / "out")]) == 0
    (file,) = (tmp_path / "out").rglob("*.adf.json")
    assert "hoist_lift" in file.read_text(encoding="utf-8")
    assert run(["import", "adf", str(file), "-o", str(model)]) == 0
    assert model.read_text(encoding="utf-8") == text


@pytest.mark.parametrize("form", ["d5.4", "schema"])
@pytest.mark.parametrize("path", MODELS, ids=lambda path: path.stem)
def test_what_a_model_wrote_changes_nothing_in_it(path: Path, form: str, tmp_path: Path) -> None:
    folder, out = tmp_path / "models", tmp_path / "out"
    shutil.copytree(path.parent, folder)
    model = str(folder / path.name)
    build = ["build", model, "-t", "adf", "-t", "amf", "--option", f"adf.form={form}"]

    assert run([*build, "-o", str(out)]) == 0
    files = [*out.rglob("*.adf.json"), *out.rglob("*.amf.json")]
    assert files
    for file in files:
        kind = file.suffixes[0].removeprefix(".")
        assert run(["import", kind, str(file), "-o", model, "--dry-run"]) == 0


def test_line_ends_stay(model: Path, tmp_path: Path) -> None:
    model.write_bytes(MODEL.replace("\n", "\r\n").encode())

    assert run(["import", "adf", adf(tmp_path, described()), "-o", str(model)]) == 0
    content = model.read_bytes()
    assert content.count(b"\r\n") == content.count(b"\n") > 20


def test_a_model_with_syntax_errors_is_left_alone(
    model: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    model.write_text(f"{MODEL}\nevent X\n", encoding="utf-8")

    assert run(["import", "adf", adf(tmp_path, described()), "-o", str(model)]) == 1
    assert "uav.swarm:25:7" in capsys.readouterr().err
    assert model.read_text(encoding="utf-8") == f"{MODEL}\nevent X\n"


def test_an_import_may_bring_what_a_model_lacks(model: Path, tmp_path: Path) -> None:
    machine = "statemachine M {\n  initial A\n  state A { do drop; on succeeded, aborted -> B }\n"
    model.write_text(f"{machine}  final B\n}}\n", encoding="utf-8")

    assert run(["check", str(model)]) == 1
    file = adf(tmp_path, described(name="drop"))
    assert run(["import", "adf", file, "-o", str(model)]) == 0
    assert run(["check", str(model)]) == 0


def test_no_new_mistake_is_written(
    model: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text = f"{MODEL}\nevent force : std_msgs/Empty\n"
    model.write_text(text, encoding="utf-8")
    file = adf(tmp_path, described(name="force"))

    assert run(["import", "adf", file, "-o", str(model)]) == 1
    assert "error[SW1210]" in (err := capsys.readouterr().err)
    assert "`force` is declared twice (SW0201)" in err
    assert model.read_text(encoding="utf-8") == text


def test_an_empty_file_is_a_new_one(tmp_path: Path) -> None:
    path = tmp_path / "uav.swarm"
    path.write_text("\n", encoding="utf-8")

    assert run(["import", "adf", adf(tmp_path, described()), "-o", str(path)]) == 0
    assert path.read_text(encoding="utf-8").startswith("package uav\n")


@pytest.mark.parametrize(
    ("before", "imported", "after"),
    [
        pytest.param(
            "event A : a/B\n// c\n",
            'event A : a/C on "x"',
            'event A : a/C on "x"\n// c\n',
            id="event",
        ),
        pytest.param(
            'swarm /* s */ event A : a/B /* t */ on "y"',
            'event A : a/B on "x"',
            ' /* s */ event A : a/B /* t */ on "x"',
            id="event-of-one-robot",
        ),
        pytest.param(
            "event A : a/B", "swarm event A : a/B", "swarm event A : a/B", id="swarm-event"
        ),
        pytest.param(
            "swarm /* s */ event A : a/B",
            "swarm operator event A : a/B",
            "swarm /* s */ operator event A : a/B",
            id="event-of-a-person",
        ),
        pytest.param(
            "swarm operator /* s */ event A : a/B",
            "swarm event A : a/B",
            "swarm  /* s */ event A : a/B",
            id="event-of-no-person",
        ),
        pytest.param(
            "event A : a/B  // c\nevent Z : a/B\n\nmember M { }\n",
            "event B : a/B",
            "event A : a/B  // c\nevent Z : a/B\nevent B : a/B\n\nmember M { }\n",
            id="new-event",
        ),
        pytest.param(
            "action a/B { }",
            "/// D.\naction a/B { goal { x : int8 } result { y : int8 } }",
            "/// D.\naction a/B {\ngoal {\nx : int8\n}\n\nresult {\ny : int8\n}\n }",
            id="sections",
        ),
        pytest.param(
            "action a/B { result { /* r */ } // s\n feedback { f : a/C } }",
            "action a/B { result { y : int8 } feedback {\n/// D.\n e : a/C, f : a/D } }",
            "action a/B { result {\ny : int8\n /* r */ } // s\n"
            " feedback { f : a/D\n/// D.\ne : a/C\n } }",
            id="fields",
        ),
        pytest.param(
            "message a/B { const A : uint8 = 1 }",
            "message a/B { const A : uint8 = 2; const B : uint8 = 3; x : int8 }",
            "message a/B { const A : uint8 = 2\nconst B : uint8 = 3\n\nx : int8\n }",
            id="constants",
        ),
        pytest.param(
            "sensor S extends T { }\nsensor T { in a : int8; param p : int8 = 1 }",
            "actuator S { in a : string; param p : float64 = 1.0; param q : int8 }",
            "actuator S extends T {\nparam q : int8\n }\n"
            "sensor T { in a : int8; param p : int8 = 1 }",
            id="inherited",
        ),
        pytest.param(
            'virtual V { inout x : int8 on "t"; out y : int8 }',
            'virtual V { in t : int16 on "t"; out y : int8 on "u" }',
            'virtual V { inout x : int16 on "t"; out y : int8\nout y2 : int8 on "u"\n }',
            id="ports-are-found-by-topics",
        ),
        pytest.param(
            "sensor S { param p : int8 }",
            "sensor S { in a : int8; param p : int8 = 1 }",
            "sensor S { param p : int8 = 1\nin a : int8\n }",
            id="a-value-and-a-port",
        ),
        pytest.param(
            "enum Mode : uint8 { OFF }\nstruct S { m : Mode, n : string<=4 }",
            "message m/S { m : uint8, n : string }",
            "enum Mode : uint8 { OFF }\nstruct S { m : Mode, n : string<=4 }",
            id="types-that-the-format-does-not-have",
        ),
    ],
)
def test_changes(before: str, imported: str, after: str) -> None:
    paths = Path("m.swarm"), Path("i.swarm")
    old, new = (
        read_model(path, Diagnostics(), texts={str(path): text})
        for path, text in zip(paths, (before, imported), strict=True)
    )
    made = update(old, new, Diagnostics(), complete=False)

    assert made.get("m.swarm", before) == after


@pytest.mark.parametrize(
    ("before", "imported", "places"),
    [
        ("message a/B { x : int8, y : int8 }", "message a/B { x : int8 }", ["y : int8"]),
        ("message a/B { x : int8, y : int8 }", "message a/B { y : int8, x : int8 }", ["x : int8"]),
        ("message a/B { x : int8 }", "service a/B { }", ["a/B"]),
        ("action a/B { goal { x : int8 } }", "action a/B { }", []),
        ("const C : int8 = 1; function f : swarm { param p : int8 = C }",
         "function f : swarm { param p : int8 = 2 }", ["C"]),
    ],
)  # fmt: skip
def test_what_stays_is_told(before: str, imported: str, places: list[str]) -> None:
    paths = Path("m.swarm"), Path("i.swarm")
    old, new = (
        read_model(path, Diagnostics(), texts={str(path): text})
        for path, text in zip(paths, (before, imported), strict=True)
    )
    report = Diagnostics()

    assert update(old, new, report) == {}
    assert [(f.name, f.primary.span.text if f.primary else "") for f in report] == [
        ("kept", place) for place in places
    ]


def test_a_package_of_ros_says_what_its_nodes_are_set_to(model: Path, tmp_path: Path) -> None:
    files = {
        "lift/param/a.yaml": "speed: 2  # In m/s.\nnew: true\n",
        "camera/param/b.yaml": "hz: 9",
    }
    for name, text in files.items():
        path = tmp_path / "src" / name
        path.parent.mkdir(parents=True)
        path.write_text(text, encoding="utf-8")

    assert run(["import", "ros", str(tmp_path / "src"), "-o", str(model)]) == 0
    text = model.read_text(encoding="utf-8")
    assert 'function lift : swarm {\n  service "cmd/lift" : arm_msgs/Raise' in text
    assert "  param speed : float32  = 2  // slow\n" in text
    assert "  param new   : bool     = true\n  param mine" in text
    assert "sensor Camera {\n" in (other := model.with_name("more.swarm").read_text("utf-8"))
    assert "param hz : int64 = 9" in other


SCXML = """<scxml xmlns="http://www.w3.org/2005/07/scxml" version="1.0" name="search">
  <state id="idle"><transition event="start" target="rise"/></state>
  <state id="rise">
    <datamodel><data id="invoke"><rosaction><name>cmd/rise</name><action>uav_msgs/Rise</action>
    <goal type="empty"/><result type="empty"/></rosaction></data></datamodel>
    <invoke type="ROS_ACTION"/>
    <transition event="succeeded" target="done"/>
    <transition event="aborted" target="done"/>
  </state>
  <final id="done"/>
</scxml>
"""
FLIGHT = """\
package flight

// Renamed by hand.
function climb : swarm { action "cmd/rise" : uav_msgs/Rise }
// Chosen by hand.
event Start : uav_msgs/Start on "mission/start"
"""


def test_a_machine_is_made_of_what_a_model_has(tmp_path: Path) -> None:
    model, file = tmp_path / "flight.swarm", tmp_path / "search.xml"
    model.write_text(FLIGHT, encoding="utf-8")
    file.write_text(SCXML, encoding="utf-8")

    assert run(["import", "scxml", str(file), "-o", str(model)]) == 0
    text = model.read_text(encoding="utf-8")
    assert text.startswith(FLIGHT.replace("// Chosen", "\n// Chosen"))
    assert "do climb" in text
    assert text.count("function") == text.count("event ") == 1
    assert run(["import", "scxml", str(file), "-o", str(model), "--dry-run"]) == 0


def test_a_machine_that_differs_is_replaced_by_force_alone(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    model, file = tmp_path / "flight.swarm", tmp_path / "search.xml"
    file.write_text(SCXML, encoding="utf-8")
    run(["import", "scxml", str(file), "-o", str(model)])
    made = model.read_text(encoding="utf-8")
    head = "statemachine Search {\n"
    edited = made.replace(head, f"// Of ours.\n{head}  // In it.\n")
    model.write_text(edited, encoding="utf-8")

    assert run(["import", "scxml", str(file), "-o", str(model), "--dry-run"]) == 0
    assert "SW1212" not in capsys.readouterr().err
    model.write_text(edited.replace("-> Rise", "-> Done"), encoding="utf-8")
    assert run(["import", "scxml", str(file), "-o", str(model)]) == 0
    assert "state machine `Search` is not updated" in capsys.readouterr().err
    assert model.read_text(encoding="utf-8") == edited.replace("-> Rise", "-> Done")
    assert run(["import", "scxml", str(file), "-o", str(model), "--force"]) == 0
    assert model.read_text(encoding="utf-8") == edited.replace("  // In it.\n", "")


@pytest.mark.skipif(not REAL, reason=f"no real files in {CORPUS} (set SWARMDSL_CORPUS)")
@pytest.mark.parametrize("path", REAL, ids=lambda path: f"{path.parent.name}-{path.stem}")
def test_real_files_change_nothing_when_they_come_again(path: Path, tmp_path: Path) -> None:
    kind = "scxml" if path.suffix == ".xml" else "adf"
    out = tmp_path / "model.swarm"
    command = ["import", kind, str(path), "-o", str(out)]

    assert run(command) == 0
    assert run([*command, "--dry-run"]) == 0
