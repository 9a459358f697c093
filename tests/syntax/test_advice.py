"""Advice for mistakes that new users make: a model that follows it literally is correct."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostic, Severity
from swarmdsl.driver import pipeline

MODEL = """package p

event A : std_msgs/Empty
event B : std_msgs/Empty
swarm event E : std_msgs/Empty

function go : abstraction { action "go" : p_msgs/Go }

statemachine M {
  param limit : float64 = 50.0
  var x : float64 = 1.0
  var n : int32 = 5
  var k : int32 = 5
  var b : bool

  initial S
  state S {
    STATEMENT
    on B [limit > x and b and n + k > 3] / x = x + 1, n = n + 1, k = n, b = not b -> Done
  }
  final Done
}
"""
ELSE = "on succeeded, aborted -> Done"
# A statement of a state, the part of it that is wrong, and what the help has for it: `{0}` is what
# it has in the first backquotes.
STATEMENTS = (
    ("on A, after 5 s -> Done", "on A, after 5 s -> Done", "{0}\n{1}"),
    ("on A or after 5 s / n = 1 -> Done", "on A or after 5 s / n = 1 -> Done", "{0}; {1}"),
    ("after 5 s, on A [n > 1] -> Done", "after 5 s, on A [n > 1] -> Done", "{0}; {1}"),
    ("on A / n = n / 2", "n / 2", "{1}"),
    ("on A / n = (n + 1) / 2", "(n + 1) / 2", "{1}"),
    ("on A / n = x", "= x", "= {0}"),
    (f"do go; on succeeded && x > 3 -> Done; {ELSE}", "on succeeded && x > 3", "{0}"),
    (f"do go; on succeeded and not b -> Done; {ELSE}", "on succeeded and not b", "{0}"),
    ("on A && b / n = 1 -> Done", "on A && b", "{0}"),
    ("on A -> Done / n = 1", "on A -> Done / n = 1", "{0}"),
    ("on A -> Done [n > 1] / n = 1", "on A -> Done [n > 1] / n = 1", "{0}"),
    ("on A [n > 1] -> Done / n = 1, send B", "on A [n > 1] -> Done / n = 1, send B", "{0}"),
    ("[n > 1] -> Done / n = 1", "[n > 1] -> Done / n = 1", "{0}"),
    ("on B / k = 2; on A -> Done / n = 1", "on A -> Done / n = 1", "{0}"),
    ("on A -> Done / n = 1; exit / n = 2", "on A -> Done / n = 1", "{0}"),
    ("on A -> Done / n = 1 // twice", "on A -> Done / n = 1", "{0}"),
    ("on A / defer", "on A / defer", "{0}"),
    ("on A / send E after 5 s to uav", "send E after 5 s to uav", "{0}"),
    ("on A [in T] -> Done; initial T; state T", "in T", "{0}"),
    ("on A [elapsed > 3 s] -> Done", "elapsed", "{0}"),
    ("timeout 5 s -> Done", "timeout 5 s", "{0}"),
    ("timeout(5 s) -> Done", "timeout(5 s)", "{0}"),
    ("on timeout 500 ms -> Done", "on timeout 500 ms", "{0}"),
    ("on timeout(5 s) -> Done", "on timeout(5 s)", "{0}"),
    ("on timeout -> Done", "on timeout -> Done", "{1}"),
    ("entry { n = 1 }", "entry { n = 1 }", "{0}"),
    ("exit { n = 1, send B }", "exit { n = 1, send B }", "{0}"),
    ("entry {\nn = 1\nsend A\n}", "entry {\nn = 1\nsend A\n}", "{0}"),
    ("entry { }", "entry { }", ""),
    ("entry n = 1", "entry n = 1", "{0}"),
    ("exit send B", "exit send B", "{0}"),
    ("on A -> [*]", "-> [*]", "{1}"),
    ("on A / n = 1 -> [*]", "-> [*]", "{1}"),
)
# Imports and values outside of state machines.
DECLARATIONS = (
    (
        "import sensor_msgs/BatteryState\nevent Low : sensor_msgs/BatteryState",
        "import sensor_msgs/BatteryState",
        "",
    ),
    (
        "import sensor_msgs/msg/BatteryState\nevent Low : sensor_msgs/msg/BatteryState",
        "import sensor_msgs/msg/BatteryState",
        "",
    ),
    (
        "import sensor_msgs.BatteryState\nevent Low : sensor_msgs/BatteryState",
        "import sensor_msgs.BatteryState",
        "",
    ),
)
# What the advice leaves to the user to name.
NAMES = {"Target": "Done", "State": "T", "pending": "b", "Event": "B"}


def _errors(text: str, folder: Path) -> list[Diagnostic]:
    file = folder / "model.swarm"
    file.write_text(text, encoding="utf-8")
    return [each for each in pipeline.check([file]).report if each.severity is Severity.ERROR]


@pytest.mark.parametrize(("statement", "wrong", "right"), STATEMENTS)
def test_advice_on_a_statement(statement: str, wrong: str, right: str, tmp_path: Path) -> None:
    (error,) = _errors(MODEL.replace("STATEMENT", statement), tmp_path)
    assert error.primary is not None
    assert error.primary.span.text in wrong

    quoted = [
        re.sub(r"\b[A-Z]\w+|\bpending\b", lambda found: NAMES.get(found[0], found[0]), each)
        for each in re.findall(r"`([^`]+)`", error.help or "")
        if "without" not in each
    ]
    followed = statement.replace(wrong, right.format(*quoted))
    if "initial" not in followed and "state T" in followed:
        followed = f"initial T\n{followed}"

    assert _errors(MODEL.replace("STATEMENT", followed), tmp_path) == [], followed


@pytest.mark.parametrize(("text", "wrong", "right"), DECLARATIONS)
def test_advice_on_a_declaration(text: str, wrong: str, right: str, tmp_path: Path) -> None:
    (error,) = _errors(text, tmp_path)
    quoted = re.findall(r"`([^`]+)`", error.help or "")

    followed = text.replace(wrong, right.format(*quoted))

    assert _errors(followed, tmp_path) == [], followed
