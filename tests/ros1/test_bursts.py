"""Events that come and go faster than nodes process them."""

import signal
from collections.abc import Callable
from typing import Any

# More than the buffers of a connection hold.
COUNT, TEXT = 50, "x" * 500_000
MODEL = """
package lab
event Tick : std_msgs/String
event Tock : std_msgs/String
endless statemachine Echo {
  var count : int32 = 0
  initial Hearing
  state Hearing { on Tick / count = count + 1, send Tock(data = event.data) }
}"""


def test_what_a_node_sends_waits_for_a_listener_that_is_busy(world: Callable[..., Any]) -> None:
    lab = world(MODEL)
    busy = lab.beside()
    lab.node("echo").wait_in("Hearing")
    busy.peers.order("listen", "tock", type="std_msgs/String")
    for each in (lab, busy):
        each.hears("Tock")
    busy.peers.process.send_signal(signal.SIGSTOP)
    for _ in range(COUNT):
        lab.publish("Tick", data=TEXT)
    lab.sent("Tock", COUNT)
    busy.peers.process.send_signal(signal.SIGCONT)

    assert busy.sent("Tock", COUNT) == {"data": TEXT}
