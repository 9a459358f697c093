"""The text of generated packages: valid, complete, and the same in Python and XML."""

from __future__ import annotations

import ast
from collections.abc import Callable
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest
from lxml import etree

from swarmdsl.base.naming import snake_case
from swarmdsl.driver import pipeline
from swarmdsl.ir import System

from ..ros2.test_output import BARE, FORMAT, LINTERS, ruff
from ..ros2_outcomes.agreement import ROOT

MODEL = """package lab
message Note { level : int32 }
action Move { goal { x : float64 } }
service Ask { }
function move : abstraction { action "move" : Move }
function ask  : abstraction { service "ask" : Ask }
event Go   : Note
event Stop : Note
/// Works "hard" \\\\ <b>
statemachine Work {
  /// how <far>
  param far : float64 = 1.0
  var n : int32
  initial Both
  /// Two "things" \\\\ at a time
  parallel state Both {
    region L { initial A; state A { do move(x = far); on succeeded, aborted -> Z } final Z }
    region R { initial A; state A { do ask; on succeeded, aborted -> Z } final Z }
    on done -> Box
    on Stop -> Gone
  }
  state Box { initial In; state In { on Go -> Deep } state Deep { on Go -> Box } history H -> In
    on Stop -> Gone }
  state Gone { on Go -> Box.H; after 1 s -> End }
  state Lost { on Go -> End }
  final End
}
"""


def described(state: Any) -> Any:
    """Return the visible properties of a YASMIN state and its children."""
    found: dict[str, Any] = {"outcomes": sorted(state.get_outcomes())}
    if hasattr(state, "get_transitions"):
        found["start"] = state.get_start_state()
        found["states"] = {
            name: (type(each["state"]).__name__, described(each["state"]), each["transitions"])
            for name, each in state.get_states().items()
        }
    elif hasattr(state, "get_outcome_map"):
        found["map"] = {name: dict(needs) for name, needs in state.get_outcome_map().items()}
        found["states"] = {name: described(each) for name, each in state.get_states().items()}
    return found


def made(element: etree._Element, yasmin: ModuleType, module: ModuleType) -> Any:
    """Build an element as `yasmin_factory` does."""
    if element.tag == "State":
        assert element.get("module") == module.__name__
        return getattr(module, element.get("class"))()
    inside = {
        each.get("name"): (
            made(each, yasmin, module),
            {t.get("from"): t.get("to") for t in each.findall("Transition")},
        )
        for each in element
        if each.tag in ("State", "StateMachine", "Concurrence")
    }
    if element.tag == "Concurrence":
        maps = {
            each.get("outcome"): {item.get("state"): item.get("outcome") for item in each}
            for each in element.findall("OutcomeMap")
        }
        states = {name: state for name, (state, _) in inside.items()}
        return yasmin.Concurrence(states, element.get("default_outcome"), maps)
    machine = yasmin.StateMachine(set(element.get("outcomes").split(" ")))
    for name, (state, transitions) in inside.items():
        machine.add_state(name, state, transitions)
    machine.set_start_state(element.get("start_state"))
    return machine


def systems(compiled: Callable[[str], System]) -> list[System]:
    """The model above, and the examples that this target can express."""
    found = [compiled(MODEL)]
    for name in ("minimal", "search_and_rescue", "emergency_exit", "flocking"):
        system = pipeline.check([ROOT / "examples" / name]).system
        assert system is not None
        found.append(system)
    return found


def test_xml_and_python_say_the_same(
    build: Callable[..., ModuleType], compiled: Callable[[str], System]
) -> None:
    for system in systems(compiled):
        for machine in system.machines:
            module = build(system, machine.name, _Chart())
            assert module.__file__ is not None
            folder = Path(module.__file__).parents[1] / "state_machines"
            path = folder / f"{snake_case(machine.name)}.xml"
            import yasmin  # type: ignore[import-not-found]

            root = etree.parse(str(path)).getroot()
            assert root.get("name") == machine.name
            python, xml = module.build(), made(root, yasmin, module)
            python.validate(True)
            xml.validate(True)
            assert described(python) == described(xml)


class _Chart:
    """A machine of which nothing needs to be known."""

    states = ()


def test_keys_of_the_blackboard_are_in_the_xml(generate: Callable[..., dict[str, str]]) -> None:
    root = etree.fromstring(generate(MODEL)["state_machines/work.xml"].encode())
    keys = [(key.get("name"), key.get("description")) for key in root.findall("Key")]
    assert keys == [("far", "how <far>"), ("n", None)]


def test_what_nothing_leads_to_is_left_out(generate: Callable[..., dict[str, str]]) -> None:
    files = generate(MODEL)
    assert "Lost" not in files["state_machines/work.xml"]
    assert "Lost" not in files["lab_behavior/work_fsm.py"]
    assert "Lost" in files["lab_behavior/work.py"]


def test_the_manifest_and_setup(generate: Callable[..., dict[str, str]]) -> None:
    files = generate(MODEL)
    manifest = etree.fromstring(files["package.xml"].encode())
    depends = {each.text for each in manifest.findall("depend")}
    assert depends >= {"rclpy", "yasmin", "yasmin_ros", "yasmin_viewer", "lab"}
    assert "yasmin_factory" in {each.text for each in manifest.findall("test_depend")}
    assert "'work = lab_behavior.work_fsm:main'" in files["setup.py"]
    assert "glob('state_machines/*.xml')" in files["setup.py"]


@pytest.mark.parametrize("options", [{}, {"lifecycle": "true"}], ids=["plain", "lifecycle"])
@pytest.mark.parametrize("model", [MODEL, BARE], ids=["full", "bare"])
def test_linters_of_ros_find_nothing(
    generate: Callable[..., dict[str, str]], tmp_path: Path, model: str, options: dict[str, str]
) -> None:
    for path, text in generate(model, **options).items():
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / path).write_text(text, encoding="utf-8")
        if path.endswith(".py"):
            ast.parse(text, path, feature_version=(3, 10))

    assert ruff("check", *LINTERS, tmp_path) == ""
    assert ruff("format", "--check", *FORMAT, tmp_path) == ""
