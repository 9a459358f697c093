"""Verdicts on what must happen, and the runs for ever that violate it."""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Sequence
from pathlib import Path

import pytest

from swarmdsl.cli import run
from swarmdsl.execution.simulate.scenario.durations import SECOND
from swarmdsl.execution.verify.replay.lasso_times import lap_times
from swarmdsl.execution.verify.swarm.model import Model

from .conftest import verdicts_of

_MODEL = """package test
event Go : std_msgs/Empty
swarm event Ping : std_msgs/Empty
function work : abstraction { service "work" : std_srvs/Empty }
endless statemachine M {
  initial Idle
  state Idle {
    on Go -> Busy
    on Ping -> Idle
  }
  state Busy {
    do work
    on succeeded -> Idle
    on aborted -> Busy
    on Ping -> Hold
  }
  state Hold {
    after %s s -> Busy
    on Ping -> Hold
  }
}
endless statemachine T {
  initial A
  state A { after 1 s / send Ping -> B }
  state B { after 1 s -> A }
}
member Drone { behavior M }
member Tower { behavior T }
swarm S {
  drone : Drone[%s]
  tower : Tower
}
property Works  of S : each drone : in Busy leads to in Idle
property Leaves of S : each drone : in Hold leads to in Busy
property Heard  of S : each drone : in Hold leads to hears Ping
property Turns  of S : tower in A leads to tower in B
property Pings  of S : again and again tower sends Ping
property Hears  of S : again and again some drone hears Ping
property Goes   of S : each drone : eventually in Busy
property After  of S : each drone : after hears Go, eventually in Idle
property Until  of S : each drone : after in Hold until in Busy, eventually hears Ping
"""


def _outcomes(model: Model) -> dict[str, str]:
    return {name: verdict.outcome for name, verdict in verdicts_of(model).items()}


@pytest.mark.parametrize("number", [1, 2, 3])
def test_what_is_running_is_over_some_time(number: int, modelled: Callable[..., Model]) -> None:
    assert _outcomes(modelled(_MODEL % (3, number))) == {
        "Works": "fails",
        "Leaves": "fails",
        "Heard": "holds",
        "Turns": "holds",
        "Pings": "holds",
        "Hears": "holds",
        "Goes": "fails",
        "After": "fails",
        "Until": "holds",
    }


def test_events_that_may_be_lost_need_not_arrive(modelled: Callable[..., Model]) -> None:
    outcomes = _outcomes(modelled(_MODEL % (3, 1), lossy=True))

    assert (outcomes["Pings"], outcomes["Hears"]) == ("holds", "fails")


def test_a_loop_that_no_times_fit_is_no_violation(modelled: Callable[..., Model]) -> None:
    verdict = verdicts_of(modelled(_MODEL % (1, 1)))["Leaves"]

    assert verdict.outcome == "unknown"
    told = (
        "no times of its loop fit all delays; with a time, such as `within 1 min`, `--time exact`"
    )
    assert told in verdict.reason
    timed = (_MODEL % (1, 1)).replace(
        "in Hold leads to in Busy", "in Hold leads to in Busy within 1 min"
    )
    assert verdicts_of(modelled(timed, exact=True))["Leaves"].outcome == "holds"


# One of two robots never comes to the end of its work, if only their number counts.
_TURNS = """package test
function work : abstraction { service "work" : std_srvs/Empty }
swarm event Done : std_msgs/Empty
statemachine M {
  initial Work
  state Work {
    do work
    on succeeded / send Done -> Rest
    on aborted -> Rest
  }
  state Rest {
    after 1 s -> Work
    on Done -> End
  }
  final End
}
member Drone { behavior M }
swarm S { drone : Drone[3] }
property Rests of S : each drone : again and again (in Rest or in End)
property Other of S : each drone : in Work leads to in Rest
property Some  of S : some drone in Work leads to some drone in Rest
property All   of S : again and again all drone in Rest
"""


def test_no_robot_of_a_group_is_left_out(modelled: Callable[..., Model]) -> None:
    assert _outcomes(modelled(_TURNS)) == {
        "Rests": "holds",
        "Other": "holds",
        "Some": "holds",
        "All": "fails",
    }


def test_nothing_need_come_from_outside(
    modelled: Callable[..., Model], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    modelled(_MODEL % (3, 1))
    model = str(tmp_path / "model.swarm")

    code = run(["verify", model, "--property", "Goes", "-o", str(tmp_path)])
    told = capsys.readouterr().out
    lines = [json.loads(each) for each in (tmp_path / "Goes.jsonl").read_text().splitlines()]
    replayed = run(["simulate", model, "--replay", str(tmp_path / "Goes.jsonl")])
    err = capsys.readouterr().err

    assert (code, replayed) == (1, 1)
    assert "a run that goes on for ever, of 1 drone, 1 tower:" in told
    assert "from here on, again and again:" in told
    assert [each.get("loop") for each in lines] == [*[None] * (len(lines) - 1), 3]
    assert [(each["event"], each["cause"]) for each in lines if "cause" in each] == [("Ping", 3)]
    assert "the last 3 lines repeat for ever" in err
    assert "property `Goes` is violated by `drone[0]`" in err
    # Nothing is open in a loop: what is owed at its end comes in the next lap.
    assert re.findall(r"(?m)^(\w+) +(true|open|false)", err) == [
        ("Works", "true"),
        ("Leaves", "true"),
        ("Heard", "true"),
        ("Turns", "true"),
        ("Pings", "true"),
        ("Hears", "true"),
        ("Goes", "false"),
        ("After", "true"),
        ("Until", "true"),
    ]


@pytest.mark.parametrize(
    ("constraints", "times"),
    [
        # A delay of 5 s begins with the first step of a lap, and ends with that of the next one.
        ([(4, 2, 5), (2, 4, -5)], [0, 1, 2, 3, 5]),
        # Likewise, but another one ends in each lap after 9 s.
        ([(4, 2, 5), (2, 4, -5), (3, 2, 9), (2, 3, -9)], None),
        # One that is always cancelled before its end.
        ([(2, 4, -5)], [0, 1, 2, 3, 2]),
    ],
)
def test_times_fit_each_lap(
    constraints: Sequence[tuple[int, int, int]], times: Sequence[int] | None
) -> None:
    seconds = [(later, earlier, least * SECOND) for later, earlier, least in constraints]
    found = lap_times(1, 2, seconds)

    assert found == (None if times is None else [each * SECOND for each in times])
