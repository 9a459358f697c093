"""Properties about time, without and with clocks."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path
from random import Random

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.cli import run
from swarmdsl.execution.monitor import FALSE
from swarmdsl.execution.simulate.evaluation.properties import plan, watch, watchable
from swarmdsl.execution.simulate.inputs.events import Input
from swarmdsl.execution.simulate.machines.actors import actors
from swarmdsl.execution.simulate.scenario.durations import (
    MILLISECOND,
    SECOND,
    Fixed,
    Length,
    Normal,
    Uniform,
)
from swarmdsl.execution.simulate.scenario.scenario import EVERY_FUNCTION, Fault, Scenario
from swarmdsl.execution.simulate.world.runner import run as simulate
from swarmdsl.execution.simulate.world.world import World
from swarmdsl.execution.verify.proofs.verdict import UNSURE
from swarmdsl.execution.verify.robot.environment import Options
from swarmdsl.execution.verify.search.run import written
from swarmdsl.execution.verify.swarm.model import Model

from .conftest import model_of, verdicts_of
from .random_timed import random_timed_swarm

_PRELUDE = """package test
function attempt : abstraction { service "attempt" : std_srvs/Empty }
function other : abstraction { service "other" : std_srvs/Empty }
event Go : std_msgs/Empty
swarm event Ask : std_msgs/Empty
swarm event Tell : std_msgs/Empty
"""
_DELAY = """endless statemachine M {
  initial S0
  state S0 { after 10 s -> S1 }
  state S1 { on Go -> S0 }
}
"""
_CALL = """endless statemachine M {
  initial S0
  state S0 {
    do attempt
    on succeeded, aborted -> S1
  }
  state S1 { on Go -> S0 }
}
"""
_ONE = "member A { behavior M }\nswarm S { a : A }\n"
_TWO = """member A { behavior M }
member B { behavior N }
swarm S {
  a : A
  b : B
}
"""
Modelled = Callable[..., Model]


def _outcome(modelled: Modelled, text: str, **options: object) -> str:
    (verdict,) = verdicts_of(modelled(_PRELUDE + text, **options)).values()
    return verdict.outcome


@pytest.mark.parametrize(
    ("length", "ignored", "exact"),
    [("10 s", "unknown", "holds"), ("9999 ms", "fails", "fails"), ("10001 ms", "unknown", "holds")],
)
def test_a_time_that_a_delay_ends_with_is_in_time(
    length: str, ignored: str, exact: str, modelled: Modelled
) -> None:
    text = f"{_DELAY}{_ONE}property P of S : each a : in S0 leads to in S1 within {length}"

    assert _outcome(modelled, text) == ignored
    assert _outcome(modelled, text, exact=True) == exact


@pytest.mark.parametrize(
    ("length", "within", "exact"),
    [
        (Fixed(2 * SECOND), "2 s", "holds"),
        (Fixed(2 * SECOND), "1 s", "fails"),
        (Uniform(SECOND, 3 * SECOND), "3 s", "holds"),
        (Uniform(SECOND, 3 * SECOND), "2 s", "fails"),
        # The sum of twelve numbers from 0 to 1 has a greatest value.
        (Normal(4 * SECOND, SECOND // 2), "7 s", "holds"),
        (Normal(4 * SECOND, SECOND // 2), "6500 ms", "fails"),
    ],
)
def test_functions_take_the_times_of_a_scenario(
    length: Length, within: str, exact: str, modelled: Modelled
) -> None:
    text = f"{_CALL}{_ONE}property P of S : each a : in S0 leads to in S1 within {within}"
    scenario = Scenario(functions={(EVERY_FUNCTION, ""): {"duration": length}})

    assert _outcome(modelled, text, times=scenario, exact=True) == exact
    ignored = _outcome(modelled, text, times=scenario)
    assert ignored == ("fails" if exact == "fails" else "unknown")


def test_a_function_without_a_scenario_takes_a_second(modelled: Modelled) -> None:
    text = f"{_CALL}{_ONE}property P of S : each a : in S0 leads to in S1 within"

    assert _outcome(modelled, f"{text} 1 s", exact=True) == "holds"
    assert _outcome(modelled, f"{text} 999 ms", exact=True) == "fails"
    model = modelled(f"{_PRELUDE}{text} 1 s")
    (verdict,) = verdicts_of(model).values()
    assert "functions would take longer than 1 s; try `--time exact`" in verdict.reason


_TRIES = _CALL.replace("on succeeded, aborted -> S1", "on succeeded -> S1\n    on aborted -> S0")
_PAIR = """message Pair {
  one : int32
  two : int32
}
event Both : Pair
"""


def test_what_need_not_happen_at_all_is_late(
    modelled: Modelled, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    text = f"{_TRIES}{_ONE}property P of S : each a : in S0 leads to in S1 within 10 min"
    (verdict,) = verdicts_of(modelled(f"{_PRELUDE}{text}")).values()

    # The function is aborted each time, a second after the last one.
    assert verdict.outcome == "fails"
    assert verdict.run is not None
    assert verdict.run.loop == 1
    model, trace = tmp_path / "model.swarm", tmp_path / "P.jsonl"
    trace.write_text("".join(f"{line}\n" for line in written(verdict.run)))
    run(["simulate", str(model), "--replay", str(trace)])
    assert "property `P` is violated" in capsys.readouterr().err
    # How probable that is, nobody says.
    (verdict,) = verdicts_of(modelled(f"{_PRELUDE}{text} at least 0.9")).values()
    assert verdict.reason == UNSURE


def test_values_that_were_not_tried_end_no_loop(modelled: Modelled) -> None:
    compared = "state S1 {\n on Both [event.one < event.two] -> S0\n"
    text = _TRIES.replace("state S1 {", compared)
    sentence = "each a : in S0 leads to in S1 within"
    model = modelled(f"{_PRELUDE}{_PAIR}{text}{_ONE}property P of S : {sentence} 10 min")
    (verdict,) = verdicts_of(model).values()

    assert model.doubts(model.groups())
    assert verdict.outcome == "fails"


def test_clocks_decide_whatever_the_values_are_that_were_not_tried(modelled: Modelled) -> None:
    compared = "state S1 {\n on Both [event.one < event.two] -> S0\n"
    text = _CALL.replace("state S1 {", compared)
    sentence = "each a : in S0 leads to in S1 within"
    whole = f"{_PRELUDE}{_PAIR}{text}{_ONE}property P of S : {sentence} 1 s"

    (verdict,) = verdicts_of(modelled(whole)).values()
    assert verdict.outcome == "unknown"
    assert verdict.reason.endswith("try `--time exact`")
    (verdict,) = verdicts_of(modelled(whole, exact=True)).values()
    assert (verdict.outcome, verdict.open) == ("holds", ("`Both.one`", "`Both.two`"))


def test_a_function_that_never_answers_is_late(modelled: Modelled) -> None:
    text = f"{_CALL}{_ONE}property P of S : each a : in S0 leads to in S1 within 1 min"
    scenario = Scenario(functions={(EVERY_FUNCTION, ""): {"never": 0.1}})

    assert _outcome(modelled, text, times=scenario, exact=True) == "fails"


@pytest.mark.parametrize(
    ("delay", "wanted", "answers", "silent"),
    [
        ("2 s", "in S0 leads to not in S0 within 2 s", "holds", "holds"),
        ("2 s", "in S0 leads to not in S0 within 1 s", "holds", "fails"),
        ("2 s", "never in Late", "holds", "fails"),
        ("500 ms", "never in S1", "holds", "holds"),
    ],
)
def test_a_function_that_may_never_answer_does_not_answer_early(
    delay: str, wanted: str, answers: str, silent: str, modelled: Modelled
) -> None:
    text = f"""endless statemachine M {{
  initial S0
  state S0 {{
    do attempt
    on succeeded, aborted -> S1
    after {delay} -> Late
  }}
  state S1 {{ on Go -> S0 }}
  state Late {{ on Go -> S0 }}
}}
{_ONE}property P of S : each a : {wanted}"""
    scenario = Scenario(functions={(EVERY_FUNCTION, ""): {"never": 0.1}})

    assert _outcome(modelled, text, exact=True) == answers
    assert _outcome(modelled, text, exact=True, silent=("attempt",)) == silent
    assert _outcome(modelled, text, exact=True, scenario=scenario) == silent


@pytest.mark.parametrize(
    ("latency", "within", "exact"),
    [
        (Fixed(0), "1 ms", "holds"),
        (Uniform(0, 200 * MILLISECOND), "200 ms", "holds"),
        (Uniform(0, 200 * MILLISECOND), "100 ms", "fails"),
        (Fixed(200 * MILLISECOND), "200 ms", "holds"),
    ],
)
def test_events_take_the_latency_of_a_scenario(
    latency: Length, within: str, exact: str, modelled: Modelled
) -> None:
    text = f"""endless statemachine M {{
  initial S0
  state S0 {{ on Go / send Ask -> S1 }}
  state S1 {{ on Tell -> S0 }}
}}
endless statemachine N {{
  initial S0
  state S0 {{ on Ask -> S1 }}
  state S1 {{ after 1 s / send Tell -> S0 }}
}}
{_TWO}property P of S : a sends Ask leads to b in S1 within {within}"""

    assert _outcome(modelled, text, times=Scenario(latency=latency), exact=True) == exact


def test_events_do_not_arrive_before_their_latency(modelled: Modelled) -> None:
    text = f"""endless statemachine M {{
  initial S0
  state S0 {{ after 1 s / send Ask -> S1 }}
  state S1 {{ on Go -> S1 }}
}}
endless statemachine N {{
  initial S0
  state S0 {{
    on Ask -> Heard
    after 1100 ms -> Missed
  }}
  state Heard {{ on Go -> Heard }}
  state Missed {{ on Go -> Missed }}
}}
{_TWO}property P of S : never b in Heard"""

    for milliseconds, expected in ((100, "fails"), (200, "holds")):
        scenario = Scenario(latency=Fixed(milliseconds * MILLISECOND))
        assert _outcome(modelled, text, times=scenario, exact=True) == expected


def test_deferred_events_are_heard_together_though_one_has_come_later(modelled: Modelled) -> None:
    text = f"""endless statemachine M {{
  initial S0
  state S0 {{ after 1 s / send Ask -> S1 }}
  state S1 {{ after 6 s / send Ask -> S2 }}
  state S2 {{ on Go -> S2 }}
}}
endless statemachine N {{
  initial S0
  state S0 {{
    defer Ask
    after 20 s -> S1
  }}
  state S1 {{ on Ask -> S2 }}
  state S2 {{
    on Ask -> Both
    after 2 s -> Missed
  }}
  state Both {{ on Go -> Both }}
  state Missed {{ on Go -> Missed }}
}}
{_TWO}"""
    scenario = Scenario(latency=Fixed(5 * SECOND))
    missed = f"{text}property P of S : never b in Missed"
    both = f"{text}property P of S : never b in Both"

    assert _outcome(modelled, missed, times=scenario, exact=True) == "holds"
    assert _outcome(modelled, both, times=scenario, exact=True) != "holds"


def test_each_deferred_event_is_a_step(modelled: Modelled) -> None:
    text = f"""statemachine M {{
  initial S0
  state S0 {{ after 1 s / send Ask -> S1 }}
  state S1 {{ on Tell / send Ask -> S2 }}
  state S2 {{ after 1 s -> End }}
  final End
}}
endless statemachine N {{
  initial S0
  state S0 {{
    defer Ask
    after 10 s / send Tell -> S1
  }}
  state S1 {{
    defer Ask
    after 20 s -> S2
  }}
  state S2 {{ on Ask -> S2 }}
}}
{_TWO}property P of S : never (a in S2 and not a sends Ask)"""

    (verdict,) = verdicts_of(modelled(_PRELUDE + text, exact=True)).values()

    assert verdict.outcome == "unknown"
    assert "defers several events of one name" in verdict.reason


@pytest.mark.parametrize(("delivery", "outcome"), [("", "holds"), ("{ deadline 1 s }", "unknown")])
def test_a_missed_deadline_is_a_step(delivery: str, outcome: str, modelled: Modelled) -> None:
    text = f"""swarm event Call : std_msgs/Empty {delivery}
statemachine M {{
  initial S0
  state S0 {{ after 1 s / send Call -> S1 }}
  state S1 {{ after 8 s -> End }}
  final End
}}
endless statemachine N {{
  initial S0
  state S0 {{ on Call -> S0 }}
}}
{_TWO}property P of S : never (a in S1 and not a sends Call and not b hears Call)"""

    assert _outcome(modelled, text) == outcome
    assert _outcome(modelled, text, exact=True) == outcome


def test_a_reliable_event_is_late_where_robots_may_be_out_of_reach(modelled: Modelled) -> None:
    text = f"""swarm event Call : std_msgs/Empty {{ reliable }}
endless statemachine M {{
  initial S0
  state S0 {{ after 1 s / send Call -> S1 }}
  state S1 {{ on Go -> S1 }}
}}
endless statemachine N {{
  initial S0
  state S0 {{ on Call -> S1 }}
  state S1 {{ on Go -> S1 }}
}}
{_TWO}property P of S : a sends Call leads to b in S1 within 1 s"""
    apart = Fault(at=Fixed(0), lasts=10 * SECOND, apart=(("a",), ("b",)))

    assert _outcome(modelled, text, exact=True) == "holds"
    assert _outcome(modelled, text, times=Scenario(faults=(apart,)), exact=True) == "fails"
    assert _outcome(modelled, text, lossy=True, exact=True) == "fails"


def test_a_race_is_decided_by_times(modelled: Modelled) -> None:
    text = f"""endless statemachine M {{
  initial S0
  state S0 {{
    do attempt
    on succeeded, aborted -> S1
    after 900 ms -> Early
    after 1100 ms -> Late
  }}
  state S1 {{ on Go -> S1 }}
  state Early {{ on Go -> S1 }}
  state Late {{ on Go -> S1 }}
}}
{_ONE}property Never of S : each a : never in S1
property Late of S : each a : never in Late
property Early of S : each a : never in Early
property Can of S : each a : always possible in Late"""
    model = modelled(_PRELUDE + text, exact=True)
    found = {name: each.outcome for name, each in verdicts_of(model).items()}

    assert found == {"Never": "fails", "Late": "holds", "Early": "fails", "Can": "fails"}


def test_what_is_possible_depends_on_times(modelled: Modelled) -> None:
    text = f"""endless statemachine M {{
  initial S0
  state S0 {{
    do attempt
    on succeeded, aborted -> S0
    after 2500 ms -> S1
  }}
  state S1 {{ after 1 s -> S1 }}
}}
{_ONE}property Can of S : each a : always possible in S1"""

    # Each call ends before the delay, which begins anew then.
    assert _outcome(modelled, text) == "unknown"
    assert _outcome(modelled, text, exact=True) == "fails"
    slow = Scenario(functions={(EVERY_FUNCTION, ""): {"duration": Fixed(3 * SECOND)}})
    assert _outcome(modelled, text, scenario=slow, exact=True) == "holds"
    varying = {"duration": Uniform(SECOND, 3 * SECOND)}
    unsure = Scenario(functions={(EVERY_FUNCTION, ""): varying})
    assert _outcome(modelled, text, scenario=unsure, exact=True) == "unknown"


def test_what_needs_no_time_holds_at_any_time(modelled: Modelled) -> None:
    text = f"""endless statemachine M {{
  initial S0
  state S0 {{ on Go / send Ask -> S1 }}
  state S1 {{
    do attempt
    on succeeded, aborted -> S0
  }}
}}
{_ONE}property P of S : each a : sends Ask leads to in S1 within 1 ms"""

    assert _outcome(modelled, text) == "holds"


@pytest.mark.parametrize("exact", [False, True])
def test_a_scope_that_ends_too_late_is_violated_at_its_end(
    modelled: Modelled, *, exact: bool
) -> None:
    text = f"{_DELAY}{_ONE}property P of S : each a : "
    sentence = "between in S0 and in S1, eventually hears Go within"

    # The run ends its part with `in S1`, 10 s after it began.
    assert _outcome(modelled, f"{text}{sentence} 4 s", exact=exact) == "fails"
    assert _outcome(modelled, f"{text}after in S1 until in S0, eventually in S0 within 1 s") != (
        "holds"
    )


def test_lengths_that_variables_have_count(modelled: Modelled) -> None:
    text = f"""endless statemachine M {{
  var wait : duration = 1 s
  initial S0
  state S0 {{
    after wait / wait = 3 s -> S1
  }}
  state S1 {{ on Go -> S0 }}
}}
{_ONE}property Once of S : each a : eventually in S1 within 1 s
property Again of S : each a : in S0 leads to in S1 within 2 s
property Longest of S : each a : in S0 leads to in S1 within 3 s"""
    model = modelled(_PRELUDE + text, exact=True)
    found = {name: each.outcome for name, each in verdicts_of(model).items()}

    assert found == {"Once": "holds", "Again": "fails", "Longest": "holds"}


def test_robots_without_clocks_are_told(modelled: Modelled) -> None:
    text = f"""endless statemachine M {{
  initial S0
  state S0 {{ on Ask -> S1 }}
  state S1 {{ after 5 s -> S0 }}
}}
endless statemachine N {{
  initial S0
  state S0 {{ after 7 s / send Ask -> S0 }}
}}
{_TWO}property P of S : a in S1 leads to a in S0 within 5 s
property Q of S : a in S0 leads to a in S1 within 7 s"""
    found = verdicts_of(modelled(_PRELUDE + text, exact=True))

    assert found["P"].outcome == found["Q"].outcome == "holds"
    assert found["P"].reason == "with clocks of a, others take any time"
    assert not found["Q"].reason


def test_a_search_that_is_too_long_tells_what_to_round(modelled: Modelled) -> None:
    text = """endless statemachine M {
  initial S0
  state S0 { after 10 s -> S1 }
  state S1 { after 333 ms -> S0 }
}
member A { behavior M }
swarm S { a : A[2] }
property P of S : all a in S0 leads to some a in S1 within 1 min"""
    (verdict,) = verdicts_of(modelled(_PRELUDE + text, exact=True), 2_000).values()

    assert verdict.outcome == "up to"
    assert verdict.reason.endswith("clocks have ticks of 1 ms: round 333 ms to 10 s for 10 s")


# ---- runs


def _written(folder: Path) -> dict[str, Path]:
    return {path.stem: path for path in folder.glob("P*.jsonl")}


@pytest.mark.parametrize("seed", range(8))
def test_runs_with_times_are_those_of_the_model(
    seed: int, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    model = tmp_path / "random.swarm"
    model.write_text(random_timed_swarm(seed), encoding="utf-8")
    results = tmp_path / "results.json"
    arguments = ["--time", "exact", "-o", str(tmp_path), "--results", str(results)]
    run(["verify", str(model), *arguments])
    verdicts = json.loads(results.read_text(encoding="utf-8"))["properties"]
    failed = {each["name"] for each in verdicts if each["verdict"] == "fails"}
    runs = _written(tmp_path)
    capsys.readouterr()

    assert set(runs) == failed
    for name, path in runs.items():
        assert run(["simulate", str(model), "--replay", str(path), "--property", name]) == 1
        told = capsys.readouterr().err
        assert "as in the model" in told
        assert f"SW1606]: property `{name}`" in told


@pytest.mark.parametrize("seed", range(12))
def test_no_simulation_violates_what_holds(seed: int, tmp_path: Path) -> None:
    path = tmp_path / "random.swarm"
    path.write_text(random_timed_swarm(seed), encoding="utf-8")
    length = Uniform(SECOND, 2 * SECOND)
    aborts = {"duration": length, "aborted": 0.3}
    scenario = Scenario(functions={(EVERY_FUNCTION, ""): aborts}, latency=Uniform(0, SECOND))
    model = model_of(path, None, Options(5, times=scenario, exact=True))
    holds = {name for name, each in verdicts_of(model).items() if each.outcome == "holds"}
    ignoring = model_of(path, None, Options(5, times=scenario))
    holds |= {name for name, each in verdicts_of(ignoring).items() if each.outcome == "holds"}

    violated = {name for chance in range(60) for name in _violated(model, scenario, chance)}
    assert not holds & violated


def _violated(model: Model, scenario: Scenario, seed: int) -> set[str]:
    """Return the properties that a random run violates."""
    subject = model.subject
    cast = actors(subject, subject.create_robots({}), scenario, Diagnostics())
    chance = Random(seed)
    hearing = [actor for actor in cast if actor.listens("Go")]
    inputs = [
        Input("Go", chance.randrange(4000) * MILLISECOND, {}, (chance.choice(hearing),))
        for _ in range(10 if hearing else 0)
    ]
    world = World(model.system, cast, scenario, seed, [lambda line: monitors.see(line)])
    monitors = watch(plan(watchable(subject)), world.data)
    ending = simulate(world, inputs, 60 * SECOND)
    results = monitors.results(world.clock.now, ended=ending == "ended")
    return {each.property.name for each in results if each.verdict == FALSE}


def test_saved_tests_wait_as_the_run_does(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    model, saved = tmp_path / "model.swarm", tmp_path / "new.swarmtest.toml"
    text = f"{_PRELUDE}{_DELAY}{_ONE}property P of S : each a : in S0 leads to in S1 within 9 s"
    model.write_text(text, encoding="utf-8")

    assert run(["verify", str(model), "--time", "exact", "--save-test", str(saved)]) == 1
    assert '{ pass = "10 s" }' in saved.read_text(encoding="utf-8")
    capsys.readouterr()
    assert run(["test", str(saved)]) == 1
    assert "property `P` is violated by `a[0]` at 9 s" in capsys.readouterr().out
    model.write_text(text.replace("after 10 s", "after 8 s"), encoding="utf-8")
    assert run(["test", str(saved)]) == 0


GROWING = """package test
swarm event Bid  : std_msgs/Float64
swarm event Sold : std_msgs/Empty
struct Offer {
  way : float64
  id  : string
}
endless statemachine Buy {
  var offers : Offer[<=8]
  var best   : Offer
  initial Wait
  state Wait {
    on Bid [len(offers) < 8] / append Offer(way = event.data, id = event.sender) to offers
    after 2 s -> Choose
  }
  choice Choose {
    [len(offers) > 0] / best = min(o in offers by o.way), send Sold to best.id -> Done
    else -> Wait
  }
  state Done { on Bid -> Done }
}
endless statemachine Sell {
  initial Idle
  state Idle { after 1 s / send Bid(data = 1.5) -> Sent }
  state Sent { on Sold -> Glad }
  state Glad { after 7 s -> Glad }
}
member Buyer { behavior Buy }
member Seller { behavior Sell }
swarm Market {
  buyer  : Buyer
  seller : Seller[3]
}
property Sells of Market : buyer in Wait leads to some seller in Glad within 2 s
property Early of Market : buyer in Wait leads to some seller in Glad within 1 s
property Two   of Market : never count(seller in Glad) > 1
"""


def test_a_robot_with_too_many_states_has_few_when_time_counts(
    modelled: Callable[..., Model], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("swarmdsl.execution.verify.swarm.model.MOST_STATES", 60)
    told = {}
    for exact in (False, True):
        model = modelled(GROWING, exact=exact, capacity=3)
        # It could hear as many offers as it can keep, of each seller at any time.
        assert not model.complete
        told[exact] = {name: each.outcome for name, each in verdicts_of(model).items()}

    assert told[False] == {"Sells": "unknown", "Early": "fails", "Two": "up to"}
    assert told[True] == {"Sells": "holds", "Early": "fails", "Two": "holds"}

    # After a limit, states with few messages on their way are looked at first.
    times = Scenario(latency=Fixed(SECOND))
    model = modelled(GROWING, exact=True, capacity=3, times=times)
    assert verdicts_of(model, 30)["Sells"].outcome in ("fails", "up to")


def test_delays_that_depend_on_data_have_no_clock_in_a_robot_with_too_many_states(
    modelled: Callable[..., Model], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("swarmdsl.execution.verify.swarm.model.MOST_STATES", 60)
    text = GROWING.replace("var best ", "var rest : duration = 2 s\n  var best ")
    model = modelled(text.replace("after 2 s", "after rest"), exact=True)

    verdict = verdicts_of(model)["Sells"]

    assert verdict.outcome == "unknown"
    assert "a `buyer` has too many states" in verdict.reason
