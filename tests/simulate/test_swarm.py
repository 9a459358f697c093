"""A whole swarm: who takes part, who hears whom, what runs beside it."""

from __future__ import annotations

from .conftest import Simulate

SWARM = """
statemachine Seeker {
  param speed : float64 = 1.0
  initial Wait
  state Wait { on Start -> Seek; on Found -> Told }
  state Seek { do go(speed = speed); on succeeded -> Tell; on aborted -> Wait }
  state Tell { entry / send Found(id = "a", level = 1); on Found -> Told; on Stop -> End }
  state Told { on Stop -> End }
  final End
}
statemachine Helper {
  var seen : int32 = 0
  initial Rest
  state Rest { on Found / seen = event.level -> Help }
  state Help { after 1 s [seen > 0] -> Rest; after 2 s -> End }
  final End
}
sensor Camera { behavior Watch }
endless statemachine Watch {
  initial Look
  state Look { on Stop -> Look; on Found -> Look }
}
member Uav { behavior Seeker; camera : Camera }
member Rover { behavior Helper }
swarm S {
  uav   : Uav[2]
  rover : Rover[*]
  base  : Rover[0..3]
}
"""


def test_multiplicities(simulate: Simulate) -> None:
    """As few as there may be, but one at least; the scenario can say another number."""
    names = ["uav[0]", "uav[0].camera", "uav[1]", "uav[1].camera", "rover[0]", "base[0]"]
    assert [line["member"] for line in simulate(SWARM).trace] == names

    ran = simulate(SWARM, scenario="[count]\nrover = 3\nbase = 0\n")
    assert [line["member"] for line in ran.trace][4:] == ["rover[0]", "rover[1]", "rover[2]"]


def test_swarm_events_reach_the_others_alone(simulate: Simulate) -> None:
    ran = simulate(SWARM, events=[{"event": "Start", "member": "uav[0]"}])

    heard = [line["member"] for line in ran.trace if line["event"] == "Found"]
    assert heard == ["uav[1]", "uav[1].camera", "rover[0]", "base[0]"]
    assert ran.of("uav[0]")[-1]["configuration"] == ["Tell"]
    assert ran.of("uav[0]")[-1]["sent"] == ["Found"]


def test_events_of_the_robot_stay_on_it_and_come_back(simulate: Simulate) -> None:
    text = """
      sensor Camera { behavior Watch }
      endless statemachine Watch { initial Look; state Look { on Stop -> Look } }
      statemachine Talk {
        initial A
        state A { entry / send Stop; on Stop -> B }
        final B
      }
      member Uav { behavior Talk; camera : Camera }
      swarm S { uav : Uav[2] }
    """
    ran = simulate(text, "--until", "1s")

    assert ran.steps("uav[0]") == [(0, None, ["A"]), (0, "Stop", ["B"])]
    assert [line["event"] for line in ran.of("uav[0].camera")] == [None, "Stop"]
    assert [line["event"] for line in ran.of("uav[1].camera")] == [None, "Stop"]


def test_events_are_for_members_that_listen_unless_one_is_named(simulate: Simulate) -> None:
    events = [
        {"event": "Stop"},
        {"event": "Stop", "member": "rover"},
        {"event": "Stop", "member": "uav[1].camera"},
    ]
    ran = simulate(SWARM, events=events)

    heard = [line["member"] for line in ran.trace if line["event"] == "Stop"]
    assert heard == [
        *("uav[0]", "uav[0].camera", "uav[1]", "uav[1].camera"),
        *("rover[0]", "uav[1].camera"),
    ]


def test_machines_of_a_robot_share_its_servers(simulate: Simulate) -> None:
    """The activity of the part waits until the server has stopped for the robot's own."""
    text = """
      sensor Camera { behavior Watch }
      endless statemachine Watch {
        initial Look
        state Look { on Stop -> Busy }
        state Busy { do go(speed = 1.0); on succeeded, aborted -> Look }
      }
      statemachine Drive {
        initial A
        state A { do go(speed = 1.0); on Stop -> B; on succeeded, aborted -> B }
        state B { on Start -> C }
        final C
      }
      member Uav { behavior Drive; camera : Camera }
      swarm S { uav : Uav }
    """
    scenario = '[functions.go]\nduration = "10 s"\nstopping = "3 s"\n'
    ran = simulate(text, events=[{"event": "Stop", "after": 1000}], scenario=scenario)

    assert ran.of("uav[0]")[-1]["cancelled"] == ["go"]
    assert ran.of("uav[0].camera")[-1]["t"] == 14_000


def test_params_come_from_the_role_and_the_robot(simulate: Simulate) -> None:
    """The values of a robot reach its parts, and those of a scenario go before them."""
    text = """
      statemachine Wait {
        param delay : duration
        initial A
        state A { after delay -> B }
        final B
      }
      controller Clock { behavior Wait; param delay : duration }
      member Uav { behavior Wait; param delay : duration; clock : Clock { delay = delay * 2 } }
      swarm S {
        uav   : Uav[3] { delay = 2 s }
        other : Uav    { delay = 5 s }
        uav[1] { delay = 3 s }
      }
    """
    ends = {line["member"]: line["t"] for line in simulate(text).trace}
    assert ends == {
        "uav[0]": 2000,
        "uav[1]": 3000,
        "uav[2]": 2000,
        "other[0]": 5000,
        "uav[0].clock": 4000,
        "uav[1].clock": 6000,
        "uav[2].clock": 4000,
        "other[0].clock": 10_000,
    }
    scenario = '[params."uav[1]"]\ndelay = "7 s"\n'
    ends = {line["member"]: line["t"] for line in simulate(text, scenario=scenario).trace}
    assert (ends["uav[0]"], ends["uav[1]"], ends["uav[1].clock"]) == (2000, 7000, 14_000)


def test_params_come_from_the_member(simulate: Simulate) -> None:
    text = """
      statemachine Wait {
        param delay : duration = 1 s
        initial A
        state A { after delay -> B }
        final B
      }
      member Slow { behavior Wait; param delay : duration = 2 * 2 s }
      member Plain { behavior Wait }
      controller Clock { behavior Wait; param delay : duration }
      member Clocked { clock : Clock { delay = 7 s } }
      swarm S { slow : Slow[2]; plain : Plain; clocked : Clocked }
    """
    scenario = """
      [params."slow[1]"]
      delay = "3 s"
      [params."clocked.clock"]
      delay = "1 min"
    """
    ends = {line["member"]: line["t"] for line in simulate(text).trace}
    assert ends == {"slow[0]": 4000, "slow[1]": 4000, "plain[0]": 1000, "clocked[0].clock": 7000}
    ends = {line["member"]: line["t"] for line in simulate(text, scenario=scenario).trace}
    assert ends == {"slow[0]": 4000, "slow[1]": 3000, "plain[0]": 1000, "clocked[0].clock": 60_000}


def test_members_that_talk_without_end_while_no_time_passes(simulate: Simulate) -> None:
    text = """
      endless statemachine Echo {
        initial A
        state A { on Found -> B }
        state B { entry / send Found; on Found -> A; on Start -> A }
      }
      endless statemachine Other {
        initial A
        state A { on Found / send Found -> A }
      }
      member One { behavior Other }
      swarm S { one : One[2] }
      member Unused { behavior Echo }
    """
    ran = simulate(text, events=[{"event": "Found", "member": "one[0]"}])

    assert ran.code == 1
    assert "does not reach a stable configuration at 0 ms" in ran.err
    assert "on Found / send Found -> A" in ran.err


def test_too_many_members(simulate: Simulate) -> None:
    text = SWARM.replace("Uav[2]", "Uav[60000]")

    for ran in (simulate(text), simulate(SWARM, scenario="[count]\nrover = 1000000000\n")):
        assert (ran.code, ran.out) == (1, "")
        assert "error[SW1009]: " in ran.err
    assert simulate(text, "--machine", "Helper").code == 0
