"""Delivery of swarm events: loss, partitions, and robots that are lost for a time."""

from __future__ import annotations

from pathlib import Path

import pytest

from swarmdsl.cli import run

from .conftest import Ran, Simulate

LOSSY = 'until = "20 s"\n[network]\nlatency = "10 ms"\nloss = 0.5\n'
APART = """
until = "10 s"
[[faults]]
at    = "1500 ms"
apart = [["talker"], ["listener[0]"]]
lasts = "3 s"
"""
LOST = """
until = "10 s"
[[faults]]
at    = "1500 ms"
lost  = "listener[0]"
lasts = "3 s"
"""


def model(delivery: str, last: int = 5) -> str:
    """A robot tells a number each second, up to `last`, and two others listen."""
    return f"""
swarm event Number : std_msgs/Int32 {delivery}

endless statemachine Talking {{
  var n : int32 = 0
  initial Talk
  state Talk {{ after 1 s / n = n + 1, send Number(data = n) -> Look }}
  choice Look {{
    [n < {last}] -> Talk
    else -> Silent
  }}
  state Silent {{ }}
}}

endless statemachine Listening {{
  var last : int32 = 0
  initial Listen
  state Listen {{ on Number [event.data != last] / last = event.data }}
}}

member Talker {{ behavior Talking }}
member Listener {{ behavior Listening }}

swarm Radio {{
  talker   : Talker
  listener : Listener[2]
}}
"""


def heard(ran: Ran, member: str = "listener[0]") -> list[tuple[int, int]]:
    assert ran.code == 0, ran.err
    return [
        (each["t"], each["data"]["data"]) for each in ran.of(member) if each["event"] == "Number"
    ]


def row(ran: Ran) -> dict[str, str]:
    """The row of the event in the summary."""
    lines = iter(ran.err.splitlines())
    head = next(line for line in lines if line.startswith("event"))
    for long in ("to nobody", "sent again", "too old"):
        head = head.replace(long, long.replace(" ", "_"))
    return dict(zip(head.split(), next(lines).split(), strict=True))


def test_a_reliable_event_arrives_whatever_is_lost_and_in_order(simulate: Simulate) -> None:
    ran = simulate(model("{ reliable }", 15), scenario=LOSSY)

    for member in ("listener[0]", "listener[1]"):
        assert [number for _, number in heard(ran, member)] == list(range(1, 16))
    delays = {t - 1000 * number - 10 for t, number in heard(ran)}
    assert delays > {0}
    assert all(delay % 100 == 0 for delay in delays)
    assert row(ran)["heard"] == "30"
    assert int(row(ran)["sent_again"]) > 5


def test_an_event_without_a_delivery_is_sent_once(simulate: Simulate) -> None:
    plain, best = (simulate(model(text, 15), scenario=LOSSY) for text in ("", "{ best effort }"))

    assert 0 < len(heard(plain)) < 15
    assert heard(plain) == heard(best)
    assert "again" not in plain.err


@pytest.mark.parametrize(
    ("delivery", "numbers"),
    [
        ("", [1, 5]),
        ("{ best effort }", [1, 5]),
        ("{ reliable }", [1, 2, 3, 4, 5]),
        ("{ reliable, keep 2 }", [1, 3, 4, 5]),
        ("{ latest }", [1, 4, 5]),
        ("{ latest, keep 2 }", [1, 3, 4, 5]),
        ("{ reliable, latest }", [1, 2, 3, 4, 5]),
        ("{ reliable, lifespan 1 s }", [1, 4, 5]),
    ],
)
def test_what_robots_hear_that_were_apart(
    delivery: str, numbers: list[int], simulate: Simulate
) -> None:
    ran = simulate(model(delivery), scenario=APART)

    assert [number for _, number in heard(ran)] == numbers
    assert [number for _, number in heard(ran, "listener[1]")] == [1, 2, 3, 4, 5]
    waited = [t for t, number in heard(ran) if 1 < number < 5]
    assert set(waited) <= {4500}


@pytest.mark.parametrize(
    ("delivery", "numbers"),
    [("", [1, 5]), ("{ reliable }", [1, 5]), ("{ reliable, latest, keep 2 }", [1, 3, 4, 5])],
)
def test_a_lost_robot_comes_back_like_a_new_one(
    delivery: str, numbers: list[int], simulate: Simulate
) -> None:
    ran = simulate(model(delivery), scenario=LOST)

    assert [number for _, number in heard(ran)] == numbers
    events = [(t, event) for t, event, _ in ran.steps("listener[0]") if event != "Number"]
    assert events == [(0, None), (1500, "fault.lost"), (4500, None)]
    Path("lost.jsonl").write_text(ran.out, encoding="utf-8")
    assert run(["simulate", "model.swarm", "--replay", "lost.jsonl"]) == 0


def test_events_that_are_too_old_are_counted(simulate: Simulate) -> None:
    ran = simulate(model("{ reliable, lifespan 1 s }"), scenario=APART)

    assert row(ran)["too_old"] == "2"


def test_a_missed_deadline_is_told_once(simulate: Simulate) -> None:
    ran = simulate(model("{ deadline 1200 ms }"), scenario=APART)

    late = [t for t, event, _ in ran.steps("listener[0]") if event == "fault.late.Number"]
    assert late == [2200, 6200]
    assert [t for t, e, _ in ran.steps("listener[1]") if e == "fault.late.Number"] == [6200]
    assert row(ran)["late"] == "3"


def test_what_never_arrives_waits(simulate: Simulate) -> None:
    ran = simulate(model("{ reliable }"), scenario=APART.replace('lasts = "3 s"', ""))

    assert row(ran)["waiting"] == "4"


@pytest.mark.parametrize(
    ("fault", "message"),
    [
        ('apart = ["talker"]', "two groups of members or more"),
        ('apart = [["talker"], ["nobody"]]', "no member called `nobody`"),
        ('apart = [["talker"], ["listener"]]\nlost = "talker"', "no such key for a lost member"),
    ],
)
def test_wrong_partitions(fault: str, message: str, simulate: Simulate) -> None:
    ran = simulate(model(""), scenario=f'[[faults]]\nat = "1 s"\n{fault}\n')

    assert ran.code == 1
    assert message in ran.err
