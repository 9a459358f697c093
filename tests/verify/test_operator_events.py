"""Proofs about events that a person may send beside the robots."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from swarmdsl.execution.verify.swarm.model import Model

from .conftest import verdicts_of

MODEL = """
package field

event Low : std_msgs/Empty
swarm {kind}event Abort : std_msgs/Empty

endless statemachine Fly {{
  initial Air
  state Air {{
    on Low / send Abort -> Ground
    on Abort -> Ground
  }}
  state Ground {{ }}
}}
member Drone {{ behavior Fly }}
swarm Field {{ drone : Drone[2] }}
property Reason of Field : drone[0] in Ground only after Low or drone[1] sends Abort
"""


@pytest.mark.parametrize(
    ("kind", "outside", "verdict"),
    [("", ["Low"], "holds"), ("operator ", ["Low", "Abort"], "fails")],
)
def test_a_person_may_send_what_robots_send(
    kind: str, outside: list[str], verdict: str, modelled: Callable[..., Model]
) -> None:
    model = modelled(MODEL.format(kind=kind))

    assert model.outside == outside
    assert verdicts_of(model)["Reason"].outcome == verdict
