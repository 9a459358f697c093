"""`swarmc import` as a person runs it, and over the real files where they are present."""

from __future__ import annotations

import json
import os
from pathlib import Path

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics, Severity
from swarmdsl.base.source import Source
from swarmdsl.cli import run
from swarmdsl.codegen.emit import Request
from swarmdsl.codegen.swarm_printer.system import print_system
from swarmdsl.driver import pipeline
from swarmdsl.importing import import_scxml
from swarmdsl.importing.command import run as import_files
from swarmdsl.ir import State, System

ROOT = Path(__file__).resolve().parents[2]
CORPUS = Path(os.environ.get("SWARMDSL_CORPUS", ROOT.parent / "shared" / "corpus"))
SCXML = sorted((CORPUS / "scxml").glob("*.xml"))
ADF = sorted((CORPUS / "adf").glob("*.json"))

DOOR = """<scxml xmlns="http://www.w3.org/2005/07/scxml" version="1.0" name="door">
  <state id="open"><transition event="shut" target="closed"/></state>
  <final id="closed"/>
</scxml>
"""


@pytest.fixture
def door(tmp_path: Path) -> Path:
    path = tmp_path / "door.xml"
    path.write_text(DOOR, encoding="utf-8")
    return path


def test_the_model_goes_to_standard_output(door: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["import", "scxml", str(door)]) == 0

    out, err = capsys.readouterr()
    assert (
        out
        == """\
package door

event Shut : std_msgs/Empty

statemachine Door {
  initial Open

  state Open {
    on Shut -> Closed
  }
  final Closed
}
"""
    )
    assert "warning[SW1205]" in err
    assert "1 warning in 1 file" in err


def test_a_new_file_is_named(
    door: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    model = tmp_path / "door.swarm"
    assert run(["import", "scxml", str(door), "-o", str(model)]) == 0
    out, err = capsys.readouterr()
    assert (out, err.splitlines()[-2:]) == ("", ["1 warning in 1 file", f"{model} was written"])
    assert run(["import", "scxml", str(door), "-o", str(model)]) == 0
    assert capsys.readouterr().err.endswith(f"{model} is up to date\n")
    assert run(["import", "scxml", str(door), "-o", str(tmp_path / "b.swarm"), "--dry-run"]) == 1
    assert "written" not in capsys.readouterr().err


def test_files_of_the_other_format(
    door: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    functions = tmp_path / "uav.json"
    functions.write_text('{"functions": []}', encoding="utf-8")
    assert run(["import", "scxml", str(functions)]) == 1
    assert "it looks like JSON: `swarmc import adf` or `amf` reads that" in capsys.readouterr().err
    assert run(["import", "adf", str(door)]) == 1
    assert "it looks like XML: use `swarmc import scxml`" in capsys.readouterr().err


def test_a_file_is_never_overwritten(
    door: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "gate.swarm"
    out.write_text("mine", encoding="utf-8")

    for force in ([], ["--force"]):
        assert run(["import", "scxml", str(door), "-o", str(out), *force]) == 1
        assert "SW0101" in capsys.readouterr().err
        assert out.read_text(encoding="utf-8") == "mine"


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="pipes with names are of POSIX")
@pytest.mark.parametrize("linked", [False, True])
def test_a_pipe_stays_one(
    linked: bool, door: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    pipe = out = tmp_path / "pipe"
    os.mkfifo(pipe)
    if linked:
        out = tmp_path / "link"
        out.symlink_to(pipe)

    assert run(["import", "scxml", str(door), "-o", str(out)]) == 1
    assert (
        f"error[SW0909]: cannot write `{out}`: it is not a regular file" in capsys.readouterr().err
    )
    assert pipe.is_fifo()
    assert out.is_symlink() == linked


def test_a_link_to_an_empty_file_stays_one(door: Path, tmp_path: Path) -> None:
    out, place = tmp_path / "door.swarm", tmp_path / "place.swarm"
    place.touch()
    out.symlink_to(place)

    assert run(["import", "scxml", str(door), "-o", str(out)]) == 0
    assert out.is_symlink()
    assert place.read_text(encoding="utf-8").startswith("package door")


def test_nothing_is_written_where_there_is_an_error(tmp_path: Path) -> None:
    path, out = tmp_path / "a.xml", tmp_path / "a.swarm"
    path.write_text("<scxml>", encoding="utf-8")

    assert run(["import", "scxml", str(path), "-o", str(out)]) == 1
    assert run(["import", "scxml", str(tmp_path / "no.xml"), "-o", str(out)]) == 1
    assert not out.exists()


def test_files_without_content(tmp_path: Path) -> None:
    path = tmp_path / "a.xml"
    path.write_text('<scxml xmlns="http://www.w3.org/2005/07/scxml"/>', encoding="utf-8")
    adf = tmp_path / "a.json"
    adf.write_text('{"functions": []}', encoding="utf-8")

    for kind, file in (("scxml", path), ("adf", adf)):
        done = import_files(kind, [file], [], None, force=False)  # type: ignore[arg-type]
        assert [found.name for found in done.report] == ["nothing-to-import"]


def test_a_model_with_an_error_is_not_written(tmp_path: Path) -> None:
    # No value can be made up for the pose that this service of ROS asks for.
    body = (
        "<rosservice><name>plan</name><srv>nav_msgs/GetPlan</srv>"
        "<request type='empty'/><response type='empty'/></rosservice>"
    )
    text = (
        "<scxml xmlns='http://www.w3.org/2005/07/scxml'><state id='A'><datamodel>"
        f"<data id='invoke'>{body}</data></datamodel><invoke type='ROS_SERVICE'/>"
        "<transition event='succeeded aborted' target='B'/></state><final id='B'/></scxml>"
    )
    path, out = tmp_path / "a.xml", tmp_path / "a.swarm"
    path.write_text(text, encoding="utf-8")
    report = import_files("scxml", [path], [], out, force=False).report

    (error,) = (found for found in report if found.severity is Severity.ERROR)
    assert error.name == "no-model"
    assert "SW0602" in error.message
    assert not out.exists()


def test_functions_are_found_in_adf_files(tmp_path: Path) -> None:
    definition = {"name": "cmd/lift", "class": "arm_msgs/Lift"}
    api = {"comm_model": {"paradigm": "rosaction", "definition": definition}}
    adf, out = tmp_path / "arm.json", tmp_path / "arm.swarm"
    adf.write_text(json.dumps({"functions": [{"name": "lift", "api": api}]}), encoding="utf-8")

    assert run(["import", "adf", str(adf), "-o", str(out)]) == 0
    assert pipeline.check([out]).system is not None
    assert "function lift : abstraction {" in out.read_text(encoding="utf-8")


def test_fields_that_nothing_names_lead_to_a_description(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    scxml = tmp_path / "arm.xml"
    scxml.write_text(
        """<scxml xmlns="http://www.w3.org/2005/07/scxml" version="1.0" name="arm">
  <state id="Lift">
    <invoke type="ROS_ACTION"/>
    <datamodel><data id="invoke"><rosaction>
      <name>cmd/lift</name><action>arm_msgs/Lift</action>
      <goal type="fixed"><param>2.5</param></goal><result type="empty"/>
    </rosaction></data></datamodel>
    <transition event="succeeded" target="End"/><transition event="aborted" target="End"/>
  </state>
  <final id="End"/>
</scxml>
""",
        encoding="utf-8",
    )
    assert run(["import", "scxml", str(scxml)]) == 0
    out, err = capsys.readouterr()
    assert "do lift(value1 = 2.5)" in out
    assert "= help: give the ADF file of the function with `--adf`" in err


def vertices(system: System) -> dict[str, object]:
    """Describe each state by its behavior, with servers in place of names."""

    def described(state: State) -> object:
        does = state.activity
        server = system.function(does.function).communication if does is not None else None
        inner = (does.arguments, does.results, bool(does.goal_callback)) if does else None
        ways = {(each.triggers, each.target) for each in state.transitions}
        return state.kind, state.initial, ways, server, inner

    return {state.id: described(state) for state in system.machines[0].walk()}


def written_again(system: System, folder: Path) -> System | None:
    """The system after a way through the CPSwarm dialect; None where that cannot express it."""
    model = folder / "model.swarm"
    model.write_text(print_system(system), encoding="utf-8")
    pipeline.build([model], [Request("scxml", {})], folder / "out")
    files = list((folder / "out").rglob("*.cpswarm.xml"))
    if not files:
        return None
    text = files[0].read_text(encoding="utf-8")
    return import_scxml([Source("again.xml", text)], [], "model", Diagnostics())


OURS = """package shop
event Stop : std_msgs/Empty
swarm event Shift : swarmros/SimpleEvent
function lift : abstraction { action "cmd/lift" : arm_msgs/Lift }
function rest : swarm { service "rest" : arm_msgs/Rest }
statemachine Keeper {
  var height : string
  initial Idle
  state Idle { on Shift -> Work }
  state Work {
    initial Fetch
    state Fetch {
      do lift(top = height) gives (reached => height)
      on succeeded -> Wait
      on aborted   -> Fetch
    }
    state Wait {
      do rest
      on succeeded -> Fetch
      on aborted   -> Park
    }
    on Stop -> Park
  }
  state Park {
    do rest(by make_rest)
    on succeeded -> Idle
    on aborted   -> Park
  }
  final End
}
"""


def test_what_is_written_for_cpswarm_comes_back(tmp_path: Path) -> None:
    model = tmp_path / "shop.swarm"
    model.write_text(OURS, encoding="utf-8")
    system = pipeline.check([model]).system
    assert system is not None
    again = written_again(system, tmp_path)

    assert again is not None
    before = vertices(system)
    del before["End"]  # nothing leads there, and the dialect has no such state
    assert vertices(again) == before
    assert {(e.name, e.topic, e.swarm) for e in again.events} == {
        ("Shift", "shift", True),
        ("Stop", "stop", False),
    }


@pytest.mark.skipif(not SCXML, reason=f"no real files in {CORPUS} (set SWARMDSL_CORPUS)")
@pytest.mark.parametrize("path", SCXML, ids=lambda path: path.stem)
def test_real_documents(path: Path, tmp_path: Path) -> None:
    out = tmp_path / "model.swarm"
    done = import_files("scxml", [path], [], out, force=False)

    assert not done.report.has_errors
    system = pipeline.check([out]).system
    assert system is not None
    again = written_again(system, tmp_path)
    if again is not None:
        assert vertices(again) == vertices(system)


@pytest.mark.skipif(not SCXML, reason=f"no real files in {CORPUS} (set SWARMDSL_CORPUS)")
def test_a_real_document_with_what_describes_its_functions(tmp_path: Path) -> None:
    out = tmp_path / "model.swarm"
    described = CORPUS / "adf" / "head_scxml.json"
    done = import_files(
        "scxml", [CORPUS / "scxml" / "head_UAV_sar_FSM2.xml"], [described], out, force=False
    )

    assert not done.report.has_errors
    text = out.read_text(encoding="utf-8")
    assert "do uav_mavros_takeoff(altitude = 1.5)" in text


@pytest.mark.skipif(not ADF, reason=f"no real files in {CORPUS} (set SWARMDSL_CORPUS)")
@pytest.mark.parametrize("path", ADF, ids=lambda path: path.stem)
def test_real_adf_files(path: Path, tmp_path: Path) -> None:
    out = tmp_path / "model.swarm"
    done = import_files("adf", [path], [], out, force=False)

    if path.stem == "2019-11-18_json":  # three letters stand in the middle of it
        assert [found.name for found in done.report] == ["not-json"]
    else:
        assert pipeline.check([out]).system is not None
