"""Satisfiability of guards: certain and uncertain results."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from swarmdsl.driver import pipeline

MODEL = """
event Go : std_msgs/Empty
enum Mode {{ MANUAL, AUTO }}
enum Late {{ FIRST = 1, SECOND = 2 }}

statemachine M {{
  param other : int32 = 1
  var n    : int32   = 0
  var x    : float64 = 0.0
  var b    : bool    = false
  var name : string  = ""
  var mode : Mode    = Mode.AUTO
  var late : Late    = Late.FIRST
  initial Wait
  state Wait {{
{transitions}
    on Go / n = n + other, x = x + n, b = not b, name = name + "a", mode = Mode.AUTO -> Wait
    after 1 s [x > n or b or name == "" or mode == Mode.AUTO or late == Late.FIRST]
      / late = Late.FIRST -> Done
  }}
  final Done
}}
"""


@pytest.fixture
def codes(tmp_path: Path) -> Callable[[list[str]], list[str]]:
    def check(guards: list[str]) -> list[str]:
        lines = "\n".join(f"    on Go [{guard}] -> Done" for guard in guards)
        path = tmp_path / "model.swarm"
        path.write_text(MODEL.format(transitions=lines), encoding="utf-8")
        return [found.code for found in pipeline.check([path]).report]

    return check


@pytest.mark.parametrize(
    "guard",
    [
        "n > 3 and n < 4",
        "n > 2.5 and n < 2.75",
        "n == 2.5",
        "x > 3 and x < 3",
        "x > 3 and x <= 3",
        "x > 3 and not (x > 2)",
        "len(name) < 0",
        'name == "a" and name == "b"',
        "mode == Mode.AUTO and mode == Mode.MANUAL",
        "mode != Mode.AUTO and mode != Mode.MANUAL",
        "b and not b",
        "b == true and b != true",
        "n < other and other > n and not (n < other)",
        "n + 1 > 3 and n + 1 < 2",
        "(n < 1 or n > 5) and n > 1 and not (n >= 4)",
        "3 < n and 2 >= n",
        "hypot(x, n) < 0",
        "div(n, 3) == 1.5",
    ],
)
def test_guards_that_hold_for_no_value(guard: str, codes: Callable[[list[str]], list[str]]) -> None:
    assert codes([guard]) == ["SW0519"]
    # The other way round it always holds.
    assert codes([f"not ({guard})"]) == ["SW0519"]


def test_a_wave_is_between_its_bounds(codes: Callable[[list[str]], list[str]]) -> None:
    assert codes(["sin(x * 1 rad) > 1"]) == ["SW0519"]
    assert codes(["cos(x * 1 rad) < -1 or b and not b"]) == ["SW0519"]


@pytest.mark.parametrize(
    "guard",
    [
        "x > 3 and x < 4",
        "not (x > 3) and not (x <= 3)",  # what is not a number
        "x != x",
        "n >= 3 and n <= 3",
        'name != "a" and name != "b"',
        "late != Late.FIRST and late != Late.SECOND",  # a message may hold 0
        "n < other and n > 3 and other < 2 or b",
        "n > other and other > n",  # not looked at together
        "n > 3 and other < 3",
        "n > 3 or n < 9 and b",
        "hypot(x, n) <= 0",
        "sin(x * 1 rad) >= 1",
        "floor(x) > 3 and floor(x) < 5",
    ],
)
def test_guards_that_may_hold(guard: str, codes: Callable[[list[str]], list[str]]) -> None:
    assert codes([guard]) == []


@pytest.mark.parametrize(
    "guards",
    [
        ["n > 3", "n > 5"],
        ["n > 3", "n >= 4"],
        ["x > 3", "x > 3.5 and b"],
        ["n < 3 or b", "b and n > 7"],
        ["b", "not b and n > 3", "n > 4"],
        ["n < other", "other > n"],
        ["mode == Mode.AUTO", "n > 1 or n < -1", "mode == Mode.AUTO and n == 0"],
        ["n > 0", "n < 0", "n != 0"],
        ["1 / n > 1", "1 / n > 1"],
        ["n % 3 == 0", "n % 3 != 0", "n == 7"],
        ["div(n, 3) == 0", "div(n, 3) != 0", "n == 7"],
        ['name == "a" or name == "b"', 'name == "b"'],
    ],
)
def test_guards_after_others_that_cover_them(
    guards: list[str], codes: Callable[[list[str]], list[str]]
) -> None:
    assert codes(guards) == ["SW0504"]


@pytest.mark.parametrize(
    "guards",
    [
        ["n > 5", "n > 3"],
        ["x > 3", "not (x <= 3)"],
        ["x > 3", "x <= 3", "n > 3"],
        ["late == Late.FIRST", "late == Late.SECOND", "n > 3"],
        ["n > 3 and b", "n > 5"],
        ["n < other", "n > other"],
        ["n > 3", "x > 5"],
        ["n + 1 > 3", "n > 5"],
        ["1 / n > 1 or n > 3", "n > 5"],  # a guard without a result does not hold
        ["1 / n > 1", "not (1 / n > 1)", "n > 5"],
        ["div(1, n) > 1", "div(1, n) <= 1", "n > 5"],
        ["floor(x) > 3", "floor(x) <= 3", "n > 5"],
    ],
)
def test_guards_after_others_that_leave_values(
    guards: list[str], codes: Callable[[list[str]], list[str]]
) -> None:
    assert codes(guards) == []


@pytest.mark.parametrize(
    ("branches", "complete"),
    [
        (["b", "not b"], True),
        (["n > 3", "n <= 3"], True),
        (["n > 3", "n < 3"], False),
        (["x > 3", "x <= 3"], False),
        (["x > 3", "not (x > 3)"], True),
        (["mode == Mode.AUTO", "mode == Mode.MANUAL"], True),
        (["late == Late.FIRST", "late == Late.SECOND"], False),
    ],
)
def test_a_choice_whose_guards_cover_everything_needs_no_else(
    branches: list[str], complete: bool, tmp_path: Path
) -> None:
    lines = "\n".join(f"    [{branch}] -> Done" for branch in branches)
    text = MODEL.format(transitions="    after 2 h -> Fork").replace(
        "  final Done", f"  choice Fork {{\n{lines}\n  }}\n  final Done"
    )
    path = tmp_path / "model.swarm"
    path.write_text(text, encoding="utf-8")

    result = pipeline.check([path])

    assert [found.code for found in result.report] == ([] if complete else ["SW0510"])


def test_many_alternatives_take_no_time(codes: Callable[[list[str]], list[str]]) -> None:
    alternatives = [f"(n + {i} == {i} or x + {i} > {i} or b)" for i in range(30)]

    assert codes([" and ".join(alternatives[:12]), " or ".join(alternatives)]) == []
