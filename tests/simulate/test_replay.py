"""Traces of robots held against the model: what is so is followed, what departs is told."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from swarmdsl.cli import run

MODEL = """
package test
action Go { goal { speed : float64 } result { id : string, count : int32 } }
function go : abstraction { action "cmd/go" : Go }
message Report { id : string, level : int32 }
event Start  : std_msgs/Empty
swarm event Found : Report
statemachine M {
  param limit : int32 = 3
  var count : int32 = 0
  var id    : string
  initial Idle
  state Idle {
    on Start -> Work
    on Found [event.level > limit] -> End
  }
  state Work {
    do go(speed = 1.0) gives (count => count, id => id)
    on succeeded [count > limit] / send Found(id = id, level = count) -> Idle
    on succeeded -> Work
    on aborted   -> Idle
    after 3 s    -> Idle
  }
  final End
}
"""


def line(t: int, event: str | None, **done: Any) -> dict[str, Any]:
    keys = ("configuration", "entered", "exited", "started", "cancelled", "sent")
    blank: dict[str, Any] = {key: [] for key in keys}
    return {"t": t, "member": None, "event": event, **blank, **done}


START = line(0, None, configuration=["Idle"], entered=["Idle"])
GO = line(500, "Start", configuration=["Work"], entered=["Work"], exited=["Idle"], started=["go"])
AGAIN = line(
    900,
    "do.Work.succeeded",
    configuration=["Work"],
    entered=["Work"],
    exited=["Work"],
    started=["go"],
    data={"count": 2, "id": "a", "unknown": 1},
)
SENT = line(
    1200,
    "do.Work.succeeded",
    configuration=["Idle"],
    entered=["Idle"],
    exited=["Work"],
    sent=["Found"],
    data={"count": 4},
)
LATE = line(
    3901,
    "after.Work.1",
    configuration=["Idle"],
    entered=["Idle"],
    exited=["Work"],
    cancelled=["go"],
)
FOUND = line(
    4000,
    "Found",
    configuration=["End"],
    entered=["End"],
    exited=["Idle"],
    data={"level": 4},
)

Replay = Callable[..., tuple[int, str]]


@pytest.fixture
def replay(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> Replay:
    """Replay lines; the exit code, and what was said."""

    def replay(*lines: Any, arguments: tuple[str, ...] = ()) -> tuple[int, str]:
        model = tmp_path / "model.swarm"
        model.write_text(MODEL, encoding="utf-8")
        trace = tmp_path / "trace.jsonl"
        texts = [each if isinstance(each, str) else json.dumps(each) for each in lines]
        trace.write_text("\n".join([*texts, ""]), encoding="utf-8")
        words = ["simulate", str(model), "--machine", "M", "--replay", str(trace), *arguments]
        capsys.readouterr()
        code = run([*words, *(() if "--format" in arguments else ("--format", "concise"))])
        return code, capsys.readouterr().err

    return replay


def test_what_is_as_the_model_says(replay: Replay) -> None:
    code, err = replay(START, GO, AGAIN, LATE, FOUND)

    assert (code, err) == (0, "5 lines of 1 member as in the model\n")


def test_several_traces(replay: Replay, tmp_path: Path) -> None:
    other = tmp_path / "other.jsonl"
    other.write_text(json.dumps(START) + "\n" + json.dumps({**GO, "started": []}) + "\n")

    code, err = replay(START, GO, arguments=("--replay", str(other)))

    first, second, wrong, *_ = err.splitlines()
    assert code == 1
    assert first == f"{tmp_path / 'trace.jsonl'}: 2 lines of 1 member as in the model"
    assert second == f"{other}: 1 line of 1 member as in the model"
    assert f"{other}:2:1: error[SW1011] `M` deviates from the model on `Start` at 500 ms" in wrong


def test_a_trace_without_lines_says_nothing(replay: Replay, tmp_path: Path) -> None:
    other = tmp_path / "other.jsonl"
    other.write_text(json.dumps(START) + "\n")

    code, err = replay(arguments=("--replay", str(other)))

    assert code == 0
    assert (
        f"warning[SW1019] trace `{tmp_path / 'trace.jsonl'}` has no lines: it says nothing" in err
    )
    assert err.count("SW1019") == 1


def test_what_an_activity_sends(replay: Replay) -> None:
    code, err = replay(START, GO, SENT)

    assert (code, err) == (0, "3 lines of 1 member as in the model\n")


@pytest.mark.parametrize(
    ("lines", "where", "what"),
    [
        ([START, {**GO, "configuration": ["Idle"]}], 2, "on `Start` at 500 ms"),
        ([START, {**GO, "started": []}], 2, "on `Start` at 500 ms"),
        ([START, {**GO, "event": "Stop"}], 2, "on `Stop` at 500 ms"),
        ([{**START, "entered": []}], 1, "on its start at 0 ms"),
        ([START, START], 2, "on its start"),
        ([GO], 1, "on `Start`"),
        ([START, AGAIN], 2, "on `do.Work.succeeded`"),
        ([START, GO, {**AGAIN, "data": {"count": 9}}], 3, "on `do.Work.succeeded`"),
        ([START, GO, {**LATE, "t": 3000}], 3, "on `after.Work.1` at 3 s"),
        ([START, GO, {**LATE, "event": "after.Work.2"}], 3, "on `after.Work.2`"),
        ([START, FOUND, {**FOUND, "t": 5000}], 3, "on `Found` at 5 s"),
    ],
)
def test_what_departs_from_the_model(
    replay: Replay, lines: list[Any], where: int, what: str
) -> None:
    code, err = replay(*lines)

    assert code == 1
    assert f"{where - 1} line" in err
    assert f"trace.jsonl:{where}:1: error[SW1011] `M` deviates from the model {what}" in err


def test_it_is_said_what_is_different(replay: Replay) -> None:
    code, err = replay(START, {**GO, "exited": []}, arguments=("--format", "text"))

    assert code == 1
    assert "`exited` is `Idle` in the model, nothing here" in err
    assert "it was in this state" in err


@pytest.mark.parametrize(
    ("text", "reason"),
    [
        ("{", "it is not a JSON object"),
        ("[]", "it is not a JSON object"),
        ('{"t": -1}', "`t` must be a number of milliseconds"),
        ('{"t": 1, "event": 2}', "`event` must be an event name"),
        ('{"t": 1, "event": "a", "member": 3}', "`member` must be a member name"),
        ('{"t": 1, "event": "a", "configuration": [1]}', "`configuration` is a list of names"),
        ('{"t": 1, "loop": -1}', "`loop` is a number of lines"),
        ('{"t": 1, "cause": 0}', "`cause` is that of a line"),
        (json.dumps({**GO, "loop": 3}), "`loop` has too many lines"),
    ],
)
def test_what_is_no_trace(replay: Replay, text: str, reason: str) -> None:
    code, err = replay(START, text)

    assert code == 1
    assert f"trace.jsonl:2:1: error[SW1010] invalid trace line: {reason}" in err


def test_only_the_last_line_has_a_loop(replay: Replay) -> None:
    code, err = replay({**START, "loop": 0}, GO)

    assert code == 1
    assert "trace.jsonl:1:1: error[SW1010] invalid trace line: only the last line has `loop`" in err


@pytest.mark.parametrize(
    ("lines", "told"),
    [
        (0, "nothing happens after them"),
        (1, "the last line repeats for ever"),
        (2, "the last 2 lines repeat for ever"),
    ],
)
def test_lines_that_repeat(replay: Replay, lines: int, told: str) -> None:
    code, err = replay(START, GO, {**AGAIN, "loop": lines})

    assert (code, told in err) == (0, True)


def test_a_member_that_there_is_not(replay: Replay) -> None:
    code, err = replay(START, {**START, "member": "uav[7]"})

    assert code == 1
    assert "no member called `uav[7]`" in err


def test_options_that_do_not_go_together(replay: Replay) -> None:
    code, err = replay(START, arguments=("--trace", "json"))

    assert code == 2
    assert "`--replay` and `--trace` conflict" in err
    code, err = replay(START, arguments=("--timeline", "run.svg"))
    assert code == 2
    assert "`--replay` and `--timeline` conflict: `--play` writes a page" in err


@pytest.mark.parametrize(
    ("folder", "scenario"),
    [
        ("search_and_rescue", "mission.toml"),
        ("minimal", None),
        ("storage", None),
        ("flocking", None),
        ("emergency_exit", None),
    ],
)
def test_a_simulation_is_as_the_model_says(
    examples: Path,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    folder: str,
    scenario: str | None,
) -> None:
    given = ["--scenario", str(examples / folder / scenario)] if scenario else []
    trace = tmp_path / "trace.jsonl"
    assert run(["simulate", str(examples / folder), *given, "--trace-file", str(trace)]) == 0
    capsys.readouterr()

    code = run(["simulate", str(examples / folder), *given, "--replay", str(trace)])

    err = capsys.readouterr().err
    assert code == 0, err
    lines = trace.read_text(encoding="utf-8").splitlines()
    steps = [line for line in lines if "moved" not in json.loads(line)]
    assert err.startswith(f"{len(steps)} line")


BATTERY = """
package test
import cpswarm.interfaces.*
message Cell { share : float32[<=4], label : string, inner : Inner }
message Inner { reserve : float64 }
event Battery : sensor_msgs/BatteryState on "battery"
event Cells   : Cell on "cells"
statemachine M {
  initial Well
  state Well {
    on Battery [event.voltage < 3.0] -> Low
    on Battery [event.capacity > 100.0] -> Large
    on Cells [event.inner.reserve < 3.0] -> Low
    on Battery, Cells -> Well
  }
  final Low
  final Large
}
"""


def test_numbers_that_json_does_not_have(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """They are written as strings, which all readers of JSON take, and read as numbers."""
    model, events, trace = (tmp_path / name for name in ("m.swarm", "events.jsonl", "trace.jsonl"))
    model.write_text(BATTERY, encoding="utf-8")
    data = {"voltage": "NaN", "capacity": "-Infinity"}
    cells = {"share": [0.5, "NaN"], "label": "NaN", "inner": {"reserve": "NaN"}}
    sent = [
        {"event": "Battery", "data": data},
        {"event": "Cells", "data": cells},
        {"event": "Battery", "data": {"voltage": "NaN", "capacity": "Infinity"}},
    ]
    events.write_text("\n".join(map(json.dumps, sent)), encoding="utf-8")
    simulate = ["simulate", str(model), "--machine", "M"]

    assert run([*simulate, "--events", str(events), "--trace-file", str(trace)]) == 0
    lines = [
        json.loads(line, parse_constant=pytest.fail) for line in trace.read_text().splitlines()
    ]
    assert [each["configuration"] for each in lines] == [["Well"], ["Well"], ["Well"], ["Large"]]
    assert {key: lines[1]["data"][key] for key in data} == data
    assert lines[2]["data"] == cells
    assert run([*simulate, "--replay", str(trace)]) == 0

    # As older nodes have written them.
    older = [json.dumps(each).replace('"NaN"', "null") for each in lines]
    trace.write_text("\n".join(older), encoding="utf-8")
    assert run([*simulate, "--replay", str(trace)]) == 0
    assert "4 lines of 1 member as in the model" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("member", "told"),
    [
        ("uav[1]", "or one with `uav` in `[count]`"),
        ("uaw[0]", "did you mean `uav[0]`?"),
    ],
)
def test_a_hint_for_a_robot_that_there_is_not(
    member: str, told: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    model, scenario = tmp_path / "model.swarm", tmp_path / "two.toml"
    swarm = "member Uav { behavior M }\nswarm S { uav : Uav[1..2] }\n"
    model.write_text(MODEL + swarm, encoding="utf-8")
    scenario.write_text("[count]\nuav = 2\n", encoding="utf-8")
    trace = tmp_path / "trace.jsonl"
    lines = [{**START, "member": "uav[0]"}, {**START, "member": member}]
    trace.write_text("".join(f"{json.dumps(line)}\n" for line in lines), encoding="utf-8")
    words = ["simulate", str(model), "--replay", str(trace)]

    assert run(words) == 1
    assert told in capsys.readouterr().err
    assert run([*words, "--scenario", str(scenario)]) == int(member == "uaw[0]")
