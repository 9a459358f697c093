"""Properties are watched in simulations and in replayed traces."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

from swarmdsl.cli import run

from .conftest import Ran, Simulate

MODEL = """
endless statemachine Work {
  var tries : int32 = 0
  initial Idle
  state Idle { on Start -> Busy }
  state Busy {
    initial Going
    on Stop -> Idle
    state Going {
      do go(speed = 1.0)
      on succeeded / tries = tries + 1, send Found(id = "a", level = tries) -> Resting
      on aborted -> Resting
    }
    state Resting {
      after 4 s [tries < 3] -> Going
      on Found -> Resting
    }
  }
}
member Robot { behavior Work }
swarm Crew { robot : Robot[3] }
"""
EVENTS = [
    {"event": "Start", "member": "robot[0]", "after": 1000},
    {"event": "Start", "member": "robot[1]", "after": 500},
]


def verdicts(ran: Ran) -> dict[str, tuple[str, str]]:
    """Return the verdicts in a summary, with the robots and times."""
    rows = re.search(r"^property .*\n((?:\S.*\n)+)", ran.err, re.MULTILINE)
    assert rows is not None, ran.err
    found = {}
    for line in rows[1].splitlines():
        name, verdict, *where = re.split(r"\s{2,}", line.strip())
        found[name] = (verdict, where[0] if where else "")
    return found


@pytest.mark.parametrize(
    ("sentence", "verdict", "where"),
    [
        # Machines start at once: at the first step all of them are in their first state.
        ("all robot in Idle at all times", "false", "at 1 s"),
        ("before Start, all robot in Idle at all times", "true", ""),
        ("before Stop, robot[2] in Idle at all times", "true", "its scope never ended"),
        ("after Stop, never robot[2] in Idle", "true", "its scope never began"),
        ("after Stop until Start, never robot[2] in Idle", "true", "its scope never began"),
        ("between Start and Stop, never robot[2] in Busy", "true", "its scope never ended"),
        ("each robot : after hears Stop, never in Idle", "true", "its scope never began"),
        ("Stop leads to robot[2] in Busy", "true", "its first part never happened"),
        ("each robot : hears Stop only after in Idle", "true", "its first part never happened"),
        ("before Start, Stop leads to Start", "true", "its first part never happened"),
        ("each robot : after hears Start, eventually in Busy", "true", ""),
        ("never count(robot in Going) > 1", "false", "at 1.5 s"),
        ("never count(robot in Busy.Going) > 2", "true", ""),
        ("never robot[2] in Busy", "true", ""),
        ("eventually robot[2] in Busy", "open", ""),
        ("robot[2] in Busy within 5 s", "false", "at 5 s"),
        ("each robot : in Busy within 2 s", "false", "robot[2] at 2 s"),
        ("each robot : eventually in Busy", "open", "robot[2]"),
        ("each robot : in Busy only after Start", "true", ""),
        ("each robot : in Going leads to sends Found within 1 s", "true", ""),
        ("each robot : in Going leads to sends Found within 999 ms", "false", None),
        ("each robot : starts go at most 3 times", "true", ""),
        ("each robot : starts go at most 2 times", "false", "robot[0], robot[1] at 11.5 s"),
        ("each robot : never has [tries > 2]", "false", "robot[0], robot[1] at 12.5 s"),
        ("each robot : never has [tries > 3]", "true", ""),
        ("each robot : sends Found leads to some other robot in Idle", "true", ""),
        ("each robot : never hears Found and in Idle", "false", None),
        ("some robot sends Found only after some robot starts go", "true", ""),
        ("2..* robot in Busy then no robot in Going", "true", ""),
        ("again and again no robot in Going", "true", ""),
        ("always possible all robot in Busy", "open", ""),
        ("all robot in Busy within 5 s at least 0.9", "false in this run", "at 5 s"),
    ],
)
def test_verdicts(simulate: Simulate, sentence: str, verdict: str, where: str | None) -> None:
    model = f"{MODEL}\nproperty P of Crew : {sentence}\n"
    ran = simulate(model, "--trace", "none", "--until", "1min", events=EVENTS)
    found, said = verdicts(ran)["P"]
    assert found == verdict, ran.err
    assert where is None or said == where
    assert ran.code == (1 if verdict == "false" else 0)
    assert ("error[SW1606]" in ran.err) == (verdict == "false")


def test_a_violation_is_told_with_robots_time_and_lines(simulate: Simulate) -> None:
    model = f"{MODEL}\nproperty Quiet of Crew : each robot : never sends Found\n"
    ran = simulate(model, "--trace", "none", events=EVENTS)
    assert "error[SW1606]: property `Quiet` is violated by `robot[0]` at 2 s" in ran.err
    assert "likewise by `robot[1]`" in ran.err
    assert "send Found" in ran.err


def test_a_run_can_end_with_the_violation(simulate: Simulate) -> None:
    model = f"{MODEL}\nproperty Quiet of Crew : each robot : never sends Found\n"
    ran = simulate(model, "--trace", "json", "--stop-on-violation", events=EVENTS)
    assert ran.code == 1
    assert "2 s of virtual time, until a property was violated" in ran.err
    assert ran.trace[-1]["sent"] == ["Found"]


def test_properties_can_be_left_out(simulate: Simulate) -> None:
    model = f"{MODEL}\nproperty Quiet of Crew : never some robot sends Found\n"
    ran = simulate(model, "--trace", "none", "--no-properties", events=EVENTS)
    assert ran.code == 0
    assert "Quiet" not in ran.err
    ran = simulate(model, "--no-properties", "--stop-on-violation")
    assert ran.code == 2


MESSAGES = {
    "never some robot sends Found [event.level > 2]": ("false", "at 12.5 s"),
    "never some robot sends Found [event.level > 3]": ("true", ""),
    'robot[0] hears Found [event.sender == "robot[1]"] at most 2 times': ("false", "at 12.5 s"),
    'never robot[0] hears Found [event.sender == "robot[0]"]': ("true", ""),
    "each robot : never hears Found [event.level > tries]": ("false", ""),
    'each robot : sends Found [event.level == tries and event.id == "a"] at most 3 times': (
        "true",
        "",
    ),
    "never some robot hears Found [event.level / (tries - tries) > 0]": ("true", ""),
    "after robot[0] hears Found [event.sent > 7 s], never robot[0] sends Found [event.level < 2]": (
        *("true", ""),
    ),
    "Found [event.level == 9] at most 0 times": ("false", "at 1.6 s"),
    "never Found [event.level < 9]": ("true", ""),
}


@pytest.mark.parametrize("sentence", MESSAGES)
def test_conditions_on_messages(
    simulate: Simulate, sentence: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """Verdicts are the same with a trace, without one, and in a replay."""
    model = f"{MODEL}\nproperty P of Crew : {sentence}\n"
    until = ("--until", "20s")
    events = [*EVENTS, {"event": "Found", "data": {"level": 9}, "after": 100}]
    alone = simulate(model, *until, "--trace", "none", events=events)
    traced = simulate(model, *until, events=events)
    Path("t.jsonl").write_text(traced.out, encoding="utf-8")
    code = run(["simulate", "model.swarm", "--replay", "t.jsonl"])
    replayed = Ran(code, "", capsys.readouterr().err)
    found = [verdicts(ran)["P"] for ran in (alone, traced, replayed)]
    verdict, where = MESSAGES[sentence]
    assert {each[0] for each in found} == {verdict}, (alone.err, replayed.err)
    assert len({each[1] for each in found}) == 1
    assert where in found[0][1], alone.err


def test_a_property_is_watched_in_runs_of_its_subject_only(simulate: Simulate) -> None:
    model = f"""{MODEL}
property P of Work : never in Busy
property Q of Crew : no robot in Busy at all times
"""
    start = [{"event": "Start"}]
    alone = simulate(model, "--trace", "none", "--machine", "Work", events=start)
    assert verdicts(alone).keys() == {"P"}
    assert "error[SW1606]: property `P` is violated at 0 ms" in alone.err
    crew = simulate(model, "--trace", "none", events=start)
    assert verdicts(crew).keys() == {"Q"}


def test_a_trace_of_robots_has_verdicts(
    simulate: Simulate, capsys: pytest.CaptureFixture[str]
) -> None:
    sentence = "each robot : never has [tries > 2]"
    model = f"{MODEL}\nproperty Few of Crew : {sentence}\n"
    ran = simulate(model, "--trace-file", "trace.jsonl", "--until", "1min", events=EVENTS)
    assert verdicts(ran)["Few"] == ("false", "robot[0], robot[1] at 12.5 s")
    words = ["simulate", "model.swarm", "--replay", "trace.jsonl"]
    again = Ran(run(words), "", capsys.readouterr().err)
    assert verdicts(again)["Few"] == ("false", "robot[0], robot[1] at 12.5 s")
    assert again.code == 1
    assert run([*words, "--no-properties"]) == 0
    assert "Few" not in capsys.readouterr().err


NODES = """
event Leave : std_msgs/Empty on "leave"
statemachine Going { initial Here; state Here { on Leave -> There }; final There }
member Node { behavior Going }
swarm Nodes { node : Node[2] }
property Order of Nodes : node[1] in There only after node[0] in There
property Back of Nodes : node[0] in There then node[0] in Here
property Soon of Nodes : node[1] in There leads to no node in There within 7 s
"""


def test_lines_of_nodes_have_one_time(
    simulate: Simulate, capsys: pytest.CaptureFixture[str]
) -> None:
    """Nodes write when they began; a monitor writes its verdicts between their lines."""

    def line(number: int, t: int, event: str | None, state: str, **more: object) -> str:
        keys = ("exited", "started", "cancelled", "sent")
        record = {
            "t": t,
            "member": f"node[{number}]",
            "event": event,
            "configuration": [state],
            "entered": [] if event == "fault.lost" else [state],
            **{key: [] for key in keys},
            **({"exited": ["Here"]} if event == "Leave" else {}),
        }
        return json.dumps({**record, **more})

    def replayed(*lines: str) -> dict[str, tuple[str, str]]:
        Path("trace.jsonl").write_text("\n".join(lines), encoding="utf-8")
        capsys.readouterr()
        code = run(["simulate", "model.swarm", "--replay", "trace.jsonl"])
        err = capsys.readouterr().err
        assert code == int("false" in err), err
        assert "SW1011" not in err, err
        return verdicts(Ran(code, "", err))

    simulate(NODES, "--trace", "none", "--until", "1s")
    lines = (
        line(0, 0, None, "Here", began=10_000),
        line(0, 500, "Leave", "There", began=10_000),
        line(1, 0, None, "Here", began=10_400),
        line(1, 300, "Leave", "There", began=10_400),
    )
    found = replayed(*lines)
    assert found["Order"] == ("true", "")
    # Both machines have ended; but a node can be started again.
    assert found["Back"] == found["Soon"] == ("false", "at 700 ms")

    again = (
        line(0, 4999, "fault.lost", "There", began=10_000),
        line(0, 0, None, "Here", began=15_000),
        json.dumps({"t": 9000, "began": 10_000, "property": "Order", "verdict": "true"}),
        json.dumps({"t": 9000, "began": 10_000, "fitness": "Most", "measures": []}),
    )
    found = replayed(*lines, *again)
    assert found["Back"] == ("true", "")
    assert found["Soon"] == ("false", "at 7.7 s")

    # Without a beginning, all times are since the start of each.
    found = replayed(*(re.sub(r', "began": \d+', "", each) for each in lines))
    assert found["Order"] == ("false", "at 300 ms")


def test_conditions_read_params_of_the_robot(simulate: Simulate) -> None:
    """Its state machine does not have them."""
    member = "member Robot { param size : float64 = 2.0; behavior Work }"
    model = f"""{MODEL.replace("member Robot { behavior Work }", member)}
property Big of Crew : each robot : has [size > 1.5] at all times
property Bigger of Crew : eventually some robot has [size > 2.5]
"""
    ran = simulate(model, "--trace", "none", "--until", "5s", events=EVENTS)
    assert (verdicts(ran)["Big"][0], verdicts(ran)["Bigger"][0]) == ("true", "open")


def test_a_lost_robot_is_nowhere(simulate: Simulate) -> None:
    model = f"""{MODEL}
property All of Crew : after Start, all robot in Busy within 5 s
property Three of Crew : after Start, 3 robot in Busy within 5 s
"""
    scenario = '[[faults]]\nlost = "robot[2]"\nat = "500 ms"\n'
    ran = simulate(model, "--trace", "none", "--until", "1min", events=EVENTS, scenario=scenario)
    assert verdicts(ran)["All"] == ("true", "")
    assert verdicts(ran)["Three"][0] == "false"


def test_a_timeline_has_a_lane_for_each_property(simulate: Simulate) -> None:
    model = f"""{MODEL}
property Calm of Crew : never some robot in Going
property Ends of Crew : each robot : in Going leads to in Resting
property Halts of Crew : Stop leads to all robot in Idle
property Rests of Crew : after Stop, never some robot in Busy
"""
    simulate(model, "--timeline", "run.svg", "--until", "20s", events=EVENTS)
    titles = re.findall(
        r"<title>(\w+: [\w, ]+)\n([^:]*):", Path("run.svg").read_text(encoding="utf-8")
    )
    assert ("Calm: true", "0 ms to 1 s") in titles
    assert ("Calm: false", "1 s to 16.5 s") in titles
    assert ("Ends: open", "1 s to 2.5 s") in titles
    assert ("Ends: true", "12.5 s to 16.5 s") in titles
    assert ("Halts: true, but its first part never happened", "0 ms to 16.5 s") in titles
    assert ("Rests: true, but its scope never began", "0 ms to 16.5 s") in titles


@pytest.mark.parametrize(("lasts", "verdict"), [('lasts = "2 s"\n', "open"), ("", "true")])
def test_a_robot_that_comes_back_counts_again(simulate: Simulate, lasts: str, verdict: str) -> None:
    """It starts anew and idle; the other two are busy."""
    model = f"""{MODEL}
property Ends of Crew : again and again all robot in Busy
property Two of Crew : never all robot in Busy and count(robot in Busy) < 2
"""
    scenario = f'[[faults]]\nlost = "robot[2]"\nat = "2 s"\n{lasts}'
    words = ("--trace", "none", "--until", "10s")
    events = [{"event": "Start", "after": 1000}]
    ran = simulate(model, *words, events=events, scenario=scenario)
    assert verdicts(ran)["Ends"][0] == verdict
    assert verdicts(ran)["Two"][0] == "true"
    scenario += '[[faults]]\nlost = "robot[1]"\nat = "5 s"\n'
    again = simulate(model, *words, events=events, scenario=scenario)
    # Two are left, one of them idle if it has come back.
    assert verdicts(again)["Two"][0] == ("true" if lasts else "false")


PROPERTIES = """
property Quiet of Crew : never count(robot in Going) > 2
property Early of Crew : before Start, all robot in Idle at all times
property Alone of Work : never in Going
"""


def test_one_property_is_checked_in_a_run_of_what_it_is_about(simulate: Simulate) -> None:
    model = MODEL + PROPERTIES
    ran = simulate(model, "--property", "Quiet", "--trace", "none", events=EVENTS)
    assert verdicts(ran) == {"Quiet": ("true", "")}
    assert "coverage" not in ran.err
    ran = simulate(model, "--property", "Alone", "--trace", "none")
    assert ran.err.startswith("Work, one machine")
    assert verdicts(ran) == {"Alone": ("true", "")}
    ran = simulate(model, "--property", "Quiet", "--property", "Early", "--trace", "none")
    assert [*verdicts(ran)] == ["Quiet", "Early"]


def test_a_property_that_cannot_be_checked(simulate: Simulate) -> None:
    model = MODEL + PROPERTIES
    ran = simulate(model, "--property", "Quite", "--property", "Erly")
    assert ran.code == 1
    assert "no property called `Quite`" in ran.err
    assert "did you mean `Early`?" in ran.err
    ran = simulate(model, "--swarm", "Crew", "--property", "Alone")
    assert "no property of `Crew` called `Alone`" in ran.err
    assert "it is about `Work`" in ran.err
    ran = simulate(model, "--property", "Quiet", "--property", "Alone")
    assert "no property of `Crew` called `Alone`" in ran.err


def test_sarif_is_one_document(simulate: Simulate) -> None:
    model = MODEL + "\nproperty Calm of Crew : never some robot in Going\n"
    words = ("--trace", "none", "--format", "sarif")
    ran = simulate(model, *words, events=EVENTS)
    (log,) = json.loads(ran.out)["runs"]
    assert ran.code == 1
    (result,) = (each for each in log["results"] if each["ruleId"] == "SW1606")
    assert result["locations"][0]["physicalLocation"]["artifactLocation"]["uri"] == "model.swarm"
    assert "\nnote: before: " in result["message"]["text"]
    assert verdicts(ran)["Calm"] == ("false", "at 1 s")
    refused = simulate(model, "--format", "sarif")
    assert "write the trace to a `--trace-file`" in refused.err


PUT_OFF = """
endless statemachine Work {
  initial Busy
  state Busy {
    defer Start
    after 10 s -> Free
  }
  state Free { on Start -> Gone }
  state Gone
}
member Robot { behavior Work }
swarm Crew { robot : Robot; fitness Counted }
fitness Counted of Crew {
  in heard   : uint32   = total(robot hears Start)
  in arrived : uint32   = total(Start)
  in first   : duration = time until robot hears Start
  in alarm   : duration = time until Start
  maximize heard + arrived
}
property Once of Crew : robot hears Start at most 1 times
property Arrived of Crew : Start at most 1 times
property Late of Crew : robot hears Start only after robot in Free
"""


@pytest.mark.parametrize("trace", ["json", "none"])
def test_a_deferred_event_arrives_once_and_is_heard_when_it_is_recalled(
    simulate: Simulate, trace: str
) -> None:
    events = [{"event": "Start", "after": 1000}]
    ran = simulate(PUT_OFF, "--trace", trace, "--results", "results.json", events=events)
    assert ran.code == 0, ran.err
    results = json.loads(Path("results.json").read_text(encoding="utf-8"))
    assert {each["name"]: each["verdict"] for each in results["properties"]} == {
        "Once": "true",
        "Arrived": "true",
        "Late": "true",
    }
    assert {each["name"]: each["value"] for each in results["measures"]} == {
        "heard": 1,
        "arrived": 1,
        "first": 10.0,
        "alarm": 1.0,
    }
