"""Measure the reaction time of a generated ROS 1 node."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable
from pathlib import Path
from statistics import median
from typing import Any

import peers
from measure import Section, spread

ROOT = Path(__file__).resolve().parents[1]
TESTS = ROOT / "tests" / "ros1"
ROUNDS = 30
MOST = 50.0
"""Goal in milliseconds; a polling node takes longer."""

MODEL = """
package lab
action Move { goal { x : float64 } }
function move : abstraction { action "move" : Move }
event Go   : std_msgs/Empty
event Said : std_msgs/Empty
endless statemachine Work {
  initial Waiting
  state Waiting { on Go / send Said() -> Moving }
  state Moving { do move(x = 1.0); on succeeded, aborted -> Waiting; on Go -> Waiting }
}
"""


def section(folder: Path) -> Section:
    """Send nodes go and stop messages, and measure their reactions."""
    found = Section(
        "A node on rospy that answers a message with another one and calls an action, which the "
        f"next message cancels; milliseconds of {ROUNDS} rounds (minimum / median / maximum), "
        "through the middleware and back. The server polls for cancellation every 10 ms.",
        ["node", "message to message", "message to cancelled action"],
    )
    sys.path.insert(0, str(TESTS))
    import conftest

    why = conftest.graph_module.missing()
    if why is not None:
        found.notes.append(f"nodes were not measured: {why}")
        return found
    named = os.environ.get("SWARMDSL_SMACH_PATH")
    smach = [Path(each) for each in named.split(os.pathsep)] if named else [conftest.STAND_IN]
    workspace = conftest.Workspace(folder, smach)
    graph = conftest.graph_module.Graph()
    try:
        parts = workspace.model(MODEL)

        def by_hand(work: Any) -> Callable[[], None]:
            script = [graph.python, str(peers.FOLDER / "ros1_node.py")]
            work.peers.order("listen", "said", type="std_msgs/Empty")
            environment = graph.environment(parts[2], ROS_NAMESPACE=work.namespace)
            graph.start(script, output="by_hand", env=environment)
            return lambda: None

        def generated(work: Any) -> Callable[[], None]:
            node = work.node("work")
            return lambda: node.wait_in("Waiting")

        for name, start in {"by hand": by_hand, "generated": generated}.items():
            work = conftest.world_module.World(graph, *parts, name.replace(" ", "_"), [])
            work.serve()
            sending, leaving = _times(work, start(work))
            work.stop()
            found.rows.append([name, spread(sending, "{:.1f}"), spread(leaving, "{:.1f}")])
    finally:
        graph.stop()
    found.notes.append(f"with {'the real SMACH' if named else 'the SMACH stub of the tests'}")
    for what, times in (("message", sending), ("cancelled action", leaving)):
        sentence = f"generated node, message to {what}, in ms"
        found.goal(sentence, median(times), MOST, "{:.1f}")
    return found


def _times(work: Any, wait: Callable[[], None]) -> tuple[list[float], list[float]]:
    """Return the milliseconds of both reactions; `wait` returns when the node waits for both."""
    for number in range(1, ROUNDS + 1):
        wait()
        work.publish("Go")
        work.sent("Said", number)
        work.wait_for("move")
        work.publish("Go")
        work.cancelled("move")
        work.peers.wait_for("preempted", "move", number)
    told = work.peers.times("published", "go")
    said, cancelled = work.peers.times("sent", "said"), work.peers.times("cancel", "move")

    def between(starts: list[float], ends: list[float]) -> list[float]:
        return [(end - start) * 1e3 for start, end in zip(starts, ends, strict=True)]

    return between(told[::2], said), between(told[1::2], cancelled)
