"""The state machine of library explore_lite in a behaviour test."""

from __future__ import annotations

from io import StringIO
from pathlib import Path

from swarmdsl.execution.testing.command import Request, run

MODEL = """
package mapping

import explore_lite.behaviours.*

statemachine Map {
  initial Look
  state Look = ExploreFor(time = 1 min) {
    on done -> Done
  }
  final Done
}

member Rover {
  behavior Map
}

swarm Rovers {
  rover : Rover
}
"""
TESTS = """
[[test]]
name  = "it explores until its time is over, and stops"
steps = [
  { who = "rover[0]", sends = "ExploreResume", data = { data = true } },
  { who = "rover[0]", in = "Look.Explore", for = "59 s" },
  { who = "rover[0]", sends = "ExploreResume", data = { data = false }, within = "2 s" },
  { who = "rover[0]", in = "Done" },
]
"""


def test_a_robot_explores_for_a_time(tmp_path: Path) -> None:
    (tmp_path / "mapping.swarm").write_text(MODEL, encoding="utf-8")
    (tmp_path / "mapping.swarmtest.toml").write_text(TESTS, encoding="utf-8")
    out = StringIO()

    assert run(Request((tmp_path,)), out, StringIO()), out.getvalue()
    assert out.getvalue().count("  ok  ") == 1
