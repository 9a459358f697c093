"""Machines of the library of PX4: commands go out, and states of the autopilot lead on."""

from __future__ import annotations

from io import StringIO
from pathlib import Path

from swarmdsl.execution.testing.command import Request, run

MODEL = """
import px4.behaviours.*
import px4.members.*
member Flyer extends Px4Vehicle { behavior Mission }
swarm One { uav : Flyer }
endless statemachine Mission {
  initial Arm
  state Arm = ArmVehicle {
    on done.Armed -> Rise
    on done       -> Grounded
  }
  state Grounded { after 1 min -> Arm }
  state Rise = TakeOffTo(altitude = 510) {
    on done.Up -> Stay
    on done    -> Return
  }
  state Stay { after 10 s -> Return }
  state Return = ReturnToLaunch { on done -> Down }
  state Down = LandHere { on done -> Grounded }
}
"""
TESTS = """
swarm = "One"
[[test]]
name  = "a vehicle that is armed takes off, returns, and lands"
steps = [
  { who = "uav[0]", sends = "VehicleCommand" },
  { send = "VehicleStatus", to = "uav[0]", data = { arming_state = 1 } },
  { who = "uav[0]", in = "Arm" },
  { send = "VehicleStatus", to = "uav[0]", data = { arming_state = 2 } },
  { who = "uav[0]", in = "Rise.Ask" },
  { send = "VehicleStatus", to = "uav[0]", data = { nav_state = 17 } },
  { who = "uav[0]", in = "Rise.Climb" },
  { send = "VehicleStatus", to = "uav[0]", data = { nav_state = 4 } },
  { who = "uav[0]", in = "Stay" },
  { who = "uav[0]", sends = "VehicleCommand", within = "10 s" },
  { who = "uav[0]", in = "Return" },
  { send = "LandDetected", to = "uav[0]", data = { landed = false } },
  { who = "uav[0]", in = "Return" },
  { send = "LandDetected", to = "uav[0]", data = { landed = true } },
  { who = "uav[0]", sends = "VehicleCommand" },
  { who = "uav[0]", in = "Down" },
]

[[test]]
name  = "a vehicle that is not armed stays, and one that does not climb returns"
steps = [
  { who = "uav[0]", in = "Grounded", within = "5 s" },
  { who = "uav[0]", in = "Arm", within = "1 min" },
  { send = "VehicleStatus", to = "uav[0]", data = { arming_state = 2 } },
  { who = "uav[0]", in = "Return", within = "5 s" },
]
"""


def test_commands_lead_through_a_flight(tmp_path: Path) -> None:
    (tmp_path / "flight.swarm").write_text(MODEL, encoding="utf-8")
    (tmp_path / "flight.swarmtest.toml").write_text(TESTS, encoding="utf-8")
    out = StringIO()

    assert run(Request((tmp_path,)), out, StringIO()), out.getvalue()
    assert out.getvalue().count("  ok  ") == 2
