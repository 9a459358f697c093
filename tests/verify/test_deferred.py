"""A deferred event is heard once, in proofs as in simulations."""

from __future__ import annotations

from collections.abc import Callable

from swarmdsl.execution.verify.model import Model

from .conftest import verdicts_of

TEXT = """
package later
swarm event Job : std_msgs/Empty
statemachine Tell {
  initial Wait
  state Wait { after 1 s / send Job -> Told }
  final Told
}
endless statemachine Work {
  initial Busy
  state Busy {
    defer Job
    on Free -> Ready
  }
  state Ready { on Job -> Ready }
}
event Free : std_msgs/Empty
member Base { behavior Tell }
member Robot { behavior Work }
swarm Crew {
  base  : Base
  robot : Robot
}
property Once of Crew : robot hears Job at most 1 times
property Never of Crew : never robot hears Job
"""


def test_a_deferred_event_is_heard_once(modelled: Callable[..., Model]) -> None:
    found = verdicts_of(modelled(TEXT))

    assert {name: verdict.outcome for name, verdict in found.items()} == {
        "Once": "holds",
        "Never": "fails",
    }
