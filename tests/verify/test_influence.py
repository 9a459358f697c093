"""Robots that may do more than is covered influence whoever may hear them."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from swarmdsl.execution.verify.automata.limits import Budget, Limits
from swarmdsl.execution.verify.findings.findings import survey
from swarmdsl.execution.verify.swarm.influence import cone
from swarmdsl.execution.verify.swarm.model import Model

from .conftest import verdicts_of

MODEL = """
package tell

event Number : std_msgs/Int32
swarm event Met : std_msgs/Empty
swarm event Known : std_msgs/Empty

endless statemachine Fly {
  initial Alone
  state Alone {
    after 1 s / send Known -> Alone
    @TRIGGER@ / send Met -> Alone
  }
}
endless statemachine Watch {
  initial Idle
  state Idle { on @EVENT@ -> Told }
  state Told { after 1 s -> Told }
}
member Drone { behavior Fly }
member Tower { behavior Watch }
swarm Field {
  drone : Drone[2]
  tower : Tower
}
property Never    of Field : never tower in Told
property Each     of Field : each tower : never in Told
property Possible of Field : each tower : always possible in Told
"""
DOUBTFUL = {
    # How long a robot has waited is not covered, and 1,234 is none of the values that are tried.
    "on Number [elapsed() > 1 s]": "reads the time",
    "on Number [event.data * event.data == 1522756]": "only some values of `Number.data`",
}


@pytest.mark.parametrize("trigger", DOUBTFUL)
def test_what_a_robot_may_send_beyond_what_is_covered_proves_nothing(
    trigger: str, modelled: Callable[..., Model]
) -> None:
    model = modelled(MODEL.replace("@TRIGGER@", trigger).replace("@EVENT@", "Met"))

    for verdict in verdicts_of(model).values():
        assert verdict.outcome == "unknown"
        assert DOUBTFUL[trigger] in verdict.reason


@pytest.mark.parametrize("trigger", DOUBTFUL)
def test_what_a_robot_may_send_is_not_missing(trigger: str, modelled: Callable[..., Model]) -> None:
    model = modelled(MODEL.replace("@TRIGGER@", trigger).replace("@EVENT@", "Met"))

    found = survey(model, Budget(Limits())).findings

    assert not {each.fault for each in found} & {"waits", "unreachable", "untaken"}


def test_a_robot_influences_only_those_that_may_hear_it(modelled: Callable[..., Model]) -> None:
    text = MODEL.replace("@TRIGGER@", "on Number [elapsed() > 1 s]")
    model = modelled(text.replace("@EVENT@", "Number"))
    groups = model.groups()

    roles = [each.role for each in groups]
    assert [each.role for each in cone(model, groups, [roles.index("tower")])] == ["tower"]
    assert verdicts_of(model)["Never"].outcome == "fails"
