"""How long a node takes from a message to what follows from it: there is nothing that it polls."""

from collections.abc import Callable
from statistics import median
from typing import Any

MODEL = """
package lab
action Move { goal { x : float64 } }
function move : abstraction { action "move" : Move }
event Go   : std_msgs/Empty
event Said : std_msgs/Empty
endless statemachine Work {
  initial Waiting
  state Waiting { on Go / send Said() -> Moving }
  state Moving { do move(x = 1.0)  on succeeded, aborted -> Waiting  on Go -> Waiting }
}
"""
ROUNDS = 10
# In seconds; half of the rounds may take longer on a machine that has other things to do.
MOST = 0.05


def test_from_an_event_to_what_follows(world: Callable[..., Any]) -> None:
    work = world(MODEL)
    work.serve()
    node = work.node("work")
    node.wait_in("Waiting")
    for number in range(1, ROUNDS + 1):
        work.publish("Go")
        work.sent("Said", number)
        work.wait_for("move")
        work.publish("Go")
        work.cancelled("move")
        node.wait_in("Waiting")

    published = work.peers.times("published", "go")
    said, cancelled = work.peers.times("sent", "said"), work.peers.times("cancel", "move")
    sending = [end - start for start, end in zip(published[::2], said, strict=True)]
    leaving = [end - start for start, end in zip(published[1::2], cancelled, strict=True)]
    assert median(sending) < MOST
    assert median(leaving) < MOST
