"""Tests of `self`: what a robot knows of itself in a simulation."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from swarmdsl.cli import run

Simulate = Callable[..., Any]

MODEL = """
swarm event Here : Report
event       Call : Report
statemachine Turns {
  var mine : uint32 = self.index
  initial Wait
  state Wait {
    after 1 s * (self.index + 1)  -> Told
    on Call [event.id == self.id] -> Told
  }
  state Told {
    entry / send Here(id = self.id, level = mine * 10 + self.count)
    [self.role == "base" and self.count > 1] -> End
  }
  final End
}
sensor Eye { behavior Turns }
member Uav  { behavior Turns }
member Base { eye : Eye }
swarm S { uav : Uav[3]; base : Base[1..5] }
"""


def test_robots_of_a_swarm(simulate: Simulate) -> None:
    ran = simulate(MODEL, scenario="[count]\nbase = 2")
    ends = {line["member"]: line["configuration"] for line in ran.trace}
    turns = [(line["t"], line["member"]) for line in ran.trace if line["sent"]]

    assert ends == {
        **{f"uav[{number}]": ["Told"] for number in range(3)},
        **{f"base[{number}].eye": ["End"] for number in range(2)},
    }
    assert turns == [
        *((1000, "uav[0]"), (1000, "base[0].eye")),
        *((2000, "uav[1]"), (2000, "base[1].eye"), (3000, "uav[2]")),
    ]


def test_what_robots_say_of_themselves(simulate: Simulate) -> None:
    listener = """
      endless statemachine Listen {
        initial A
        state A { on Here -> A }
      }
      member L { behavior Listen }
      swarm T { l : L; uav : Uav[3]; base : Base[2] }
    """
    ran = simulate(MODEL + listener, "--swarm", "T")
    heard = [(line["data"]["id"], line["data"]["level"]) for line in ran.of("l[0]")[1:]]

    # A part speaks in the name of its robot.
    assert heard == [("uav[0]", 3), ("base[0]", 2), ("uav[1]", 13), ("base[1]", 12), ("uav[2]", 23)]


def test_a_machine_alone(simulate: Simulate) -> None:
    events = [{"event": "Call", "after": 100, "data": {"id": ""}}]
    ran = simulate(MODEL, "--machine", "Turns", events=events)

    assert ran.steps() == [(0, None, ["Wait"]), (100, "Call", ["Told"])]


def test_a_lost_robot_still_counts(simulate: Simulate) -> None:
    scenario = """
      [count]
      base = 3
      [[faults]]
      at   = "500 ms"
      lost = "base[1]"
    """
    ran = simulate(MODEL, scenario=scenario)

    assert ran.of("base[2].eye")[-1]["configuration"] == ["End"]
    assert ran.of("base[1].eye")[-1]["event"] == "fault.lost"


def test_a_trace_names_the_robot_of_a_machine_alone(
    simulate: Simulate, capsys: pytest.CaptureFixture[str]
) -> None:
    ran = simulate(MODEL, scenario="[count]\nbase = 2")
    lines = [line for line in ran.trace if line["member"] == "uav[2]"]
    trace = Path("uav.jsonl")
    replay = ["simulate", "model.swarm", "--machine", "Turns", "--replay", str(trace)]
    trace.write_text("".join(f"{json.dumps(line)}\n" for line in lines))
    assert run(replay) == 0
    trace.write_text(trace.read_text().replace("uav[2]", "uav[3]"))
    assert run(replay) == 1
    assert "in the model it ends at 4 s, not before" in capsys.readouterr().err
