"""Proofs about swarms that lose robots, with and without heartbeats."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import pytest

from swarmdsl.cli import run
from swarmdsl.execution.verify.automata.limits import Budget, Limits
from swarmdsl.execution.verify.findings.findings import survey
from swarmdsl.execution.verify.swarm.model import Model

from .conftest import lines_of, verdicts_of

_FIELD = """package field
event Seen : std_msgs/Empty
swarm event Found : std_msgs/Empty
swarm event Ok : std_msgs/Empty
function land : abstraction {{ service "land" : std_srvs/Empty }}
statemachine Fly {{
  initial Circle
  state Circle {{
    on Seen / send Found -> Wait
    {circling}
  }}
  state Wait {{
    on Ok -> Land
    {waiting}
  }}
  state Land {{
    do land
    on succeeded -> Down
    on aborted -> Land
  }}
  final Down
}}
endless statemachine Watch {{
  initial Ready
  state Ready {{ on Found / send Ok -> Ready }}
}}
member Drone {{ behavior Fly }}
member Tower {{ behavior Watch }}
swarm Field {{
  drone : Drone[{drones}]
  tower : Tower
  heartbeat 1 s lost after 5 s
}}
{properties}
"""


_ENDED = "never (some drone in Down and tower in Alone)"


def field(*properties: str, circling: str = "", waiting: str = "", drones: str = "1..9") -> str:
    named = "\n".join(f"property P{n} of Field : {text}" for n, text in enumerate(properties))
    return _FIELD.format(circling=circling, waiting=waiting, drones=drones, properties=named)


def outcomes(model: Model) -> list[str]:
    return [each.outcome for each in verdicts_of(model).values()]


def test_a_robot_waits_for_ever_for_a_lost_one_unless_it_is_told(
    modelled: Callable[..., Model],
) -> None:
    waits = "each drone : in Wait leads to in Land"
    told = "on member_lost -> Land"

    assert outcomes(modelled(field(waits))) == ["holds"]
    assert outcomes(modelled(field(waits), faults=1)) == ["fails"]
    # The tower is lost before the drone waits: it has got the event already.
    assert outcomes(modelled(field(waits, waiting=told), faults=1)) == ["fails"]
    both = field(waits, waiting=told, circling="on member_lost -> Down")
    assert outcomes(modelled(both, faults=1)) == ["holds"]
    knows = field(waits, waiting=told).replace("on Seen", "on Seen [present(tower) > 0]")
    assert outcomes(modelled(knows, faults=1)) == ["holds"]


def test_without_losses_nobody_is_told_of_one(modelled: Callable[..., Model]) -> None:
    text = field(
        "never some drone in Down", circling="on member_lost -> Down", waiting="on Seen -> Wait"
    )
    model = modelled(text.replace("on succeeded -> Down", "on succeeded -> Land"))

    assert outcomes(model) == ["holds"]
    # What robots do of which none is lost is no finding.
    assert not any(each.name == "Down" for each in survey(model, Budget(Limits())).findings)


def test_no_more_robots_are_lost_than_may_be(modelled: Callable[..., Model]) -> None:
    text = (
        field(
            "never some drone in Down",
            circling="on member_lost [present(drone) < 2] -> Down",
            drones="3",
        )
        .replace("on succeeded -> Down", "on succeeded -> Land")
        .replace("on Seen /", "on Ok /")
    )

    assert outcomes(modelled(text, faults=1)) == ["holds"]
    (verdict,) = verdicts_of(modelled(text, faults=2)).values()
    assert verdict.outcome == "fails"
    assert verdict.run is not None
    assert len(verdict.run.gone) == 2
    told = [each for each in lines_of(verdict) if "member_lost" in each]
    assert len(told) == 2
    assert len(set(told)) == 1


def test_a_loss_is_noticed_as_late_as_in_simulations(modelled: Callable[..., Model]) -> None:
    (verdict,) = verdicts_of(
        modelled(field("never some drone in Down", circling="on member_lost -> Down"), faults=1)
    ).values()

    assert verdict.run is not None
    ((at, robot, time),) = verdict.run.gone
    assert (robot, verdict.run.lines[at].event) == ("tower[0]", "fault.lost")
    # The last heartbeat was sent at the moment of the loss.
    assert time % 1_000_000_000 == 0
    assert verdict.run.lines[-1].time - time == 5_000_000_000


def test_a_loss_before_a_time_that_is_too_long_is_noticed_as_in_simulations(
    modelled: Callable[..., Model],
) -> None:
    sentence = "each drone : in Far leads to in Down within 2500 ms"
    text = field(sentence, circling="after 700 ms -> Wait", waiting="on member_lost -> Far")
    unasked = text.replace("on Seen / send Found -> Wait", "").replace("1..9", "1")
    slow = unasked.replace("final Down", "state Far { after 9 s -> Down }\n  final Down")
    (verdict,) = verdicts_of(modelled(slow, faults=1)).values()

    assert verdict.run is not None
    ((_, _, time),) = verdict.run.gone
    (told,) = (each.time for each in verdict.run.lines if each.event == "member_lost")
    assert time % 1_000_000_000 == 0
    assert told - time == 5_000_000_000


def test_what_is_on_its_way_to_a_robot_has_not_taken_too_long_when_it_is_lost(
    modelled: Callable[..., Model],
) -> None:
    text = field(
        "each drone : in Wait leads to in Land within 6 s", waiting="on member_lost -> Land"
    )
    asked = text.replace("on Seen /", "on Seen [present(tower) > 0] /").replace("1..9", "1")

    # The tower answers at once, or the drone is told five seconds after its loss.
    (verdict,) = verdicts_of(modelled(asked, faults=1)).values()
    assert (verdict.outcome, "is impossible" in verdict.reason) == ("unknown", True)
    assert verdict.reason.endswith("; without losses, try `--time exact --faults 0`")
    (verdict,) = verdicts_of(modelled(asked, faults=1, exact=True)).values()
    assert verdict.reason.endswith("clocks are for robots that are not lost: try `--faults 0`")


def test_times_of_heartbeats_rule_runs_out(modelled: Callable[..., Model]) -> None:
    seen = "on Seen / send Found -> Wait"
    text = field("never some drone in Land", circling="after 3 s -> Down\n on member_lost -> Land")
    once = text.replace(seen, "").replace("on Ok -> Land", "on Ok -> Wait")

    # The drone has left the state when it is told.
    (verdict,) = verdicts_of(modelled(once, faults=1)).values()
    assert (verdict.outcome, "too early or too late" in verdict.reason) == ("unknown", True)
    assert outcomes(modelled(once.replace("after 3 s", "after 6 s"), faults=1)) == ["fails"]


def test_lost_robots_are_not_among_all(modelled: Callable[..., Model]) -> None:
    text = field(
        "all drone in Circle at all times",
        "count(drone in Circle) == 2 at all times",
        "no drone in Circle at all times",
        "each drone : all other drone in Circle at all times",
        drones="2",
    ).replace("on Seen / send Found -> Wait", "on Seen -> Circle")

    assert outcomes(modelled(text)) == ["holds", "holds", "fails", "holds"]
    assert outcomes(modelled(text, faults=1)) == ["holds", "fails", "fails", "holds"]
    assert outcomes(modelled(text, faults=2)) == ["holds", "fails", "fails", "holds"]


def test_what_each_must_do_is_not_asked_of_lost_robots(modelled: Callable[..., Model]) -> None:
    text = field(
        "each tower : again and again in Ready",
        "each drone : always possible in Down",
        "always possible all drone in Down",
        "always possible some drone in Down",
        waiting="on member_lost -> Land",
        circling="on member_lost -> Land",
    )

    # The only drone is lost, and no one is in `Down` then.
    assert outcomes(modelled(text, faults=1)) == ["holds", "holds", "holds", "fails"]


def test_others_are_told_that_a_robot_is_lost_that_has_ended(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path, test = tmp_path / "field.swarm", tmp_path / "field.swarmtest.toml"
    text = field("tower in Alone only after some drone sends Found")
    text = text.replace("on Seen / send Found -> Wait", "on Seen -> Down")
    text = text.replace("state Ready {", "state Ready {\n on member_lost -> Alone\n")
    text = text.replace("-> Ready }\n}", "-> Ready }\n state Alone { on Found -> Ready }\n}")
    path.write_text(text.replace("sends Found", "in Circle"), encoding="utf-8")
    assert run(["verify", str(path), "--faults", "1", "--property", "P0"]) == 0
    # Only after the machine of the drone has ended, the tower is told.
    never = text.replace("tower in Alone only after some drone sends Found", _ENDED)
    path.write_text(never, encoding="utf-8")
    capsys.readouterr()
    run(["verify", str(path), "--faults", "1", "--property", "P0", "--save-test", str(test)])
    told = capsys.readouterr().out

    assert "drone[0] is lost" in told
    assert "member_lost -> Alone" in told
    assert '{ lose = "drone[0]" }' in test.read_text()
    assert run(["test", str(test)]) == 1


def test_a_reliable_event_is_lost_with_its_sender_only(modelled: Callable[..., Model]) -> None:
    text = (
        field("each drone : in Wait leads to in Land")
        .replace(
            "swarm event Found : std_msgs/Empty",
            "swarm event Found : std_msgs/Empty {\n  reliable\n}",
        )
        .replace(
            "swarm event Ok : std_msgs/Empty", "swarm event Ok : std_msgs/Empty {\n  reliable\n}"
        )
    )
    asks = text.replace(
        "each drone : in Wait leads to in Land", "some drone sends Found leads to tower sends Ok"
    )

    assert outcomes(modelled(text, lossy=True)) == ["holds"]
    assert outcomes(modelled(asks, lossy=True)) == ["holds"]
    (verdict,) = verdicts_of(modelled(asks, lossy=True, faults=1)).values()
    assert verdict.outcome == "fails"


def test_robots_that_are_told_apart_are_lost_by_name(modelled: Callable[..., Model]) -> None:
    text = field(
        "drone[1] in Land only after some drone in Land",
        "never drone[1] in Down and drone[0] in Circle",
        circling='on member_lost [event.id == "drone[0]"] -> Land',
        waiting="on Seen -> Wait",
        drones="2",
    ).replace("on Ok -> Land", "on Ok -> Wait")

    first, second = verdicts_of(modelled(text, faults=1)).values()
    assert first.outcome == "holds"
    # If drone[0] is lost, it is in no state.
    assert second.outcome == "holds"
    assert outcomes(modelled(text.replace('"drone[0]"', '"tower[0]"'), faults=1)) == [
        "holds",
        "fails",
    ]


def test_losses_in_swarms_of_every_size(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "field.swarm"
    text = field(
        "never some drone in Land and tower in Ready",
        "some drone in Land only after tower sends Ok",
        "never count(drone in Land) > 2",
        circling="on member_lost -> Wait",
        drones="1..*",
    )
    path.write_text(text, encoding="utf-8")
    results = tmp_path / "results.json"
    run(["verify", str(path), "--size", "drone=any", "--faults", "1", "--results", str(results)])

    told = json.loads(results.read_text())
    found = {each["name"]: each for each in told["properties"]}
    assert found["P1"]["verdict"] == "holds"
    assert "for 1 or more drone" in found["P1"]["reason"]
    assert (found["P2"]["verdict"], found["P2"]["size"]) == ("fails", {"drone": 3})
    assert told["lost"] == 1
    assert "with at most 1 robot lost, at any time, for ever" in told["conditions"]
    assert "holds" in capsys.readouterr().out


_TOLD = """package told
endless statemachine M {
  initial S0
  state S0 { on member_lost -> S1 }
  state S1 { on member_lost -> S2 }
  state S2 { on member_lost -> S3 }
  state S3 { on member_lost -> S4 }
  state S4 { on member_lost -> S4 }
}
member A { behavior M }
swarm S {
  a : A[1..*]
  heartbeat 1 s lost after 5 s
}
property P of S : each a : never in S4
"""


def test_in_swarms_of_every_size_each_robot_may_hear_of_all_losses(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path, scenario = tmp_path / "told.swarm", tmp_path / "lost.toml"
    path.write_text(_TOLD, encoding="utf-8")
    scenario.write_text('[[faults]]\nat = "3 s"\nlost = "a"\n', encoding="utf-8")
    told = []
    for options in (["--faults", "3"], ["--faults", "4"], ["--scenario", str(scenario)]):
        run(["verify", str(path), "--size", "a=any", "--property", "P", *options])
        lines = capsys.readouterr().out.splitlines()
        told.append(next(line for line in lines if line.startswith("  P  ")))

    assert "holds  for 1 or more a" in told[0]
    assert told[1].endswith("it takes 5 a")
    assert "any number of `a` can be lost, and others are told" in told[2]


def test_presence_is_not_covered_for_every_size(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "field.swarm"
    for role, outcome in (("tower", "holds"), ("drone", "unknown")):
        guard = f"on member_lost [present({role}) < 1] -> Land"
        text = field(
            "some drone in Land only after some drone hears Ok", waiting=guard, drones="1..*"
        )
        path.write_text(text.replace("some drone hears Ok", "some drone in Wait"), encoding="utf-8")
        run(["verify", str(path), "--size", "drone=any", "--faults", "1", "--property", "P0"])
        told = capsys.readouterr().out
        assert f"P0  {outcome}" in told
        assert ("how many robots are present" in told) == (outcome == "unknown")


def test_runs_with_losses_are_replayed_and_become_tests(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path, test = tmp_path / "field.swarm", tmp_path / "field.swarmtest.toml"
    text = field(
        "never some drone in Land",
        "each drone : in Wait leads to in Land",
        circling="on member_lost -> Land",
    )
    path.write_text(text, encoding="utf-8")
    # Without losses, it is told that nothing is said of robots that wait.
    silent = "open: which robots wait, and what never happens, as some follow who is lost: try"
    for faults, is_told in (("0", True), ("1", False)):
        run(["verify", str(path), "--faults", faults])
        assert (silent in capsys.readouterr().out) == is_told
    runs = tmp_path / "runs"
    chosen = ["--property", "P0", "--property", "P1", "--faults", "1"]
    code = run(["verify", str(path), *chosen, "-o", str(runs), "--save-test", str(test)])
    told = capsys.readouterr().out

    assert code == 1
    assert "with at most 1 robot lost, at any time, for ever" in told
    assert "each other robot gets `member_lost` some time after a loss" in told
    for name in ("P0", "P1"):
        run(["simulate", str(path), "--replay", str(runs / f"{name}.jsonl"), "--property", name])
        assert f"property `{name}` is violated" in capsys.readouterr().err
    assert test.read_text().count('{ lose = "tower[0]" }') == 2
    assert run(["test", str(test)]) == 1
    told = capsys.readouterr().out
    assert "FAILED  P0" in told
    assert "FAILED  P1 for drone[0]" in told
    # With a way out, the tests pass.
    path.write_text(
        text.replace("on Ok -> Land", "on Ok -> Land\n after 9 s -> Land").replace(
            "on member_lost -> Land", ""
        ),
        encoding="utf-8",
    )
    run(["test", str(test)])
    assert "FAILED" not in capsys.readouterr().out


def test_without_a_heartbeat_a_loss_is_silent(modelled: Callable[..., Model]) -> None:
    text = field("each drone : in Wait leads to in Land", "never some drone in Land")
    text = text.replace("  heartbeat 1 s lost after 5 s\n", "")
    first, second = verdicts_of(modelled(text, faults=1)).values()

    assert first.outcome == "fails"
    assert second.outcome == "fails"
    assert first.run is not None
    assert "member_lost" not in "".join(lines_of(first))
