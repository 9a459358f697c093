"""Logs of real nodes of ROS 2, as pages play them.

`nodes/` has the traces that two nodes of the depot have written; `tests/ros2/test_monitors.py` runs
the same nodes.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

from swarmdsl.cli import run

from .conftest import ROOT, Visit

LOGS = sorted((Path(__file__).parent / "nodes").glob("carrier_*.jsonl"))


def test_logs_of_nodes_are_played_with_one_clock(browser: Any, tmp_path: Path) -> None:
    page = tmp_path / "run.html"
    words = ["simulate", str(ROOT / "tests" / "ros2" / "models"), "--swarm", "Depot"]
    for log in LOGS:
        words += ["--replay", str(log)]
    # The nodes violate properties, which the replay of each tells.
    assert run([*words, "--play", str(page)]) == 1
    visit = Visit(browser, page)
    members = visit.value("player.recording.members.map((each) => each.name)")
    assert members == ["carrier[0]", "carrier[1]"]
    # Each log has its own clock, which begins when its node does.
    first = visit.value(
        "player.recording.members.map((_, m) => player.recording.moment(0).members[m].line)"
    )
    assert sorted(first) == [-1, 0]
    visit.page.keyboard.press("End")
    states = visit.value("player.moment.members.map((each) => each.states)")
    assert states == [[], ["Away"]]  # the first one was shut down
    visit.close()
