"""Contracts of members: properties of swarms and machines that are proved and judged."""

from __future__ import annotations

from collections.abc import Callable

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.execution.verify.report.diagnostics import report_verdict
from swarmdsl.execution.verify.swarm.model import Model

from .conftest import verdicts_of

MODEL = """
package field

event Low : std_msgs/Float64
swarm event Halt : std_msgs/Empty
function land : abstraction { service "land" : std_srvs/Empty }

endless statemachine Fly {
  var tired : bool = false
  initial Air
  state Air {
    on Low [event.data < 5] / tired = true -> Ground
    on Low / tired = true
    on Halt [tired] -> Ground
    on Halt -> Pause
  }
  choice Pause {
    [tired] -> Ground
    else -> Hover
  }
  state Hover { [tired] -> Ground; on Halt, Low -> Ground }
  state Ground { on Halt -> Ground }
}
member Uav {
  behavior Fly
  contract Stops : on Halt within 2 s reach Ground
  contract Empty : on Low [event.data < 5] within 2 s reach Ground
}
member Big extends Uav { contract Stops : on Halt within 2 s reach Ground, Hover }
member Spare extends Uav { contract Dies : when dead call land }
swarm Field { uav : Uav[2]; big : Big }
endless statemachine Look {
  initial Open
  state Open { on Halt -> Shut }
  state Shut { on Halt -> Open }
}
sensor Camera { behavior Look }
member Seeing {
  behavior Fly
  param least : float64 = 4.0
  eye : Camera
  contract Low   : on Low [event.data < 5] within 2 s reach Ground
  contract Blind : on Halt within 2 s reach Shut
  contract Least : on Low [event.data < least] within 2 s reach Ground, Air
}
"""


def test_contracts_are_proved_for_each_role(modelled: Callable[..., Model]) -> None:
    verdicts = verdicts_of(modelled(MODEL))

    # A path leads on from `Hover`, but only a robot that is tired takes it.
    assert {name: each.outcome for name, each in verdicts.items()} == {
        "uav_Stops": "fails",
        "uav_Empty": "holds",
        "big_Stops": "holds",
        "big_Empty": "holds",
    }


def test_a_member_of_no_swarm_has_them_in_its_machine(modelled: Callable[..., Model]) -> None:
    system = modelled(MODEL).subject.system
    assert system is not None

    alone = {each.name: each for each in system.judged if each.subject == "Fly"}
    # A machine alone has no part with state `Shut`, and no param `least`.
    assert list(alone) == ["Spare_Stops", "Spare_Empty", "Seeing_Low"]
    assert {each.each for each in alone.values()} == {None}


def test_the_place_of_a_broken_contract_is_of_the_robot_that_breaks_it(
    modelled: Callable[..., Model],
) -> None:
    ticking = """
endless statemachine Tick {
  initial On
  state On { after 1 s -> Off }
  state Off { after 1 s -> On }
}
member Clock { behavior Tick }
swarm Field { uav : Uav; clock : Clock }
"""
    model = modelled(MODEL.replace("swarm Field { uav : Uav[2]; big : Big }", ticking))
    verdict = verdicts_of(model)["uav_Stops"]
    assert verdict.run is not None
    # The clock has the last line.
    assert [line.actor.name for line in verdict.run.lines][-1] == "clock[0]"
    report = Diagnostics()
    report_verdict(verdict, "2 robots", model.demands.fields, report)
    ((label,),) = [each.related for each in report]
    assert label.message == "the last transition of `uav[0]` in the run"
    assert label.span.text == "on Halt -> Pause"
