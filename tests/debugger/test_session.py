"""Whole sessions of the debug adapter, as a client has them."""

from __future__ import annotations

import json
import shutil
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from swarmdsl.cli import run

from .client import Client, RefusedError

MODEL = Path(__file__).with_name("lamps.swarm")
TESTS = Path(__file__).with_name("lamps.swarmtest.toml")
QUIET = "nothing is left to happen: send an event, or continue to the end"
LINES = MODEL.read_text(encoding="utf-8").split("\n")


def line(text: str) -> int:
    return next(number for number, each in enumerate(LINES, 1) if text in each)


@pytest.fixture
def client() -> Iterator[Client]:
    with Client() as found:
        yield found


def run_until_quiet(client: Client, **arguments: object) -> None:
    client.launch(program=str(MODEL), **arguments)
    assert client.stop()["text"] == QUIET


def test_a_session_from_the_first_event_to_the_end(client: Client) -> None:
    asked = [line("param most"), line("on Start"), line("state On {"), 999]
    assert [
        (each["verified"], each.get("line"))
        for each in client.launch({MODEL: asked}, program=str(MODEL))
    ] == [
        (True, line("state Waiting {")),
        (True, line("on Start")),
        (True, line("state On {")),
        (False, None),
    ]
    stopped = client.stop()
    assert (stopped["reason"], stopped["frame"]["name"]) == ("breakpoint", "Waiting")
    assert [each["name"] for each in client.request("threads")["threads"]] == ["bulb[0]", "bulb[1]"]
    assert client.go("continue")["threadId"] == 2
    assert client.go("continue")["reason"] == "pause"

    shown = client.request("swarmPicture")
    assert shown["active"] == {"bulb[0]": ["Waiting"], "bulb[1]": ["Waiting"]}
    start = {"event": "Start", "label": "Start", "to": ["bulb[0]", "bulb[1]"], "data": {"times": 0}}
    assert shown["events"] == [start]

    assert client.value('send Start {"times": 2} to bulb[0]', "repl") == "Start to bulb[0]"
    stopped = client.stop()
    frame = stopped["frame"]
    assert (stopped["reason"], frame["line"]) == ("breakpoint", line("on Start"))
    assert frame["name"].startswith("on Start [event.times > 0 and")
    assert frame["source"] == {"name": "lamps.swarm", "path": str(MODEL)}
    scopes = client.scopes(1)
    # The effect comes after the transition is taken.
    assert scopes["Variables"] == {"blinks": "0", "longest": "2 s", "Lit.tries": "1"}
    assert scopes["Params"] == {"most": "3"}
    assert scopes["Event"] == {"name": "Start", "times": "2"}
    assert scopes["Robot"]["id"] == '"bulb[0]"'
    assert client.value("event.times * most + 1") == "7"

    assert client.go("stepIn")["frame"]["name"] == "Lit"
    assert "time in the state" not in client.scopes(1)["Robot"]
    assert client.go("stepIn")["reason"] == "breakpoint"
    assert [each["name"] for each in client.stack(1)] == ["Lit.On", "Lit"]
    assert client.value("blinks > 1 and not in(Off)") == "true"
    # The end of this step, then that of the next one, which blinks again.
    client.go("stepOut")
    assert client.go("stepOut")["reason"] == "breakpoint"
    assert client.go("stepOut")["text"] == "bulb[0], at 1 s"
    assert client.value("blinks") == "1"
    stopped = client.go("continue")
    assert (stopped["reason"], stopped["text"]) == ("exception", "property `NeverDark` is violated")
    assert client.request("exceptionInfo", threadId=1)["exceptionId"] == stopped["text"]
    assert stopped["frame"]["name"] == "ended in Dark"

    client.go("continue")
    client.request("continue", threadId=1)
    assert client.await_event("exited")["exitCode"] == 0
    assert client.await_event("terminated")
    assert client.output.endswith("nothing is left to happen, at 4.000 s\n")
    assert "0.000  bulb[0]  Start -> Lit.On; start blink\n" in client.output


def test_going_back_plays_the_same_run_again(client: Client) -> None:
    client.launch({MODEL: [line("on Start")]}, program=str(MODEL))
    client.stop()
    client.value('send Start {"times": 3} to bulb[1]', "repl")
    assert client.stop()["reason"] == "breakpoint"
    states = []
    for _ in range(3):
        stopped = client.go("next")
        states.append((stopped["text"], stopped["threadId"], client.value("blinks")))
    assert states[0] == ("bulb[1], at 0 ms", 2, "3")
    assert states[2] == ("bulb[1], at 2 s", 2, "1")
    for expected in (states[1], states[0]):
        stopped = client.go("stepBack")
        assert (stopped["text"], stopped["threadId"], client.value("blinks")) == expected
    # Forwards it is the same again, with what was sent before.
    assert client.go("next")["text"] == states[1][0]
    stopped = client.go("reverseContinue")
    assert (stopped["frame"]["line"], client.value("blinks")) == (line("on Start"), "0")
    # Before it was sent.
    assert client.go("stepBack")["frame"]["name"] == "Waiting"
    assert client.value("blinks", "hover") == "0"
    for member in (1, 0):
        assert client.go("stepBack")["text"] == f"bulb[{member}], at 0 ms"
    with pytest.raises(RefusedError, match="this is the start"):
        client.go("stepBack")


def test_conditions_hits_and_messages(client: Client) -> None:
    again, off = line("on succeeded ["), line("state Off {")
    said = client.launch(
        {
            MODEL: [
                {"line": again, "condition": "blinks == 2"},
                {"line": line("state On {"), "hitCondition": "% 3"},
                {"line": off, "logMessage": "{self.id} after {tries + blinks} of {most}"},
                {"line": off, "condition": "blinks = 2"},
                {"line": off, "condition": "nobody"},
                {"line": off, "condition": "tries"},
                {"line": line("on Start"), "condition": "event.times > 4"},
                {"line": off, "hitCondition": "often"},
            ]
        },
        program=str(MODEL),
    )
    assert [each["verified"] for each in said] == [
        True,
        True,
        True,
        False,
        False,
        False,
        True,
        False,
    ]
    assert said[3]["message"] == "expected an expression, and nothing else; `==` compares"
    assert said[4]["message"].startswith("no value called `nobody`")
    assert said[5]["message"] == "a condition is true or false, but this is a `int32`"
    assert said[7]["message"] == "write a number of hits, such as `3`, `>= 3` or `% 3`"
    client.stop()
    client.value('send Start {"times": 3} to bulb[0]', "repl")
    stopped = client.stop()
    while stopped["reason"] == "step":
        stopped = client.go("continue")
    assert (stopped["frame"]["line"], client.value("blinks")) == (again, "2")
    stopped = client.go("continue")  # the third time on
    assert (stopped["frame"]["line"], client.value("blinks")) == (line("state On {"), "1")
    client.go("continue")
    assert '\n"bulb[0]" after 2 of 3\n' in client.output


def test_variables_are_set(client: Client) -> None:
    run_until_quiet(client)
    frame = client.stack(1)[0]["id"]
    number = client.request("scopes", frameId=frame)["scopes"][0]["variablesReference"]

    def set_to(name: str, value: str) -> str:
        arguments = {"variablesReference": number, "name": name, "value": value}
        result: str = client.request("setVariable", **arguments)["value"]
        return result

    assert set_to("blinks", "most * 2") == "6"
    assert set_to("longest", "90 s") == "1 min 30 s"
    assert client.scopes(1)["Variables"]["blinks"] == "6"
    for name, value in (
        ("blinks", "1.5"),
        ("blinks", "Off"),
        ("nothing", "1"),
        ("blinks", "3000000000"),
        ("longest", "5"),
        ("longest", "true"),
    ):
        with pytest.raises(RefusedError, match=f"`{value if value == 'Off' else name}`"):
            set_to(name, value)
    # What was set at a point is set again on the way back to a later one.
    client.value('send Start {"times": 1} to bulb[1]', "repl")
    client.stop()
    client.go("next")
    assert client.go("stepBack")["threadId"] == 2
    assert (
        client.request("evaluate", expression="blinks", frameId=client.stack(1)[0]["id"])["result"]
        == "6"
    )


def test_commands_of_the_console(client: Client) -> None:
    run_until_quiet(client, seed=7)
    for command, why in (
        ("send", "write `send EVENT`"),
        ("send Start {", "write `send EVENT`"),
        ("send Start {nothing}", "the data are no JSON"),
        ("send Strat", "did you mean `Start`"),
        ('send Start {"time": 1}', "has no field `time`"),
        ("send Start to bulb[7]", "bulb"),
    ):
        with pytest.raises(RefusedError) as refused:
            client.value(command, "repl")
        assert why in str(refused.value)
    targets = client.request("completions", text="send S", column=7)["targets"]
    assert [each["label"] for each in targets] == ["Start"]
    for given in ({"text": "bl", "column": 3}, {"text": "1 +\nbl", "line": 2, "column": 3}):
        targets = client.request("completions", **given)["targets"]
        assert [each["label"] for each in targets] == ["blinks"]
    client.value('send Start {"times": 1}', "repl")
    client.stop()
    client.go("next")
    events = [(each["label"], each["to"]) for each in client.request("swarmPicture")["events"]]
    assert events == [
        ("Stop", ["bulb[0]", "bulb[1]"]),
        ("blink succeeded", ["bulb[0]", "bulb[1]"]),
        ("blink aborted", ["bulb[0]", "bulb[1]"]),
        ("blink preempted", ["bulb[0]", "bulb[1]"]),
    ]
    client.request("swarmSend", event="do.Lit.On.aborted", member="bulb[1]")
    client.stop()
    assert client.request("swarmPicture")["active"]["bulb[1]"] == ["Lit.Off"]
    # As a page does, of which the editor knows nothing.
    client.request("swarmGo", request="stepBack", threadId=2)
    assert client.await_event("continued")
    client.stop()
    shown = client.request("swarmPicture")
    assert (shown["member"], shown["active"]["bulb[1]"]) == ("bulb[1]", ["Lit.On"])


def test_columns_count_utf_16_units(client: Client, tmp_path: Path) -> None:
    model = tmp_path / "robots.swarm"
    model.write_text(
        "package robots\n"
        "swarm event Say : std_msgs/String\n"
        "endless statemachine Robot {\n"
        "  initial Idle; /* \U0001f916 */ state Idle { on Say -> Idle }\n"
        "}\n",
        encoding="utf-8",
    )
    client.launch(program=str(model))
    frame = client.stop()["frame"]
    text = model.read_text(encoding="utf-8").split("\n")[3]
    # The robot is one character, and two units.
    assert (frame["line"], frame["column"]) == (4, text.index("Idle {") + 1 + 1)
    assert (frame["endLine"], frame["endColumn"]) == (4, frame["column"] + len("Idle"))
    typed = 'send Say {"data": "\U0001f916"} S'
    [found] = client.request("completions", text=typed, column=len(typed) + 2)["targets"]
    assert found == {"label": "Say", "start": len(typed), "length": 1, "type": "value"}


def test_a_robot_that_comes_back_keeps_its_name(client: Client, tmp_path: Path) -> None:
    scenario = tmp_path / "lost.toml"
    text = '[[faults]]\nat = "1 s"\nlost = "bulb[0]"\nlasts = "1 s"\n'
    scenario.write_text(text, encoding="utf-8")
    run_until_quiet(client, scenario=str(scenario))
    client.request("swarmSend", event="Start", member="bulb[0]", data={"times": 1})
    client.stop()
    assert client.request("swarmPicture")["active"] == {
        "bulb[0]": ["Lit.On"],
        "bulb[1]": ["Waiting"],
    }


def test_pause_and_restart_in_real_time(client: Client) -> None:
    client.launch(program=str(MODEL), realTime=True, stopOnEntry=True)
    assert client.stop()["text"] == "bulb[0], at 0 ms"
    client.go("continue")
    client.value('send Start {"times": 1}', "repl")
    client.stop()
    client.request("continue", threadId=1)
    with pytest.raises(RefusedError, match="the simulation is running"):
        client.stack(1)
    client.request("pause", threadId=1)
    assert client.stop()["reason"] == "pause"
    assert client.request("swarmPicture")["time"] < 1
    # A step does not wait, nor does the run without a speed.
    client.request("swarmSpeed", speed=0.001)
    assert client.go("next")["text"] == "bulb[0], at 1 s"
    client.request("swarmSpeed")
    assert client.go("continue")["reason"] == "exception"
    shown = client.request("swarmPicture")
    assert (shown["reason"], shown["member"]) == ("property `NeverDark` is violated", "bulb[0]")
    assert shown["members"] == ["bulb[0]", "bulb[1]"]
    shown = client.request("swarmPicture", threadId=2)
    assert (shown["member"], shown["thread"], shown["variables"]["blinks"]) == ("bulb[1]", 2, "1")
    client.request("restart")
    assert client.stop()["text"] == "bulb[0], at 0 ms"
    client.request("disconnect")
    assert client.await_event("terminated")


def test_without_debugging_nothing_stops(client: Client) -> None:
    lines = [line("state Waiting {")]
    client.launch({MODEL: lines}, program=str(MODEL), noDebug=True, scenaro="x.toml", __id=1)
    client.await_event("terminated")
    assert client.output == (
        "`scenaro` in the launch configuration is not read: did you mean `scenario`?\n"
        "     0.000  bulb[0]  (start) -> Waiting\n"
        "     0.000  bulb[1]  (start) -> Waiting\n"
        "nothing is left to happen, at 0.000 s\n"
    )


def test_a_model_that_changes_while_it_runs(client: Client, tmp_path: Path) -> None:
    model = tmp_path / MODEL.name
    shutil.copy(MODEL, model)
    client.launch({model: [line("state Waiting {")]}, program=str(model))
    assert client.stop()["reason"] == "breakpoint"
    assert "has changed" not in client.output
    model.write_text(MODEL.read_text(encoding="utf-8").replace("on Start [", "on Strat ["))
    client.request("setBreakpoints", source={"path": str(model)}, breakpoints=[{"line": 1}])
    hint = "lamps.swarm has changed since the run began: restart to run it as it is now\n"
    assert client.output.endswith(hint)
    # The run goes on if the model has mistakes, and can go back.
    with pytest.raises(RefusedError, match="no event called `Strat`"):
        client.request("restart")
    assert client.go("next")["text"] == "bulb[0], at 0 ms"
    assert client.go("next")["reason"] == "breakpoint"
    assert client.go("stepBack")["text"] == "bulb[0], at 0 ms"
    shutil.copy(MODEL, model)
    client.request("restart")
    assert client.stop()["frame"]["name"] == "Waiting"


def verdict(client: Client, outcome: str, exit_code: int) -> dict[str, Any]:
    """Let a test run to its end; return its result."""
    client.request("continue", threadId=1)
    result = client.await_event("swarmTested")
    assert (result["type"], result["outcome"]) == ("result", outcome)
    assert client.await_event("exited")["exitCode"] == exit_code
    client.await_event("terminated")
    return result


def test_a_behaviour_test_is_driven_by_its_steps(client: Client) -> None:
    client.launch({MODEL: [line("state On {")]}, test=str(TESTS))
    assert client.stop()["frame"]["name"] == "Lit.On"
    step = client.stack(1)[-1]
    assert (step["name"], step["source"]["path"]) == ("step of the test", str(TESTS))
    text = TESTS.read_text(encoding="utf-8").splitlines()[step["line"] - 1]
    assert text[step["column"] - 1 : step["endColumn"] - 1] == '"Start"'
    assert client.value("blinks") == "2"
    assert client.go("continue")["text"] == "bulb[0], at 1 s"
    assert client.go("stepBack")["text"] == "bulb[0], at 0 ms"
    assert client.go("reverseContinue")["frame"]["name"] == "Lit.On"
    assert client.go("continue")["text"] == "bulb[0], at 1 s"
    result = verdict(client, "passed", 0)
    assert (result["id"], result["seeds"]) == (f"{TESTS}::blinks as often as it is told", 1)
    assert "the test `blinks as often as it is told` passes, at 1.500 s\n" in client.output


def test_what_the_user_sends_counts_for_the_verdict(client: Client) -> None:
    client.launch({MODEL: [line("state On {")]}, test=f"{TESTS}::never ends")
    client.stop()
    client.request("swarmSend", event="Stop")
    client.request("setBreakpoints", source={"path": str(MODEL)}, breakpoints=[])
    assert verdict(client, "passed", 0)["outcome"] == "passed"


def test_a_breakpoint_with_a_column_is_on_what_begins_there(client: Client, tmp_path: Path) -> None:
    model = tmp_path / "one.swarm"
    state = "  state B { on Tick -> C }"
    model.write_text(
        "package a\nevent Tick : std_msgs/Empty\nstatemachine M {\n  initial A\n"
        f"  state A {{ after 1 s / send Tick -> B }}\n{state}\n  final C\n}}\n",
        encoding="utf-8",
    )
    client.launch(machine="M", program=str(model), stopOnEntry=True)
    client.stop()
    for column, name in ((state.index("on") + 1, "on Tick -> C"), (4, "B")):
        places = [{"line": 6, "column": column}]
        client.request("setBreakpoints", source={"path": str(model)}, breakpoints=places)
        assert client.go("continue")["frame"]["name"] == name
        client.request("restart")
        client.stop()


def test_a_test_that_fails_stops_where_it_fails(client: Client) -> None:
    client.launch(test=f"{TESTS}::never ends")
    stopped = client.stop()
    assert stopped["reason"] == "exception"
    assert "expected in `Dark` within 2 s" in stopped["text"]
    assert stopped["frame"]["name"] == "Lit.Off"
    result = verdict(client, "failed", 1)
    assert (result["expected"], result["failed_seeds"]) == ("in `Dark` within 2 s", [0])
    assert result["problems"][0]["file"] == str(TESTS)


def test_the_first_seed_with_which_a_test_fails_is_debugged(
    client: Client, capsys: pytest.CaptureFixture[str]
) -> None:
    name = f"{TESTS}::seldom fails to blink"
    run(["test", name, "--results", "-"])
    records = map(json.loads, capsys.readouterr().out.splitlines())
    [judged] = (each for each in records if each["type"] == "result")
    client.launch(test=name, stopOnEntry=True)
    client.stop()
    first = judged["failed_seeds"][0]
    assert client.output.startswith(f"seed {first} is the first of 6 that fails\n")
    assert client.go("continue")["reason"] == "exception"
    # It may fail with some.
    result = verdict(client, "passed", 0)
    for each in (judged, result):
        del each["seconds"]
    assert result == {**judged, "event": "swarmTested"}


def test_a_test_in_real_time_can_be_paused(client: Client) -> None:
    client.launch(test=str(TESTS), realTime=True, stopOnEntry=True)
    client.stop()
    client.request("continue", threadId=1)
    client.request("pause", threadId=1)
    assert client.stop()["reason"] == "pause"
    assert client.request("swarmPicture")["time"] < 1.5


def test_a_test_with_mistakes_is_not_launched(client: Client) -> None:
    client.request("initialize")
    with pytest.raises(RefusedError, match="missing key `steps`"):
        client.request("launch", test=f"{TESTS}::has no steps")
    result = client.await_event("swarmTested")
    assert (result["name"], result["outcome"]) == ("has no steps", "unread")
    assert result["problems"][0]["code"] == "SW1008"


@pytest.mark.parametrize(
    ("arguments", "why"),
    [
        ({}, "`program` is missing"),
        ({"program": "nowhere.swarm"}, "nowhere.swarm"),
        ({"program": "\0"}, "characters that no path has"),
        ({"program": str(MODEL), "cwd": "\ud800"}, "characters that no path has"),
        ({"program": str(MODEL), "swarm": "Lmaps"}, "did you mean `Lamps`"),
        ({"program": str(MODEL), "scenario": "none.toml"}, "none.toml"),
        ({"program": str(MODEL), "world": "round"}, "`world` must be"),
        ({"program": str(MODEL), "until": "soon"}, "`until` must be a duration"),
        ({"program": str(MODEL), "seed": "one"}, "`seed` must be a whole number"),
        ({"program": str(MODEL), "speed": 0}, "`speed` must be a number"),
        ({"program": [1]}, "`program` must be a list of strings"),
        ({"test": f"{TESTS}::never end"}, "did you mean `never ends`"),
        ({"test": str(MODEL)}, "lamps.swarm"),
        ({"test": str(TESTS), "until": "1s"}, "`until` and `test` conflict"),
    ],
)
def test_wrong_launches_are_refused(client: Client, arguments: dict[str, object], why: str) -> None:
    client.request("initialize")
    with pytest.raises(RefusedError) as refused:
        client.request("launch", **arguments)
    assert why in str(refused.value)
    # The client can try again.
    client.request("launch", program=str(MODEL))
    client.request("configurationDone")
    assert client.stop()["reason"] == "pause"


def test_wrong_requests_are_refused(client: Client) -> None:
    odd = {"type": "request", "seq": "x", "command": 3}
    for message in (None, 1, [], {}, {"type": "request"}, odd):
        client.write(message)
    for command, arguments in (
        ("nonsense", {}),
        ("stackTrace", {"threadId": 1}),
        ("continue", {"threadId": 1}),
        ("setBreakpoints", {"source": {"path": str(MODEL)}}),
        ("configurationDone", {}),
    ):
        with pytest.raises(RefusedError):
            client.request(command, **arguments)
    run_until_quiet(client)
    for command, arguments in (
        ("launch", {"program": str(MODEL)}),
        ("stackTrace", {}),
        ("stackTrace", {"threadId": 9}),
        ("stackTrace", {"threadId": "1"}),
        ("scopes", {"frameId": 99}),
        ("variables", {"variablesReference": -1}),
        ("evaluate", {"expression": None}),
        ("evaluate", {"expression": "(" * 5000}),
        ("evaluate", {"expression": '"'}),
        ("evaluate", {"expression": "1 / 0"}),
        ("setVariable", {"variablesReference": 1}),
        ("setBreakpoints", {"source": "here"}),
        ("setBreakpoints", {"source": {"path": "\0"}}),
        ("breakpointLocations", {"source": {"path": "\ud800"}, "line": 1}),
        ("completions", {"text": 3}),
        ("swarmSend", {"event": {}}),
        ("swarmGo", {"request": "launch"}),
        ("swarmGo", {"request": "stepIn"}),
        ("stepIn", {"threadId": 0}),
    ):
        with pytest.raises(RefusedError) as refused:
            client.request(command, **arguments)
        assert "internal error" not in str(refused.value)
    said = client.request("setBreakpoints", source={"path": "x"}, breakpoints=[1, {"line": "x"}])
    assert [each["verified"] for each in said["breakpoints"]] == [False, False]
    assert client.go("next")["reason"] == "pause"


def test_streams_and_port_conflict(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["debug", "--stdio", "--tcp", "5008"]) == 2
    assert "conflict" in capsys.readouterr().err
