"""Packages of state machines: code and parameters of the user when the model changes."""

from __future__ import annotations

from pathlib import Path

import pytest

from swarmdsl.codegen.emit import Request
from swarmdsl.driver import pipeline

MODEL = """package lab
function work : abstraction {
  action "cmd/work" : lab_msgs/Work
}
statemachine Duty {
  initial Working
  state Working {
    do work(by make_goal)
    on succeeded, aborted -> Done
  }
  final Done
}
member Robot { behavior Duty; param speed : float64 = 1.0 }
swarm Team { robot : Robot[1] }
"""


def build(folder: Path, target: str, text: str) -> list[str]:
    (folder / "lab.swarm").write_text(text, encoding="utf-8")
    result = pipeline.build([folder / "lab.swarm"], [Request(target)], folder / "out")
    assert result.written is not None, [found.message for found in result.report]
    return [f"{found.name}: {found.message} {found.notes} {found.help}" for found in result.report]


def fill_in(folder: Path, name: str) -> Path:
    (path,) = (folder / "out").rglob(name)
    path.write_text(path.read_text(encoding="utf-8") + "# mine\n", encoding="utf-8")
    return path


@pytest.mark.parametrize("target", ["smach", "ros2"])
def test_callbacks_that_the_model_names_anew_are_told(target: str, tmp_path: Path) -> None:
    build(tmp_path, target, MODEL)
    path = fill_in(tmp_path, "callbacks.py")
    (told,) = build(tmp_path, target, MODEL.replace("by make_goal", "by other_goal"))

    assert told.startswith("outdated-code: ")
    assert "'- make_goal(" in told
    assert "'+ other_goal(" in told
    assert path.read_text(encoding="utf-8").endswith("# mine\n")
    assert build(tmp_path, target, MODEL) == []


@pytest.mark.parametrize("target", ["smach", "ros2"])
def test_parameters_of_a_role_are_those_of_its_new_name(target: str, tmp_path: Path) -> None:
    build(tmp_path, target, MODEL)
    fill_in(tmp_path, "robot_0.yaml")
    told = build(tmp_path, target, MODEL.replace("robot : Robot", "scout : Robot"))

    assert [each.partition(":")[0] for each in told] == ["parked-code", "renamed-element"]
    assert "--rename robot=scout" in told[1]


@pytest.mark.parametrize("target", ["smach", "ros2", "yasmin"])
def test_the_readme_tells_the_params_without_a_value(target: str, tmp_path: Path) -> None:
    text = MODEL.replace("  initial W", "  param levels : float64[2]\n  initial W").replace(
        "{ behavior Duty;", "{ behavior Duty; param levels : float64[2];"
    )
    build(tmp_path, target, text)
    (readme,) = (tmp_path / "out").rglob("README.md")
    told = readme.read_text(encoding="utf-8")
    assert "## Values to give\n" in told
    assert "| Team | robot | duty | `levels` | `float64[2]` |\n" in told

    build(tmp_path, target, MODEL)
    assert "## Values to give" not in readme.read_text(encoding="utf-8")
