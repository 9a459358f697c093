"""Heartbeats in simulations: who notices which robot is lost, and when."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from textwrap import dedent

import pytest

from swarmdsl.cli import run
from swarmdsl.execution.simulate.network.network import Network
from swarmdsl.execution.simulate.scenario.scenario import Robot

MODEL = """
event Go : std_msgs/Empty

endless statemachine Farm {{
  var left : int32
  initial Full
  state Full {{
    on member_lost [event.role == "scout"] / left = present(scout) -> Short
    on Go -> Full
  }}
  state Short {{
    on member_joined [left < 3 and event.id == "scout[2]"] / left = present() -> Full
    {short}
  }}
  state Alone {{
    on Go -> Alone
  }}
}}

endless statemachine Fly {{
  initial Up
  state Up {{
    on Go -> Up
  }}
}}

member Tractor {{ behavior Farm }}
member Drone {{ behavior Fly }}

swarm Field {{
  heartbeat 1 s lost after 5 s
  base  : Tractor
  scout : Drone[3]
}}
"""


@pytest.fixture
def lines(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> Callable[..., list[str]]:
    """Return the events of the base in a simulation, as `time event id`; replay them."""

    def lines(scenario: str, short: str = "on Go -> Full") -> list[str]:
        model, given = tmp_path / "model.swarm", tmp_path / "scenario.toml"
        model.write_text(MODEL.format(short=short))
        given.write_text(dedent(scenario))
        words = ["simulate", str(model), "--scenario", str(given)]
        assert run([*words, "--trace", "json"]) == 0
        trace = capfd.readouterr().out
        (tmp_path / "trace.jsonl").write_text(trace)
        assert run([*words[:2], "--replay", str(tmp_path / "trace.jsonl")]) == 0
        read = [json.loads(line) for line in trace.splitlines()]
        return [
            f"{each['t']} {each['event']} {each['data']['id']} {each['configuration'][0]}"
            for each in read
            if each["event"] in ("member_lost", "member_joined") and each["member"] == "base[0]"
        ]

    return lines


def test_a_robot_is_missed_after_its_last_heartbeat(lines):
    assert lines(
        """
        until = "60 s"
        [[faults]]
        at = "3.2 s"
        lost = "scout[2]"
        lasts = "12.5 s"
        """
    ) == ["8000 member_lost scout[2] Short", "16000 member_joined scout[2] Full"]


def test_robots_apart_miss_each_other(lines):
    assert lines(
        """
        until = "60 s"
        [[faults]]
        at = "20 s"
        apart = [["base"], ["scout"]]
        lasts = "10.5 s"
        """
    ) == [
        "25000 member_lost scout[0] Short",
        "25000 member_lost scout[1] Short",
        "25000 member_lost scout[2] Short",
        "31000 member_joined scout[0] Short",
        "31000 member_joined scout[1] Short",
        "31000 member_joined scout[2] Full",
    ]


@pytest.mark.parametrize(("lasts", "heard"), [("3.9 s", []), ("4.2 s", ["8000", "9000"])])
def test_a_short_silence_is_not_noticed(lines, lasts, heard):
    """The robot is heard again at a heartbeat: at 8 s in time, at 9 s not."""
    found = lines(
        f"""
        until = "60 s"
        [[faults]]
        at = "3.9 s"
        lost = "scout[2]"
        lasts = "{lasts}"
        """
    )
    assert [line.split()[0] for line in found] == heard


def test_a_guard_sees_who_is_there(lines):
    assert lines(
        """
        until = "60 s"
        [[faults]]
        at = "1 s"
        lost = "scout[0]"
        [[faults]]
        at = "2 s"
        lost = ["scout[1]", "scout[2]"]
        """,
        "[present(scout) == 0 and present() == 1] -> Alone",
    ) == [
        "6000 member_lost scout[0] Short",
        "7000 member_lost scout[1] Short",
        "7000 member_lost scout[2] Alone",
    ]


def test_a_robot_that_returns_takes_all_for_present(lines):
    """It was away while another one was lost, and misses that one by itself."""
    assert lines(
        """
        until = "60 s"
        [[faults]]
        at = "3.5 s"
        lost = "base"
        lasts = "10 s"
        [[faults]]
        at = "4 s"
        lost = "scout[1]"
        """
    ) == ["18000 member_lost scout[1] Short"]


def test_a_network_that_loses_all_drops_everybody(lines):
    found = lines(
        """
        until = "60 s"
        [network]
        loss = 1.0
        """
    )
    assert [line.split()[:3] for line in found] == [
        ["5000", "member_lost", f"scout[{number}]"] for number in range(3)
    ]


def test_a_network_that_loses_some_drops_nobody(lines):
    assert not lines(
        """
        until = "60 s"
        [network]
        loss = 0.9
        """
    )


TESTS = """
model = "model.swarm"
[[test]]
name = "a lost scout is missed"
steps = [
  { lose = "scout[2]" },
  { who = "base[0]", in = "Short", within = "5 s" },
]
[[test]]
name = "as if one was lost"
steps = [
  { send = "member_lost", to = "base[0]", data = { id = "scout[1]", role = "scout" } },
  { who = "base[0]", in = "Short" },
]
"""


def test_tests_lose_robots(tmp_path, capfd):
    (tmp_path / "model.swarm").write_text(MODEL.format(short="on Go -> Full"))
    tests = tmp_path / "members.swarmtest.toml"
    tests.write_text(TESTS)
    code = run(["test", str(tests)])
    assert code == 0, capfd.readouterr()


def test_a_partition_of_few_robots_concerns_few(
    lines: Callable[..., list[str]], monkeypatch: pytest.MonkeyPatch
) -> None:
    """Reach is asked about the robots in a group, not about each pair of all."""
    asked = 0
    reaches = Network.reaches

    def count(network: Network, one: Robot, other: Robot) -> bool:
        nonlocal asked
        asked += 1
        return reaches(network, one, other)

    monkeypatch.setattr(Network, "reaches", count)
    monkeypatch.setattr(f"{__name__}.MODEL", MODEL.replace("base  : Tractor", "base : Tractor[50]"))
    lines("""
      until = "10 s"
      [[faults]]
      at = "2 s"
      apart = [["base[0]"], ["scout[2]"]]
      lasts = "3 s"
    """)

    # 50 robots observe 53: at the beginning and at the end of the partition, two of them each
    # other, all others these two. All pairs would be 2,650 each time.
    assert asked < 4 * (2 * 53 + 50 * 2)
