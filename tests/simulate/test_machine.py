"""One machine alone: events in, a line of the trace for each out."""

from __future__ import annotations

import json
import os
import re
from pathlib import Path

import pytest

from .conftest import Simulate

ROOT = Path(__file__).resolve().parents[2]
CORPUS = Path(os.environ.get("SWARMDSL_CORPUS", ROOT.parent / "shared" / "corpus"))
DOCUMENTS = sorted((CORPUS / "statecharts").glob("*/*.scxml"))

MACHINE = """
statemachine M {
  var n : int32 = 0
  initial Wait
  state Wait {
    on Start -> Busy
    on Found [event.level > 3] / n = event.level -> Wait
    after 5 s -> End
  }
  state Busy {
    do go(speed = 1.0)
    on succeeded -> Tell
    on aborted   -> Wait
    on Stop      -> End
  }
  state Tell {
    entry / send Found(id = "a", level = n)
    do land
    on succeeded, aborted -> End
  }
  final End
}
"""
CIRCLE = """<scxml xmlns="http://www.w3.org/2005/07/scxml" version="1.0">
  <state id="a"><transition event="go" target="b"/></state>
  <state id="b"><transition target="c"/></state>
  <state id="c"><transition target="b"/></state>
</scxml>
"""
BABBLE = """<scxml xmlns="http://www.w3.org/2005/07/scxml" version="1.0">
  <state id="a">
    <onentry><send event="again"/></onentry>
    <transition event="again" target="a"/>
  </state>
</scxml>
"""


@pytest.mark.skipif(not DOCUMENTS, reason="no state charts (set SWARMDSL_CORPUS)")
@pytest.mark.parametrize("path", DOCUMENTS, ids=lambda path: f"{path.parent.name}/{path.stem}")
def test_state_charts_of_others(path: Path, simulate: Simulate) -> None:
    script = json.loads(path.with_suffix(".json").read_text(encoding="utf-8"))
    events = [
        {"event": step["event"]["name"], "after": step.get("after", 0)} for step in script["events"]
    ]
    ran = simulate(path.read_text(encoding="utf-8"), events=events)

    assert (ran.code, ran.err.count("error")) == (0, 0)
    wanted = [
        script["initialConfiguration"],
        *(each["nextConfiguration"] for each in script["events"]),
    ]
    # A machine that sends itself events has lines of its own for these.
    times, found = 0, [set(ran.trace[0]["configuration"])]
    for step in events:
        times += step["after"]
        at = next(
            i
            for i, line in enumerate(ran.trace)
            if i >= len(found) and line["event"] == step["event"] and line["t"] == times
        )
        later = [line for line in ran.trace[at + 1 :] if line["t"] == times]
        own = next((i for i, line in enumerate(later) if _is_from(line, events)), len(later))
        found.append(set([ran.trace[at], *later[:own]][-1]["configuration"]))
    assert found == [set(each) for each in wanted]


def _is_from(line: dict[str, object], events: list[dict[str, object]]) -> bool:
    return any(line["event"] == step["event"] for step in events)


def test_a_line_has_all_that_happened(simulate: Simulate) -> None:
    ran = simulate(MACHINE, events=[{"event": "Start", "after": 250}])

    assert (ran.code, "error" in ran.err) == (0, False)
    assert list(ran.trace[0]) == [
        *("t", "member", "event", "configuration", "entered", "exited", "taken"),
        *("started", "cancelled", "sent"),
    ]
    assert [line.get("data") for line in ran.trace] == [None, None, {"id": "", "count": 0}, None]
    assert [list(line.values())[:10] for line in ran.trace] == [
        [0, None, None, ["Wait"], ["Wait"], [], [], [], [], []],
        [250, None, "Start", ["Busy"], ["Busy"], ["Wait"], ["Wait->0"], ["go"], [], []],
        [
            1250,
            None,
            "do.Busy.succeeded",
            ["Tell"],
            ["Tell"],
            ["Busy"],
            ["Busy->0"],
            ["land"],
            [],
            ["Found"],
        ],
        [2250, None, "do.Tell.succeeded", ["End"], ["End"], ["Tell"], ["Tell->0"], [], [], []],
    ]


def test_a_transition_that_a_region_takes_is_that_of_the_state_around_it(
    simulate: Simulate,
) -> None:
    ran = simulate(
        """
        statemachine M {
          initial Both
          parallel state Both {
            region A { initial A1; state A1 { after 9 s -> A2 } state A2 { } }
            region B { initial B1; state B1 { after 3 s -> Out } }
            on Found -> Out
            internal on Stop -> A2
          }
          final Out
        }
        """,
        events=[{"event": "Stop"}],
    )
    assert [line["taken"] for line in ran.trace] == [[], ["Both->1"], ["Both.B.B1->0"]]
    assert ran.trace[1]["entered"] == ["Both.A.A2"]


def test_delays_come_before_an_event_at_the_same_time(simulate: Simulate) -> None:
    ran = simulate(MACHINE, events=[{"event": "Start", "after": 5000}])

    assert ran.steps() == [(0, None, ["Wait"]), (5000, "after.Wait.1", ["End"])]


def test_leaving_a_state_cancels_what_it_does(simulate: Simulate) -> None:
    ran = simulate(MACHINE, events=[{"event": "Start"}, {"event": "Stop", "after": 900}])

    last = ran.trace[-1]
    assert (last["t"], last["cancelled"], last["configuration"]) == (900, ["go"], ["End"])


def test_an_event_that_nothing_reacts_to_has_a_line(simulate: Simulate) -> None:
    ran = simulate(MACHINE, events=[{"event": "Stop"}, {"event": "Found", "data": {"level": 2}}])

    assert ran.steps()[1:3] == [(0, "Stop", ["Wait"]), (0, "Found", ["Wait"])]
    assert ran.trace[1]["entered"] == ran.trace[2]["entered"] == []


def test_messages_of_events_are_whole(simulate: Simulate) -> None:
    """Fields left out of a message have their defaults; none is missing."""
    ran = simulate(MACHINE, events=[{"event": "Found"}, {"event": "Found", "data": {"level": 4}}])

    assert [line["entered"] for line in ran.trace[1:3]] == [[], ["Wait"]]
    assert ran.err.count("SW1007") == 0


def test_an_activity_can_be_ended_from_outside(simulate: Simulate) -> None:
    text = MACHINE.replace("do go(speed = 1.0)", "do go(speed = 1.0) gives (count => n)")
    events = [
        {"event": "Start"},
        {"event": "do.Busy.aborted", "after": 10},
        {"event": "Start", "after": 10},
        {"event": "do.Busy.succeeded", "after": 10, "data": {"count": 7, "id": "x"}},
    ]
    ran = simulate(text, events=events)

    assert ran.steps()[2:5] == [
        (10, "do.Busy.aborted", ["Wait"]),
        (20, "Start", ["Busy"]),
        (30, "do.Busy.succeeded", ["Tell"]),
    ]
    assert (ran.steps()[-1][0], ran.code) == (1030, 0)


def test_without_end_a_run_stops_ten_minutes_after_the_last_event(simulate: Simulate) -> None:
    text = "endless statemachine M { initial A; state A { after 1 s -> A; on Start -> A } }"

    assert simulate(text).trace[-1]["t"] == 600_000
    assert simulate(text, "--until", "2.5s").trace[-1]["t"] == 2000
    assert simulate(text, "--until", "2s").trace[-1]["t"] == 2000
    ran = simulate(text, events=[{"event": "Start", "after": 700_500}])
    assert ran.trace[-1]["t"] == 1_300_500


def test_a_run_ends_when_nothing_is_left_to_happen(simulate: Simulate) -> None:
    ran = simulate("endless statemachine M { initial A; state A { on Start -> A } }")

    assert (ran.code, len(ran.trace)) == (0, 1)


@pytest.mark.parametrize(("text", "states"), [(CIRCLE, ("b", "c")), (BABBLE, ("a",))])
def test_a_machine_that_never_settles(
    text: str, states: tuple[str, ...], simulate: Simulate
) -> None:
    ran = simulate(text, events=[{"event": "go"}] if text is CIRCLE else None)

    assert ran.code == 1
    assert "error[SW1006]" in ran.err
    assert all(f'<state id="{state}">' in ran.err for state in states)


def test_a_value_that_fails_is_told_with_how_often(simulate: Simulate) -> None:
    text = """
      endless statemachine M {
        var n : int32 = 0
        initial A
        state A { on Start [10 / n > 2] -> A; on Stop / n = n + 1 -> A }
      }
    """
    ran = simulate(text, events=[{"event": "Start"}, {"event": "Start"}])

    assert ran.code == 0
    assert "warning[SW1007]: evaluation failed in `M`: division by zero" in ran.err
    assert "2 times" in ran.err


def test_messages_of_ros_begin_with_all_their_fields(simulate: Simulate) -> None:
    text = """
      statemachine M {
        var target : geometry_msgs/PoseStamped
        initial A
        state A { on Start [target.pose.position.x < 1.0] / target.pose.position.y = 3.0 -> B }
        state B { on Stop [target.pose.position.y > 2.0] -> End }
        final End
      }
    """
    ran = simulate(text, events=[{"event": "Start"}, {"event": "Stop"}])

    assert [line["configuration"] for line in ran.trace] == [["A"], ["B"], ["End"]]
    assert ran.err.count("SW1007") == 0


def test_what_is_simulated(simulate: Simulate) -> None:
    one = "endless statemachine %s { initial A; state A { on Start -> A } }"
    two = one % "M" + one % "N"
    swarm = "member Uav { behavior M } swarm S { uav : Uav[2] }"

    assert simulate(one % "M").steps() == [(0, None, ["A"])]
    assert simulate(two, "--machine", "N").steps() == [(0, None, ["A"])]
    ran = simulate(two)
    assert (ran.code, ran.out) == (1, "")
    assert "error[SW1002]" in ran.err
    assert "choose one: `--machine M` or `--machine N`" in ran.err
    ran = simulate(two, "--machine", "O")
    assert "error[SW0202]: no state machine called `O`" in ran.err
    assert [line["member"] for line in simulate(two + swarm).trace] == ["uav[0]", "uav[1]"]
    assert simulate(two + swarm, "--machine", "N").steps() == [(0, None, ["A"])]
    assert "error[SW1001]" in simulate("sensor Gps { }").err
    assert "error[SW1001]" in simulate("member Uav { } swarm S { uav : Uav }").err
    assert simulate(two, "--machine", "M", "--swarm", "S").code == 2


def test_a_model_with_mistakes_is_not_run(simulate: Simulate) -> None:
    ran = simulate("statemachine M { initial A }")

    assert (ran.code, ran.out) == (1, "")
    assert "error[SW0202]" in ran.err


def test_a_param_needs_a_value(simulate: Simulate) -> None:
    text = """
      statemachine M {
        param limit : int32
        initial A
        state A { on Start [limit > 1] -> B }
        final B
      }
    """
    ran = simulate(text)

    assert (ran.code, ran.out) == (1, "")
    assert "error[SW1005]: param `limit` of `M` has no value" in ran.err
    assert "set it in `[params]` of a scenario: `limit = ...`" in ran.err
    assert simulate(text, scenario="[params]\nlimit = 2\n").code == 0


def test_a_param_of_a_swarm_needs_a_value_of_its_role(simulate: Simulate) -> None:
    """A scenario takes values in the form that the help shows."""
    text = """
      endless statemachine M { param limit : float64[]; initial A
        state A { on Start [len(limit) > 1] -> A } }
      sensor Eye { param rate : float64[]; behavior N }
      endless statemachine N { param rate : float64[]; initial A
        state A { on Start [len(rate) > 1] -> A } }
      member Bot { param limit : float64[]; behavior M; eye : Eye }
      swarm Team { bot : Bot[2] }
    """
    ran = simulate(text)

    assert ran.code == 1
    tables = re.findall(r"set it in `(.*)` of a scenario: `(\w+) = ...`", ran.err)
    assert tables == [("[params.bot]", "limit"), ('[params."bot.eye"]', "rate")]
    scenario = "".join(f"{table}\n{name} = [1.0, 2.0]\n" for table, name in tables)
    assert simulate(text, scenario=scenario).code == 0


@pytest.mark.parametrize(
    ("line", "said", "place"),
    [
        ('{"event": "Start" "after": 5}', "SW1003]: invalid event line: expecting ',' ", "2:19"),
        ("[1, 2]", "SW1003]: invalid event line: expected an object, not a list", "2:1"),
        ('{"after": 5}', 'SW1003]: invalid event line: missing key `"event"`', "2:1"),
        ('{"event": "Start", "after": NaN}', "SW1003]: invalid event line: `NaN`", "2:29"),
        (
            '{"event": "Found", "data": {"level": 1e999}}',
            "SW1003]: invalid event line: `1e999` is too large a number",
            "2:38",
        ),
        (
            '{"event": "Start", "event": "Stop"}',
            "SW1003]: invalid event line: `event` is a duplicate key",
            "2:3",
        ),
        ("[" * 100_000, "SW1003]: invalid event line: it is nested too deeply", "2:1"),
        (
            '{"after": ' + "9" * 5000 + "}",
            "SW1003]: invalid event line: a number has more than 64 bits",
            "2:11",
        ),
        ('{"event": "Strat"}', "SW0202]: no event called `Strat`", "2:12"),
        ('{"event": "Start", "afer": 5}', "SW0012]: an event has no key `afer`", "2:21"),
        ('{"event": "Start", "after": -1}', "SW0013]: `after` takes a number", "2:21"),
        ('{"event": "Start", "after": 1e308}', "SW0013]: `after` takes a number", "2:21"),
        ('{"event": "Start", "member": "uav[9]"}', "SW0202]: no member called `uav[9]`", "2:31"),
        ('{"event": "Found", "data": {"levle": 1}}', "SW0601]: `test/Report` has no field", "2:30"),
        ('{"event": "Found", "data": {"level": "x"}}', "SW0013]: `level` takes a whole", "2:30"),
        ('{"event": "Found", "data": 3}', "SW0013]: `data` takes the fields of", "2:21"),
    ],
)
def test_wrong_events(line: str, said: str, place: str, simulate: Simulate) -> None:
    ran = simulate(MACHINE, events='{"event": "Start"}\n' + line)

    assert (ran.code, ran.out) == (1, "")
    assert f"error[{said}" in ran.err
    assert f"events.jsonl:{place}\n" in ran.err
    assert ran.err.count("error[") == 1


def test_events_that_no_state_waits_for(simulate: Simulate) -> None:
    ran = simulate(CIRCLE, events=[{"event": "gone"}])

    assert (ran.code, len(ran.trace)) == (0, 2)
    assert "warning[SW1004]: no state waits for event `gone`" in ran.err
    other = simulate(MACHINE.replace("on Stop      -> End", ""), events=[{"event": "Stop"}])
    assert (other.code, "SW1004" in other.err) == (0, True)


def test_messages_of_which_nothing_is_known_may_hold_anything(simulate: Simulate) -> None:
    text = """
      event Odd : unknown_msgs/Odd
      endless statemachine M {
        var n    : int32 = 0
        var last : unknown_msgs/Odd
        initial A
        state A {
          on Odd [event.a < 3] -> B
          on Odd [-event.a > 3 or max(event.a, 2) > 5] -> B
          on Odd / last = event, last.deep.er = n -> C
        }
        state B { on Start / n = last.x + 1 -> A }
        state C { on Start [n > 7] -> A }
      }
    """
    ran = simulate(text, events=[{"event": "Odd", "data": {"a": "x", "deep": 3}}])

    assert (ran.code, ran.trace[-1]["configuration"]) == (0, ["C"])
    assert "`<` is not defined for a value in the message" in ran.err
    assert "`-` is not defined for a value in the message" in ran.err
    assert "`last` has no `deep.er` to assign to" in ran.err
