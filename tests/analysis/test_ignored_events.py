"""Swarm events that arrive in states that ignore them, with `--warn ignored-event`."""

from __future__ import annotations

from pathlib import Path

import pytest

from swarmdsl.base.diagnostics.collector import Level
from swarmdsl.driver import pipeline
from swarmdsl.driver.pipeline import Settings

MODEL = """
swarm event Go : std_msgs/Empty
member Uav {{ behavior Search }}
member Base {{ behavior Guide }}
swarm Land {{ {roles} }}
statemachine Search {{
  initial Rest
  {states}
  state Look {{ on Go -> Over }}
  final Over
}}
statemachine Guide {{
  initial Call
  state Call {{ after 1 s / send Go{to} -> Over }}
  final Over
}}
"""
BOTH = "uav : Uav[2]; base : Base"


def found(
    folder: Path, states: str, *, roles: str = BOTH, to: str = "", asked: bool = True
) -> list[str]:
    """Return the messages of the check about a model."""
    model = folder / "model.swarm"
    model.write_text(MODEL.format(roles=roles, states=states, to=to), encoding="utf-8")
    levels = {"ignored-event": Level.WARN} if asked else {}
    report = pipeline.check([model], Settings(levels=levels)).report
    assert not report.has_errors, list(report)
    return [each.message for each in report if each.code == "SW0530"]


def test_a_state_that_ignores_an_event(tmp_path: Path) -> None:
    rest = "state Rest { after 1 s -> Look }"
    assert found(tmp_path, rest) == ["event `Go` is ignored in `Rest` in swarm `Land`"]
    assert found(tmp_path, rest, to=" to uav") != []
    assert found(tmp_path, rest, asked=False) == []


@pytest.mark.parametrize(
    "states",
    [
        "state Rest { defer Go; after 1 s -> Look }",
        "state Rest { on Go [self.index > 0] -> Look; after 1 s -> Look }",
        "state Rest { defer Go; initial A; state A { after 1 s -> Look } }",
        "state Rest { on Go -> Look; initial A; state A { after 1 s -> Look } }",
        """parallel state Rest {
             region A { initial B; state B { after 1 s -> B } }
             region C { initial D; state D { on Go -> D } }
             after 1 s -> Look
           }""",
        "state Rest { on done -> Look }",
        'state Rest { monitor "bridge/events/go" : std_msgs/Empty -> Look; after 1 s -> Look }',
    ],
)
def test_states_that_ignore_none(states: str, tmp_path: Path) -> None:
    assert found(tmp_path, states) == []


@pytest.mark.parametrize("to", ["", " to uav", " to base"])
def test_an_event_that_no_other_robot_sends(to: str, tmp_path: Path) -> None:
    rest = "state Rest { after 1 s -> Look }"
    roles = "uav : Uav" if not to else "uav : Uav; base : Base"
    assert (found(tmp_path, rest, roles=roles, to=to) == []) == (to != " to uav")
