"""Tests of swarm events: who sent them, and for whom they are."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from swarmdsl.cli import run

Simulate = Callable[..., Any]

HEARING = """
endless statemachine Hear {
  var from : string = ""
  var at   : duration = 0 s
  initial A
  state A {
    on Found / from = event.sender, at = event.sent, send Heard(id = from) to from
  }
}
swarm event Heard : Report
member Uav { behavior Hear }
"""


def told(*effects: str) -> str:
    """A swarm in which the base sends some events after a second."""
    return f"""{HEARING}
      endless statemachine Tell {{
        var no : string = ""
        initial A
        state A {{
          after 1 s / {", ".join(effects)}
          on Heard [event.sender != self.id]
            / no = event.sender
        }}
      }}
      member Base {{ behavior Tell }}
      swarm S {{
        uav  : Uav[3]
        base : Base
      }}
    """


def hearers(ran: Any, event: str = "Found") -> list[str]:
    return [line["member"] for line in ran.trace if line["event"] == event]


@pytest.mark.parametrize(
    ("address", "expected"),
    [
        ("", ["uav[0]", "uav[1]", "uav[2]"]),
        (" to uav", ["uav[0]", "uav[1]", "uav[2]"]),
        (" to uav[1]", ["uav[1]"]),
        (" to uav[self.index + self.count]", ["uav[1]"]),
        (' to "uav[2]"', ["uav[2]"]),
        (' to "uav"', ["uav[0]", "uav[1]", "uav[2]"]),
        (" to base", []),
        (" to self.id", []),
        (" to no", []),
    ],
)
def test_only_the_addressed_hear(simulate: Simulate, address: str, expected: list[str]) -> None:
    ran = simulate(told(f"send Found{address}"), "--until", "2s")

    assert hearers(ran) == expected
    # Each tells the sender, and no other.
    assert hearers(ran, "Heard") == ["base[0]"] * len(expected)


def test_the_sender_and_the_time(simulate: Simulate, tmp_path: Path) -> None:
    scenario = "[network]\nlatency = '250 ms'"
    ran = simulate(told("send Found to uav[1]"), "--until", "2s", scenario=scenario)
    (line,) = [line for line in ran.of("uav[1]") if line["event"] == "Found"]

    assert line["t"] == 1250
    assert line["envelope"] == {"sender": "base[0]", "sent": 1_000_000_000}
    assert (line["sent"], line["to"]) == (["Heard"], ["base[0]"])
    assert "to" not in ran.of("uav[1]")[0]
    assert "envelope" not in ran.of("base[0]")[1]  # of its own delay


def test_a_header_tells_the_sender_and_the_time(simulate: Simulate) -> None:
    ran = simulate(
        """
        message Signed {
          header  : std_msgs/Header
          swarmio : swarmros/EventHeader
        }
        message swarmros/EventHeader {
          name : string
          node : string
        }
        swarm event Hello : Signed
        endless statemachine M {
          initial A
          state A {
            after 2 s * (self.index + 1) / send Hello
            on Hello [event.sender == "m[0]" and event.sent == 2 s] -> B
          }
          state B {
            on Hello -> A
          }
        }
        member Robot { behavior M }
        swarm S { m : Robot[2] }
        """,
        "--until",
        "3s",
    )
    assert ran.of("m[1]")[-1]["configuration"] == ["B"]


def test_an_event_from_outside_has_no_sender(simulate: Simulate) -> None:
    events = [
        {"event": "Found", "member": "uav[0]"},
        {"event": "Found", "member": "uav[1]", "sender": "uav[2]", "after": 500},
    ]
    ran = simulate(told("send Stop"), "--until", "1s", events=events)
    first, second = (line for line in ran.trace if line["event"] == "Found")

    assert ("envelope" in first, first["to"], first["nobody"]) == (False, [""], ["Heard"])
    assert second["envelope"] == {"sender": "uav[2]", "sent": 500_000_000}
    assert (second["to"], "nobody" in second) == (["uav[2]"], False)


def test_a_robot_does_not_hear_what_comes_in_its_name(simulate: Simulate) -> None:
    events = [{"event": "Found", "sender": "uav[2]"}]
    scenario = "[[messages]]\nevent = 'Found'\nat = '2 s'\nsender = 'uav[0]'"

    ran = simulate(told("send Stop"), "--until", "3s", events=events, scenario=scenario)

    found = [line for line in ran.trace if line["event"] == "Found"]
    assert [(line["member"], line["envelope"]["sender"]) for line in found] == [
        ("uav[0]", "uav[2]"),
        ("uav[1]", "uav[2]"),
        ("uav[1]", "uav[0]"),
        ("uav[2]", "uav[0]"),
    ]


def test_a_sender_is_a_robot_of_the_swarm(simulate: Simulate) -> None:
    wrong = simulate(told("send Stop"), events=[{"event": "Found", "sender": "uav[3]"}])
    scenario = "[[messages]]\nevent = 'Found'\nat = '2 s'\nsender = 'uav'"
    other = simulate(told("send Stop"), scenario=scenario)

    for ran, name in ((wrong, "uav[3]"), (other, "uav")):
        assert ran.code == 1
        assert f"error[SW0202]: no robot called `{name}`" in ran.err


ALONE = """
  endless statemachine Alone {
    var before : uint32 = self.index
    initial A
    state A { on Start / send Found(id = self.role, level = self.count) to self.id }
  }
"""


def test_a_machine_alone_runs_on_a_robot(simulate: Simulate) -> None:
    scenario = "[self]\nid = 'uav[1]'\ncount = 4"
    ran = simulate(ALONE, events=[{"event": "Start"}], scenario=scenario)
    unsaid = simulate(ALONE, events=[{"event": "Start"}], scenario="[self]\nid = 'uav[1]'")

    assert ran.trace[-1]["member"] == "uav[1]"
    assert ran.trace[-1]["to"] == ["uav[1]"]
    assert "uav[1]" in ran.err.split("in the end")[1]
    assert (unsaid.code, unsaid.trace[-1]["to"]) == (0, ["uav[1]"])


@pytest.mark.parametrize(
    ("text", "told_"),
    [
        ("id = 3", "`id` takes the id of a robot, not `3`"),
        ("id = 'uav[3]'\ncount = 3", "`count` takes a whole number from 4, not `3`"),
        ("name = 'uav[3]'", "`[self]` has no key `name`"),
    ],
)
def test_mistakes_in_the_robot_of_a_machine(simulate: Simulate, text: str, told_: str) -> None:
    ran = simulate(ALONE, scenario=f"[self]\n{text}")

    assert ran.code == 1
    assert told_ in ran.err


def test_robots_of_a_swarm_know_who_they_are(simulate: Simulate) -> None:
    ran = simulate(told("send Stop"), scenario="[self]\nid = 'uav[1]'")

    assert ran.code == 1
    assert "error[SW0012]: a scenario has no key `self`" in ran.err


def test_the_sender_of_an_event_is_a_name(simulate: Simulate) -> None:
    ran = simulate(told("send Stop"), events=[{"event": "Found", "sender": 3}])
    assert "SW0013" in ran.err


def test_an_addressed_event_is_none_of_the_robot_itself(simulate: Simulate) -> None:
    """Without an address, a swarm event is also the event of its topic on the robot."""
    model = """
      event Own : Report on "found"
      endless statemachine M {
        initial A
        state A {
          after 1 s / send Found to m[1]
          after 2 s / send Found
          on Own -> A
        }
      }
      member Robot { behavior M }
      swarm S { m : Robot[2] }
    """
    ran = simulate(model, "--until", "2s", scenario="[params]")
    own = [(line["t"], line["member"]) for line in ran.trace if line["event"] == "Own"]
    assert own == [(2000, "m[0]"), (2000, "m[1]")]


def test_what_is_lost_is_told(simulate: Simulate) -> None:
    model = told('send Found to no + "rover[0]"', "send Found to uav[1]", "send Found to no")
    ran = simulate(model, "--until", "2s", "--trace", "text")

    (line,) = [line for line in ran.out.splitlines() if "send Found" in line]
    assert line.endswith('send Found to rover[0] (nobody), Found to uav[1], Found to "" (nobody)')
    rows = [" ".join(each.split()) for each in ran.err.splitlines()]
    assert "event sent heard lost to nobody" in rows
    assert "Found 3 1 - 2" in rows


def test_an_address_on_a_lossy_network(simulate: Simulate) -> None:
    ran = simulate(told("send Found to uav[1]"), "--until", "2s", scenario="[network]\nloss = 1.0")
    rows = [" ".join(each.split()) for each in ran.err.splitlines()]
    # Lost on the way: the address was right.
    assert "Found 1 - 1" in rows
    assert "nobody" not in ran.out


def test_a_lost_robot_is_still_somebody(simulate: Simulate) -> None:
    scenario = '[[fault]]\nat = "500 ms"\nof = "uav[1]"'
    ran = simulate(told("send Found to uav[1]"), "--until", "2s", scenario=scenario)
    assert hearers(ran) == []
    assert not any("nobody" in line for line in ran.trace)


def test_a_machine_alone_can_name_any_role(simulate: Simulate) -> None:
    ran = simulate(
        """
        statemachine M {
          initial A
          state A {
            after 1 s / send Found to anyone -> B
          }
          final B
        }
        """
    )
    assert ran.trace[-1]["to"] == ["anyone"]
    assert "nobody" not in ran.trace[-1]


def test_replay(simulate: Simulate, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    ran = simulate(told("send Found to uav[1]"), "--until", "2s")
    trace = tmp_path / "trace.jsonl"

    def replayed(lines: list[dict[str, Any]]) -> str:
        trace.write_text("".join(json.dumps(line) + "\n" for line in lines))
        run(["simulate", "model.swarm", "--replay", str(trace)])
        return capsys.readouterr().err

    assert "SW10" not in replayed(ran.trace)
    # Without the sender, the answer would have another address.
    without = [{k: v for k, v in line.items() if k != "envelope"} for line in ran.trace]
    assert "`to` is `` in the model, `base[0]` here" in replayed(without)
    wrong = [{**line, "envelope": {"sender": 3}} for line in ran.trace]
    assert "SW1010" in replayed(wrong)
    wrong = [{**line, "to": "uav"} for line in ran.trace]
    assert "SW1010" in replayed(wrong)


def test_the_timeline_shows_the_address(simulate: Simulate, tmp_path: Path) -> None:
    simulate(told("send Found to uav[1]"), "--until", "2s", "--timeline", "t.svg")
    text = (tmp_path / "t.svg").read_text(encoding="utf-8")
    assert "Found to uav[1]: base[0] -&gt; uav[1], 1 s" in text
