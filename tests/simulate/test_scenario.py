"""Scenarios: durations, outcomes, results, messages, faults, and errors."""

from __future__ import annotations

from collections import Counter
from itertools import pairwise, product
from pathlib import Path

import pytest

from .conftest import Simulate

WORK = """
endless statemachine Work {
  param pause : duration = 1 s
  var n  : int32 = 0
  var id : string
  initial Busy
  state Busy {
    do go(speed = 1.0) gives (count => n, id => id)
    on succeeded [n > 5 and id == "x"] -> Much
    on succeeded -> Pause
    on aborted   -> Bad
    on preempted -> Ugly
  }
  state Much  { after pause -> Busy }
  state Pause { after pause -> Busy }
  state Bad   { after pause -> Busy; on Found -> Told }
  state Ugly  { after pause -> Busy }
  state Told  { entry / send Found; on Start -> Busy }
}
member Uav { behavior Work }
member Rover extends Uav { }
swarm S {
  uav   : Uav[2]
  rover : Rover
}
"""


def entered(trace: list[dict[str, object]]) -> Counter[str]:
    return Counter(state for line in trace for state in line["entered"])  # type: ignore[attr-defined]


def test_durations_for_all_for_a_role_for_one(simulate: Simulate) -> None:
    scenario = """
      until = "20 s"
      [functions."*"]
      duration = "9 s"
      [functions.go]
      duration = "5 s"
      of.Uav.duration = "4 s"
      of."uav[1]".duration = "3500 ms"
    """
    ran = simulate(WORK, scenario=scenario)

    assert [ran.of(name)[1]["t"] for name in ("uav[0]", "uav[1]", "rover[0]")] == [4000, 3500, 5000]
    assert 19_000 < ran.trace[-1]["t"] <= 20_000


def test_random_durations(simulate: Simulate) -> None:
    scenario = """
      [functions.go]
      duration = { uniform = ["2 s", "3 s"] }
      of.rover.duration = { normal = ["10 s", "1 s"] }
    """
    ran = simulate(WORK, "--until", "5000s", scenario=scenario)
    for member, low, high, mean in (
        ("uav[0]", 2000, 3000, 2500),
        ("rover[0]", 4000, 16_000, 10_000),
    ):
        lines = ran.of(member)
        took = [after["t"] - before["t"] for before, after in pairwise(lines) if before["started"]]
        assert low <= min(took) < max(took) <= high
        assert abs(sum(took) / len(took) - mean) < (high - low) / 20


def test_outcomes_and_results(simulate: Simulate) -> None:
    scenario = """
      [functions.go]
      aborted   = 0.3
      preempted = 0.1
      results   = [{ count = 9, id = "x" }, { count = 1 }]
    """
    ran = simulate(WORK, "--until", "10000s", scenario=scenario)
    times = entered(ran.trace)
    runs = times["Much"] + times["Pause"] + times["Bad"] + times["Ugly"]

    shares = {state: times[state] / runs for state in ("Much", "Pause", "Bad", "Ugly")}
    assert shares == pytest.approx({"Much": 0.3, "Pause": 0.3, "Bad": 0.3, "Ugly": 0.1}, abs=0.02)


ALARM = """
function ring : abstraction { service "ring" : std_srvs/Trigger }
statemachine Alarm {
  var why  : string
  var rung : bool
  initial First
  state First {
    do ring gives (message => why)
    on succeeded [why == ""] -> Second
    on succeeded, aborted    -> Silent
  }
  state Second {
    do ring gives (success => rung)
    on succeeded [rung] -> Heard
    on succeeded        -> Refused
    on aborted          -> Silent
  }
  final Heard
  final Refused
  final Silent
}
"""


@pytest.mark.parametrize(
    ("results", "ways"),
    [
        ([], ["do.First.succeeded", "do.Second.succeeded", "Heard"]),
        (["success = false"], ["do.First.aborted", "Silent"]),
        (['message = "late"'], ["do.First.succeeded", "Silent"]),
    ],
)
def test_services_say_whether_they_have_succeeded(
    results: list[str], ways: list[str], simulate: Simulate
) -> None:
    tables = ", ".join(f"{{ {each} }}" for each in results)
    ran = simulate(ALARM, scenario=f"[functions.ring]\nresults = [{tables}]")

    assert [line["event"] for line in ran.trace[1:]] == ways[:-1]
    assert ran.trace[-1]["configuration"] == ways[-1:]


def test_a_model_may_look_itself_whether_a_service_has_succeeded(simulate: Simulate) -> None:
    events = [
        {"event": "do.First.succeeded"},
        {"event": "do.Second.succeeded", "data": {"success": False}},
    ]
    ran = simulate(ALARM, events=events)

    assert ran.trace[-1]["configuration"] == ["Refused"]


def test_a_server_that_never_answers(simulate: Simulate) -> None:
    ran = simulate(WORK, scenario="[functions.go]\nof.rover.never = 1\n")

    assert len(ran.of("rover[0]")) == 1
    assert len(ran.of("uav[0]")) > 100


def test_messages(simulate: Simulate) -> None:
    scenario = """
      [functions.go]
      aborted = 1.0
      [[messages]]
      event = "Found"
      at    = "1500 ms"
      to    = ["uav[0]", "rover"]
      data  = { id = "m" }
      [[messages]]
      event = "Start"
      at    = { uniform = ["5 s", "9 s"] }
      every = "1 min"
    """
    ran = simulate(WORK, "--until", "90s", scenario=scenario)
    found = [line for line in ran.trace if line["event"] == "Found" and line["t"] == 1500]
    starts = {
        m: [line["t"] for line in ran.of(m) if line["event"] == "Start"]
        for m in ("uav[0]", "uav[1]")
    }

    assert [line["member"] for line in found][:2] == ["uav[0]", "rover[0]"]
    assert all(
        5000 <= first <= 9000 and second == first + 60_000 for first, second in starts.values()
    )
    assert starts["uav[0]"] != starts["uav[1]"]


def test_latency_and_loss(simulate: Simulate) -> None:
    text = """
      endless statemachine Beacon { initial A; state A { after 1 s / send Found -> A } }
      endless statemachine Listener { initial A; state A { on Found -> A } }
      member B { behavior Beacon }
      member L { behavior Listener }
      swarm S { b : B; l : L[2] }
    """
    scenario = '[network]\nlatency = { uniform = ["20 ms", "40 ms"] }\nloss = 0.25\n'
    ran = simulate(text, "--until", "4000s", scenario=scenario)
    delays = [line["t"] % 1000 for line in ran.trace if line["event"] == "Found"]

    assert 20 <= min(delays) < max(delays) <= 40
    assert len(delays) / 8000 == pytest.approx(0.75, abs=0.02)


def test_events_on_a_topic_keep_their_order(simulate: Simulate) -> None:
    """A random latency lets events on different topics overtake each other, as on robots."""
    text = """
      message swarmros/EventHeader { name : string, node : string }
      message Numbered { swarmio : swarmros/EventHeader, number : int32 }
      swarm event First : Numbered
      swarm event Second : Numbered
      statemachine Talk {
        var n : int32 = 0
        initial A
        state A {
          [n < 40] / send First(number = n), send Second(number = n), n = n + 1 -> A
          [n >= 40] -> End
        }
        final End
      }
      endless statemachine Listen { initial A; state A { on First -> A; on Second -> A } }
      member T { behavior Talk }
      member L { behavior Listen }
      swarm S { t : T[2]; l : L[2] }
    """
    scenario = '[network]\nlatency = { uniform = ["0 ms", "10 s"] }\nloss = 0.1\n'
    ran = simulate(text, "--until", "30s", scenario=scenario)
    heard = [line for line in ran.trace if line["event"] in ("First", "Second")]

    def numbers(listener: str, sender: str, *events: str) -> list[int]:
        return [
            line["data"]["number"]
            for line in heard
            if (line["member"], line["data"]["swarmio"]["node"]) == (listener, sender)
            and line["event"] in events
        ]

    for channel in product(("l[0]", "l[1]"), ("t[0]", "t[1]")):
        for event in ("First", "Second"):
            ordered = numbers(*channel, event)
            assert 25 < len(ordered) <= 40
            assert ordered == sorted(ordered)
        both = numbers(*channel, "First", "Second")
        assert both != sorted(both)


def test_robots_fill_in_empty_headers(simulate: Simulate) -> None:
    text = """
      message swarmros/EventHeader { name : string, node : string }
      message Seen { header : std_msgs/Header, swarmio : swarmros/EventHeader }
      swarm event Plain : Seen
      swarm event Signed : Seen on "signed/by"
      statemachine Talk {
        var own : Seen
        initial A
        state A {
          after 2 s / own.swarmio.node = "me", send Plain, send Signed(swarmio = own.swarmio) -> B
        }
        final B
      }
      statemachine Listen {
        initial A
        state A { on Plain [event.swarmio.node == "t[1]"] -> B }
        state B { on Signed -> C }
        final C
      }
      member T { behavior Talk }
      member L { behavior Listen }
      swarm S { t : T[2]; l : L }
    """
    ran = simulate(text)
    data = {line["event"]: line["data"] for line in ran.of("l[0]")[1:]}

    stamp = 2 * 10**9
    assert data["Plain"] == {
        "header": {"seq": 0, "stamp": stamp, "frame_id": ""},
        "swarmio": {"name": "plain", "node": "t[1]"},
    }
    # A robot cannot send in the name of another one.
    assert data["Signed"]["swarmio"]["name"] == "signed/by"
    assert data["Signed"]["swarmio"]["node"] in ("t[0]", "t[1]")
    assert ran.of("l[0]")[-1]["configuration"] == ["C"]


def test_faults(simulate: Simulate) -> None:
    scenario = """
      [[faults]]
      at   = "10 s"
      lost = "uav[0]"
      [[faults]]
      at     = "10500 ms"
      silent = "go"
      of     = "uav[1]"
      lasts  = "1 min"
    """
    ran = simulate(WORK, "--until", "100s", scenario=scenario)

    assert (ran.of("uav[0]")[-1]["t"], ran.of("uav[0]")[-1]["event"]) == (10_000, "fault.lost")
    # What runs or starts while the server is silent is never answered.
    assert 10_000 <= ran.of("uav[1]")[-1]["t"] <= 11_000
    assert ran.of("rover[0]")[-1]["t"] == 100_000


def test_nothing_reaches_a_robot_that_is_lost(simulate: Simulate) -> None:
    text = """
      endless statemachine M {
        initial A
        state A { on Start / send Found -> A; on Found -> A }
      }
      member B { behavior M }
      swarm S { b : B[2] }
    """
    scenario = """
      [[faults]]
      at   = "1 s"
      lost = "b[1]"
      [[messages]]
      event = "Start"
      at    = "2 s"
      to    = "b[0]"
      [[messages]]
      event = "Found"
      at    = "3 s"
      every = "1 s"
      to    = "b[1]"
    """
    ran = simulate(text, scenario=scenario)

    assert ran.of("b[1]")[-1]["event"] == "fault.lost"
    assert [line.split() for line in ran.err.splitlines() if line.startswith("Found")] == [
        ["Found", "1", "-", "1"]
    ]
    assert "3 s of virtual time, until nothing was left to happen" in ran.err


def test_a_server_is_free_again_when_its_silence_is_over(simulate: Simulate) -> None:
    ran = simulate(
        """
        statemachine Work {
          initial Go
          state Go { do land
                     on succeeded -> End
                     on aborted   -> Go
                     after 4 s    -> Go }
          final End
        }
        """,
        scenario="[[faults]]\nat = '500 ms'\nsilent = 'land'\nlasts = '9 s'",
    )

    # The third call waits for the server, and ends a second after it was free.
    assert (ran.trace[-1]["t"], ran.trace[-1]["configuration"]) == (10_500, ["End"])


def test_the_end_of_a_silence_does_not_end_another_one(simulate: Simulate) -> None:
    ran = simulate(
        """
        statemachine Work {
          initial Go
          state Go { do land
                     on succeeded -> End
                     on aborted   -> Go
                     after 4 s    -> Go }
          final End
        }
        """,
        scenario="""
          [[faults]]
          at     = "500 ms"
          silent = "land"
          lasts  = "9 s"
          [[faults]]
          at     = "1 s"
          silent = "land"
          lasts  = "2 s"
        """,
    )

    assert (ran.trace[-1]["t"], ran.trace[-1]["configuration"]) == (10_500, ["End"])


def test_a_folder_is_no_scenario(simulate: Simulate, tmp_path: Path) -> None:
    ran = simulate(WORK, "--scenario", str(tmp_path))

    assert ran.code == 1
    assert "is a folder, not a scenario\n  = help: name a file in it\n" in ran.err


def test_the_same_seed_gives_the_same_bytes(simulate: Simulate) -> None:
    scenario = """
      seed = 5
      [functions.go]
      duration = { normal = ["10 s", "3 s"] }
      aborted  = 0.4
      [network]
      loss = 0.5
    """
    first, second = simulate(WORK, scenario=scenario), simulate(WORK, scenario=scenario)

    assert first.out == second.out != ""
    assert simulate(WORK, "--seed", "5", scenario=scenario).out == first.out
    assert simulate(WORK, "--seed", "6", scenario=scenario).out != first.out


def test_numbers_are_those_of_every_platform(simulate: Simulate) -> None:
    """Written down once: what another platform or version makes of the seed must be this."""
    scenario = """
      [functions.go]
      duration = { normal = ["10 s", "3 s"] }
      aborted  = 0.4
    """
    ran = simulate(WORK, "--until", "60s", "--seed", "7", scenario=scenario)

    assert [(line["t"], *line["configuration"]) for line in ran.of("uav[0]")] == [
        (0, "Busy"),
        (14_033, "Pause"),
        (15_033, "Busy"),
        (26_539, "Pause"),
        (27_539, "Busy"),
        (36_574, "Pause"),
        (37_574, "Busy"),
        (49_064, "Pause"),
        (50_064, "Busy"),
    ]


def test_one_more_member_changes_nothing_for_the_others(simulate: Simulate) -> None:
    scenario = """
      [functions.go]
      duration = { uniform = ["2 s", "9 s"] }
      aborted  = 0.4
      [count]
    """
    text = WORK.replace("Uav[2]", "Uav[1..9]")
    few = simulate(text, scenario=f"{scenario}uav = 2")
    many = simulate(text, scenario=f"{scenario}uav = 7")

    for member in ("uav[0]", "uav[1]", "rover[0]"):
        assert few.of(member) == many.of(member)


def test_params_of_a_machine_alone(simulate: Simulate) -> None:
    ran = simulate(
        WORK, "--machine", "Work", "--until", "1min", scenario='[params]\npause = "30 s"\n'
    )

    assert [line["t"] for line in ran.trace] == [0, 1000, 31_000, 32_000]


@pytest.mark.parametrize(
    ("text", "said", "place"),
    [
        ("sed = 1", "SW0012]: a scenario has no key `sed`", "1:1"),
        ("seed = 1.5", "SW0013]: `seed` takes a whole number, not `1.5`", "1:8"),
        ("until = 30", 'SW0013]: `until` takes a time like "1.5 s", with `us`, `ms`, `s`,', "1:9"),
        ("until = '9999999 h'", "SW0013]: `until` takes at most 292 years, not", "1:9"),
        ("until = [", "SW0011]: `scenario.toml` is not valid TOML", "1:10"),
        ("[count]\nuva = 3", "SW0202]: no role called `uva`", "2:1"),
        ("[count]\nrover = 3", "SW0013]: `rover` takes 1, not `3`", "2:9"),
        ("[functions.og]", "SW0202]: no function called `og`", "1:12"),
        ("[functions.go]\ndurtion = '1 s'", "SW0012]: a function has no key `durtion`", "2:1"),
        ("[functions.go]\nduration = 3", "SW0013]: `duration` takes a time", "2:12"),
        (
            "[functions.go]\nduration = { unifrm = ['1 s', '2 s'] }",
            "SW0013]: `duration` takes a",
            "2:12",
        ),
        (
            "[functions.go]\nduration = { uniform = ['3 s', '2 s'] }",
            "SW0013]: `uniform` takes the",
            "2:24",
        ),
        (
            "[functions.go]\nduration = { normal = ['3 s', 2] }",
            "SW0013]: `normal` takes a time",
            "2:31",
        ),
        ("[functions.go]\naborted = 1.5", "SW0013]: `aborted` takes a probability", "2:11"),
        ("[functions.go]\naborted = 0.6\nnever = 0.5", "SW0013]: `never` takes at most", "3:9"),
        ("[functions.go.of.uva]", "SW0202]: no member called `uva`", "1:18"),
        (
            "[functions.go]\nresults = [{ cuont = 1 }]",
            "SW0601]: the result has no field `cuont`",
            "2:14",
        ),
        (
            "[functions.go]\nresults = [{ count = 'x' }]",
            "SW0013]: `count` takes a whole number",
            "2:22",
        ),
        ("[functions.go]\nresults = 3", "SW0013]: `results` takes tables", "2:11"),
        ("[functions.go]\nresults = [3]", "SW0013]: `results` takes a table, not `3`", "2:12"),
        ("messages = [3]", "SW0013]: `messages` takes a table, not `3`", "1:13"),
        ("[params.uva]", "SW0202]: no member called `uva`", "1:9"),
        ("[params.uav]\npuase = '1 s'", "SW0202]: no param called `puase`", "2:1"),
        ("[params.uav]\npause = 1", "SW0013]: `pause` takes a time", "2:9"),
        ("[network]\nloss = 2", "SW0013]: `loss` takes a probability from 0 to 1, not `2`", "2:8"),
        ("[network]\njitter = 2", "SW0012]: `[network]` has no key `jitter`", "2:1"),
        ("[[messages]]\nevent = 'Start'", "SW1008]: missing key `at`", "1:3"),
        ("[[messages]]\nevent = 'Strat'\nat = '1 s'", "SW0202]: no event called `Strat`", "2:9"),
        (
            "[[messages]]\nevent = 'Start'\nat = '1 s'\nto = 'me'",
            "SW0202]: no member called `me`",
            "4:6",
        ),
        (
            "[[messages]]\nevent = 'Found'\nat = '1 s'\ndata = { lvl = 3 }",
            "SW0601]: `test/Report`",
            "4:10",
        ),
        (
            "[[messages]]\nevent = 'Found'\nat = '1 s'\nevery = '0 s'",
            "SW0013]: `every` takes a",
            "4:9",
        ),
        ("[[faults]]\nat = '1 s'", "SW1008]: missing key `lost`", "1:3"),
        ("[[faults]]\nat = '1 s'\nlost = 'uav[2]'", "SW0202]: no member called `uav[2]`", "3:8"),
        ("[[faults]]\nat = '1 s'\nsilent = 'og'", "SW0202]: no function called `og`", "3:10"),
        ("[faults]\nat = '1 s'", "SW0013]: `faults` takes tables: `[[faults]]`", "1:2"),
        ("functions = 3", "SW0013]: `functions` takes a table, not `3`", "1:13"),
    ],
)
def test_mistakes(text: str, said: str, place: str, simulate: Simulate) -> None:
    ran = simulate(WORK, scenario=text)

    assert (ran.code, ran.out) == (1, "")
    assert f"error[{said}" in ran.err
    assert f"--> scenario.toml:{place}\n" in ran.err
    assert ran.err.count("error[") == 1


def test_a_scenario_that_is_not_there(simulate: Simulate) -> None:
    ran = simulate(WORK, "--scenario", "none.toml")

    assert (ran.code, ran.out) == (1, "")
    assert "error[SW0001]" in ran.err


WEEDS = """
enum Species { DOCK, THISTLE = 3, NETTLE }
message Weed { species : Species, near : Species[] }
swarm event Seen : Weed

endless statemachine Weeding {
  param wanted : Species = Species.DOCK
  var last : Species = Species.DOCK
  initial Search
  state Search {
    on Seen [event.species == wanted and len(event.near) == 2] / last = event.species -> Spray
  }
  state Spray { on Start [last == Species.THISTLE] -> Search }
}
member Rover { behavior Weeding }
swarm S { rover : Rover }
"""


def test_values_of_enums_by_name(simulate: Simulate) -> None:
    scenario = """
      params.rover.wanted = "THISTLE"
      [[messages]]
      event = "Seen"
      at    = "1 s"
      data  = { species = "THISTLE", near = ["DOCK", "NETTLE"] }
    """
    ran = simulate(WEEDS, scenario=scenario)

    assert [line["configuration"] for line in ran.trace] == [["Search"], ["Spray"]]
    assert ran.trace[1]["data"] == {"species": 3, "near": [0, 4]}


def test_values_of_enums_by_name_in_events(simulate: Simulate) -> None:
    data = {"species": "DOCK", "near": ["NETTLE", 3]}
    ran = simulate(WEEDS, events=[{"event": "Seen", "after": 5, "data": data}])

    assert ran.trace[-1]["configuration"] == ["Spray"]
    assert ran.trace[-1]["data"] == {"species": 0, "near": [4, 3]}


@pytest.mark.parametrize(
    ("value", "message"),
    [
        ('"THISTEL"', 'a value of `Species`: `DOCK`, `THISTLE` or `NETTLE`, not `"THISTEL"`'),
        ("256", "a whole number from 0 to 255, not `256`"),
    ],
)
def test_values_that_an_enum_does_not_have(simulate: Simulate, value: str, message: str) -> None:
    ran = simulate(WEEDS, scenario=f"params.rover.wanted = {value}")

    assert ran.code == 1
    assert f"error[SW0013]: `wanted` takes {message}" in ran.err
    assert ("did you mean `THISTLE`?" in ran.err) == (value != "256")
