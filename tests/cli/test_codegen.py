"""`swarmc codegen`, called as the code generator of CPSwarm is."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from swarmdsl.cli import run

DOOR = """<scxml xmlns="http://www.w3.org/2005/07/scxml" version="1.0" name="door">
  <state id="Robot"><transition event="shut" target="closed"/></state>
  <final id="closed"/>
</scxml>
"""
ENDED = """<scxml xmlns="http://www.w3.org/2005/07/scxml" version="1.0" name="door" initial="Over">
  <state id="Shut"><transition event="open" target="Over"/></state>
  <final id="Over"/>
</scxml>
"""


@pytest.fixture
def door(tmp_path: Path) -> Path:
    path = tmp_path / "door.xml"
    path.write_text(DOOR, encoding="utf-8")
    return path


def files(folder: Path) -> set[str]:
    return {
        path.relative_to(folder).as_posix()
        for path in folder.rglob("*")
        if path.is_file() and not path.name.startswith(".swarmdsl")
    }


def test_the_package_lies_where_the_original_puts_it(door: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"

    assert run(["codegen", "--env", "ROS", "--scxml", str(door), "--output", str(out)]) == 0
    made = files(out)
    assert {path.partition("/")[0] for path in made} == {"fsm_behaviour"}
    assert {"package.xml", "scripts/door", "launch/robot.launch"} <= {
        path.partition("/")[2] for path in made
    }
    assert not any("/world/" in path or "simulation" in path for path in made)


def test_a_simulation_has_a_world(door: Path, tmp_path: Path) -> None:
    out = tmp_path / "out"
    command = ["codegen", "--scxml", str(door), "-o", str(out), "--mode", "simulation"]

    assert run([*command, "--package", "door_sim"]) == 0
    made = files(out)
    assert {"door_sim/world/empty.world", "door_sim/launch/robots_simulation.launch"} <= made


def test_older_names_of_options(door: Path, tmp_path: Path) -> None:
    assert run(["codegen", "-e", "ros", "--src", str(door), "--target", str(tmp_path / "out")]) == 0
    assert (tmp_path / "out" / "fsm_behaviour" / "package.xml").exists()


def test_a_package_is_brought_up_to_date_and_never_overwritten(
    door: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "out"
    command = ["codegen", "--scxml", str(door), "-o", str(out)]
    run(command)
    before = files(out)
    edited = out / "fsm_behaviour" / "src" / "fsm_behaviour" / "door.py"

    assert run(command) == 0
    assert files(out) == before
    edited.write_text("# mine\n", encoding="utf-8")
    door.write_text(DOOR.replace("shut", "lock"), encoding="utf-8")
    assert run(command) == 1
    assert "error[SW0919]" in capsys.readouterr().out
    assert edited.read_text(encoding="utf-8") == "# mine\n"
    assert run([*command, "--force"]) == 0
    assert "Lock" in edited.read_text(encoding="utf-8")
    assert run([*command, "--check"]) == 0
    door.write_text(DOOR, encoding="utf-8")
    capsys.readouterr()
    assert run([*command, "--dry-run"]) == 0
    assert f"change    {edited.as_posix()}\n" in capsys.readouterr().out
    assert run([*command, "--diff"]) == 1
    assert f"--- {edited.as_posix()}\n" in capsys.readouterr().out
    assert run([*command, "--check"]) == 1
    assert f"`{edited}` is out of date" in capsys.readouterr().out
    assert "Lock" in edited.read_text(encoding="utf-8")
    assert run([*command, "--check", "--force"]) == 2


@pytest.mark.parametrize(
    ("text", "code"),
    [("<scxml", "SW0801"), ("<scxml xmlns='http://www.w3.org/2005/07/scxml'/>", "SW1209")],
)
def test_what_cannot_be_read_fails(
    text: str, code: str, door: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    door.write_text(text, encoding="utf-8")

    assert run(["codegen", "--scxml", str(door), "-o", str(tmp_path / "out")]) == 1
    assert f"error[{code}]" in "".join(capsys.readouterr())
    assert not (tmp_path / "out").exists()


def test_what_smach_does_not_have_fails(
    door: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    door.write_text(ENDED, encoding="utf-8")

    assert run(["codegen", "--scxml", str(door), "-o", str(tmp_path / "out")]) == 1
    assert (
        "error[SW0903]: target `smach` cannot express an initial state that is final"
        in capsys.readouterr().out
    )
    assert not (tmp_path / "out").exists()


def test_a_file_that_is_not_there_has_a_way_out(
    door: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "uav.json").write_text("{}", encoding="utf-8")
    for adf, help_ in (
        ("uaw.json", "did you mean `uav.json`?"),
        ("functions.json", "the files that end with `.json` there are `uav.json`"),
        ("no/uav.json", f"there is no folder `{tmp_path / 'no'}`"),
    ):
        words = ["--scxml", str(door), "--adf", str(tmp_path / adf), "-o", str(tmp_path / "out")]
        assert run(["codegen", *words]) == 1
        said = capsys.readouterr().out
        assert "error[SW0001]" in said
        assert f"= help: {help_}\n" in said


def test_warnings_have_the_levels_that_are_asked_for(
    climb: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    unhandled = CLIMB.format(function="lift").replace('event="aborted"', 'event="elsewhere"')
    (tmp_path / "climb.xml").write_text(unhandled, encoding="utf-8")

    assert run([*climb, "--deny", "open-outcome"]) == 1
    assert "error[SW1206]" in capsys.readouterr().out
    assert not (tmp_path / "out").exists()
    assert run(climb) == 0
    assert "warning[SW1206]" in capsys.readouterr().out
    assert run([*climb, "--allow", "warnings"]) == 0
    assert capsys.readouterr().out == ""
    assert run([*climb, "--deny", "nonsense"]) == 2


def test_wrong_files_and_options(door: Path, tmp_path: Path) -> None:
    adf, out = tmp_path / "a.json", str(tmp_path / "out")
    adf.write_text(json.dumps([1]), encoding="utf-8")

    assert run(["codegen", "--scxml", str(door), "--adf", str(adf), "-o", out]) == 1
    assert run(["codegen", "--scxml", str(tmp_path / "no.xml"), "-o", out]) == 1
    assert run(["codegen", "--scxml", str(door), "-o", out, "--package", "1st"]) == 2
    assert run(["codegen", "--scxml", str(door), "-o", out, "--env", "YARP"]) == 2
    assert run(["codegen", "--scxml", str(door)]) == 2
    assert not Path(out).exists()


CLIMB = """<scxml xmlns="http://www.w3.org/2005/07/scxml" version="1.0" name="climb" initial="Up">
  <state id="Up">
    <datamodel>
      <data id="adf"><name>{function}</name></data>
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


@pytest.fixture
def climb(tmp_path: Path) -> list[str]:
    """A command for a machine whose state wants a skeleton, in the form of D5.4's appendix."""
    definition = {
        "name": "cmd/lift",
        "class": "lift/Lift",
        "goal": {"fields": [{"class": "float64", "name": "height"}]},
    }
    lift = {
        "name": "lift",
        "category": "abstraction-lib",
        "param_list": [{"class": "number", "name": "tolerance", "value": 0.1}],
        "api": {"comm_model": {"paradigm": "rosaction", "definition": definition}},
    }
    other = {"name": "other", "category": "swarm-lib", "api": {"comm_model": {}}}
    adf, scxml = tmp_path / "robot.json", tmp_path / "climb.xml"
    adf.write_text(json.dumps({"runtime-env": "ROS", "functions": [lift, other]}))
    scxml.write_text(CLIMB.format(function="lift"), encoding="utf-8")
    return ["codegen", "--scxml", str(scxml), "--adf", str(adf), "-o", str(tmp_path / "out")]


def test_a_function_that_a_state_names_gets_a_skeleton(climb: list[str], tmp_path: Path) -> None:
    assert run(climb) == 0
    made = files(tmp_path / "out")
    assert {path.partition("/")[0] for path in made} == {"fsm_behaviour", "lift"}
    assert {"lift/src/lift.cpp", "lift/src/lift_node.cpp", "lift/launch/lift.launch"} <= made
    action = (tmp_path / "out" / "lift" / "action" / "Lift.action").read_text(encoding="utf-8")
    assert action == "float64 height\n---\n---\n"
    mine = tmp_path / "out" / "lift" / "src" / "lift.cpp"
    mine.write_text("// mine\n", encoding="utf-8")
    assert run([*climb, "--force"]) == 0
    assert mine.read_text(encoding="utf-8") == "// mine\n"


def test_skeletons_in_python(climb: list[str], tmp_path: Path) -> None:
    assert run([*climb, "--language", "python"]) == 0
    assert (tmp_path / "out" / "lift" / "src" / "lift" / "implementation.py").exists()


def test_a_simulation_has_no_skeletons(climb: list[str], tmp_path: Path) -> None:
    assert run([*climb, "--mode", "simulation"]) == 0
    assert not (tmp_path / "out" / "lift").exists()


def test_a_skeleton_that_no_adf_file_describes_is_told(
    climb: list[str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (tmp_path / "climb.xml").write_text(CLIMB.format(function="left"), encoding="utf-8")

    assert run(climb) == 0
    said = "the skeleton of `left` is left out: no ADF file describes it"
    assert said in capsys.readouterr().out
    assert {path.partition("/")[0] for path in files(tmp_path / "out")} == {"fsm_behaviour"}
