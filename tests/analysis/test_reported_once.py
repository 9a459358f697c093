"""One mistake is reported once, even if several checks could report it."""

from __future__ import annotations

from pathlib import Path

import pytest

from swarmdsl.driver import pipeline

MACHINE = """
event Go : std_msgs/Empty
enum Gear {{ SLOW, FAST }}
function land : abstraction {{ action "land" : uav_msgs/Land }}
enum Mode {{ SLOW, FAST }}
statemachine M {{
  var gear : Gear = Gear.SLOW
  initial Look
  state Look {{
    initial Near
    state Near {{ on Go -> Near }}
    {transitions}
    on Go / gear = gear -> Done
  }}
  final Done
}}
"""


@pytest.mark.parametrize(
    ("transitions", "wanted"),
    [
        ("on done.Found -> Done", ["SW0202"]),
        ("on done.Found -> Done; on done.Found -> Done", ["SW0202", "SW0202"]),
        ("on done -> Done", ["SW0508"]),
        ("on Go [gear == Mode.SLOW] -> Done", ["SW0702"]),
        ("on Go [gear == Mode.SLOW] -> Done; on Go [gear == Mode.SLOW] -> Near", ["SW0702"] * 2),
        ("on Go [gear == 5] -> Done; on Go [gear < Gear.FAST] -> Near", ["SW0702"] * 2),
    ],
)
def test_in_transitions(transitions: str, wanted: list[str], tmp_path: Path) -> None:
    assert codes(MACHINE.format(transitions=transitions), tmp_path) == wanted


@pytest.mark.parametrize(
    ("values", "wanted"),
    [
        ("A, D = 300, A", ["SW0609", "SW0201"]),
        ("A = 300, B = 1, A = 400", ["SW0609", "SW0201"]),
        ("A, B = 7, A, C = 8", ["SW0201"]),
    ],
)
def test_in_values_of_an_enum(values: str, wanted: list[str], tmp_path: Path) -> None:
    assert codes(f"enum Mode {{ {values} }}", tmp_path) == wanted


@pytest.mark.parametrize(
    ("transitions", "wanted"),
    [
        ("after 5 s / raise Go -> Done", ["SW0101"]),
        ("after 5 s / call land -> Done", ["SW0101"]),
    ],
)
def test_behind_a_syntax_error(transitions: str, wanted: list[str], tmp_path: Path) -> None:
    assert codes(MACHINE.format(transitions=transitions), tmp_path) == wanted


def test_types_before_names(tmp_path: Path) -> None:
    text = "member Uav {\n  param float64 y\n  param float64 z\n}\n"

    assert codes(text, tmp_path) == ["SW0101", "SW0101"]


def test_names_that_are_types_are_declared_once(tmp_path: Path) -> None:
    text = "member Uav {\n  param time : float64\n  param time : float64\n}\n"

    assert codes(text, tmp_path) == ["SW0201"]


def codes(text: str, folder: Path) -> list[str]:
    """Return the codes of the diagnostics of a model."""
    path = folder / "model.swarm"
    path.write_text(text, encoding="utf-8")
    return [found.code for found in pipeline.check([path]).report]
