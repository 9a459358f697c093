"""Constants and enums in expressions, of this and of other packages."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from swarmdsl.base.diagnostics.collector import Severity
from swarmdsl.codegen.swarm_printer.expressions import expression
from swarmdsl.driver import pipeline
from swarmdsl.ir import Expression

Checked = Callable[[str], pipeline.Result]

SAR = """
  package sar.modes
  enum Mode { OFF, ON }
  const K : int32 = 3
  type Usual = Mode
"""
AIR = """
  package air
  enum Mode { NO = 5, YES }
  const K : int32 = 4
  const ONLY : int32 = 7
  struct Pose { x : int32 }
"""


@pytest.fixture
def checked(tmp_path: Path) -> Checked:
    """Check a file that imports two packages with the same names."""

    def check(text: str) -> pipeline.Result:
        (tmp_path / "sar.swarm").write_text(SAR, encoding="utf-8")
        (tmp_path / "air.swarm").write_text(AIR, encoding="utf-8")
        main = tmp_path / "main.swarm"
        main.write_text(f'import "sar.swarm"\nimport "air.swarm"\n{text}', encoding="utf-8")
        return pipeline.check([main])

    return check


def machine(values: str = "", guard: str = "true") -> str:
    return f"""
      event Go : std_msgs/Empty
      type Alias = air.Mode
      type Chain = Alias
      const OWN : int32 = sar.modes.K - air.K
      enum Level {{ LOW, HIGH }}
      statemachine M {{
        {values}
        initial A
        state A {{ on Go [{guard}] -> F }}
        final F
      }}
    """


def guard_of(result: pipeline.Result) -> str:
    assert result.system is not None, [found.message for found in result.report]
    guard: Expression | None = result.system.machines[0].states[0].transitions[0].guard
    assert guard is not None
    return expression(guard)


@pytest.mark.parametrize(
    ("guard", "meant"),
    [
        ("n == sar.modes.K", "n == 3"),
        ("n == air.K * (-air.K)", "n == 4 * -4"),
        ("n == ONLY", "n == 7"),
        ("n == min(air.ONLY, OWN)", "n == min(7, -1)"),
        ("n == main.OWN", "n == -1"),
        ("a == sar.modes.Mode.ON", "a == 1"),
        ("a == Usual.OFF or a == sar.modes.Usual.ON", "a == 0 or a == 1"),
        ("b != Alias.YES and b != Chain.NO", "b != 6 and b != 5"),
        ("b == main.Alias.YES", "b == 6"),
        ("l == Level.HIGH or l == main.Level.LOW", "l == 1 or l == 0"),
        # The machine's own values come first.
        ("air.x == air.x + K", "air.x == air.x + K"),
    ],
)
def test_resolved_names(checked: Checked, guard: str, meant: str) -> None:
    own = "; var air : air.Pose; param K : int32 = 1" if "air.x" in guard else ""
    values = f"var n : int32; var a : sar.modes.Mode; var b : Chain = Chain.NO; var l : Level{own}"

    assert guard_of(checked(machine(values, guard))) == meant


@pytest.mark.parametrize(
    ("guard", "message", "help_"),
    [
        ("K == 3", "`K` is ambiguous", "write `sar.modes.K` or `air.K`"),
        (
            "Mode.ON == sar.modes.Mode.ON",
            "`Mode` is ambiguous",
            "write `sar.modes.Mode` or `air.Mode`",
        ),
        ("air.ONLI == 3", "no value called `air.ONLI`", "did you mean `air.ONLY`?"),
        ("OWM == 3", "no value called `OWM`", "did you mean `OWN`?"),
        ("sar.K == 3", "no value called `sar`", None),
        ("HIGH == Level.LOW", "no value called `HIGH`", "write `Level.HIGH`"),
        (
            "air.Mode.YEP == air.Mode.NO",
            "no value of enum `Mode` called `YEP`",
            "did you mean `YES`?",
        ),
        ("air.Pose == 1", "`air.Pose` is a struct, not a value", None),
        ("Time.X == 1", "`Time` is the type `float64`, not a value", None),
        (
            "air.Mode == Alias.NO",
            "`air.Mode` does not work on its own: name one of its values",
            "write `air.Mode.NO`",
        ),
        (
            "air.Mode.NO == sar.modes.Mode.OFF",
            "`==` does not work on `air/Mode` and `sar_modes/Mode`",
            None,
        ),
        ("air.K.x == 1", "a value of type `int32` has no field `x`", None),
    ],
)
def test_mistakes(checked: Checked, guard: str, message: str, help_: str | None) -> None:
    result = checked(f"type Time = float64\n{machine(guard=guard)}")

    errors = [found for found in result.report if found.severity is Severity.ERROR]
    assert [(found.message, found.help) for found in errors] == [(message, help_)]


def test_names_of_a_missing_import_are_not_reported(checked: Checked) -> None:
    result = checked(f'import "gone.swarm"\n{machine(guard="GONE == gone.MORE")}')

    assert [found.name for found in result.report] == ["file-not-found"]


def test_a_constant_is_not_assigned_to(checked: Checked) -> None:
    result = checked(machine(guard="true").replace("] ->", "] / air.K = 3 ->"))

    assert "not-assignable" in [found.name for found in result.report]


def test_a_constant_by_its_package_keeps_no_check_from_looking(checked: Checked) -> None:
    found = checked(machine("var x : int32\n", "x < sar.modes.K").replace("->", "/ x = 1 ->"))
    assert [one.name for one in found.report] == ["early-read"]
