"""A swarm whose fitness is known, and small chains of randomness."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.execution.experiments.shipment import Conditions, Shipment, pack

MODEL = """
package test
action Go { goal { speed : float64 } }
function go : abstraction { action "cmd/go" : Go }
statemachine Waiting {
  param patience : duration
  initial Wait
  state Wait { after patience -> Try }
  state Try { do go(speed = 1.0); on succeeded -> Good; on aborted -> Bad }
  final Good
  final Bad
}
member Robot { behavior Waiting; param patience : duration = 8 s }
swarm Crew { robot : Robot[1..6]; fitness Worth }
/// The best patience is 5 s.
fitness Worth {
  in good   : uint32   = count(robot in Good)
  in waited : duration = max each robot : time(in Wait)
  maximize good - (waited / 1 s - 5) * (waited / 1 s - 5) / 10
}
property Fine of Crew : never some robot in Bad
"""
SCENARIO = """
until = "1 min"
[functions.go]
duration = { uniform = ["1 s", "9 s"] }
aborted = 0.2
"""

Packed = Callable[..., Shipment]
_ALL = Conditions()


@pytest.fixture
def packed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Packed:
    """Write a model and a scenario in the current folder, and pack them."""
    monkeypatch.chdir(tmp_path)

    def packed(
        text: str = MODEL, scenario: str = SCENARIO, conditions: Conditions = _ALL
    ) -> Shipment:
        Path("model.swarm").write_text(text, encoding="utf-8")
        Path("scenario.toml").write_text(scenario, encoding="utf-8")
        report = Diagnostics()
        found = pack([Path("model.swarm")], None, [Path("scenario.toml")], report, conditions)
        assert [each.message for each in report] == []
        assert found is not None
        return found[0]

    return packed
