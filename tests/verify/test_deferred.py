"""A deferred event is heard once, in proofs as in simulations."""

from __future__ import annotations

from collections.abc import Callable

from swarmdsl.execution.verify.swarm.model import Model

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


ENDLESS = """
package often
swarm event Job : std_msgs/Empty
event Free : std_msgs/Empty
endless statemachine Tell {
  initial Wait
  state Wait { after 1 s / send Job -> Wait }
}
endless statemachine Work {
  initial Busy
  state Busy {
    defer Job
    on Free -> Ready
  }
  state Ready {
    on Job -> Ready
    on Free -> Busy
  }
}
member Base { behavior Tell }
member Robot { behavior Work }
swarm Crew {
  base  : Base[2]
  robot : Robot
}
property Ready of Crew : robot hears Job only after Free
property Idle of Crew : never robot hears Job
property Begins of Crew : some base in Wait leads to robot in Ready
"""


def test_events_that_are_deferred_without_end_have_few_states(
    modelled: Callable[..., Model],
) -> None:
    model = modelled(ENDLESS)

    assert model.complete
    assert {name: verdict.outcome for name, verdict in verdicts_of(model).items()} == {
        "Ready": "holds",
        "Idle": "fails",
        # It is violated where `Free` does not come, but more and more events wait then.
        "Begins": "unknown",
    }
