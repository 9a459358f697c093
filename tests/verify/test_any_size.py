"""Verdicts for every number of robots are never stronger than those for some numbers."""

from __future__ import annotations

import json
import re
import signal
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.cli import run
from swarmdsl.execution.simulate.evaluation.properties import watchable
from swarmdsl.execution.simulate.machines.subject import Subject
from swarmdsl.execution.verify.any_size import prove as any_size
from swarmdsl.execution.verify.any_size.coverability import Cover
from swarmdsl.execution.verify.any_size.prove import enough, prove_any
from swarmdsl.execution.verify.automata.limits import Budget, Limits
from swarmdsl.execution.verify.proofs.prove import prove
from swarmdsl.execution.verify.proofs.verdict import Verdict
from swarmdsl.execution.verify.robot.environment import Options
from swarmdsl.execution.verify.swarm import model as models
from swarmdsl.execution.verify.swarm.model import Model
from swarmdsl.ir import Property

from .conftest import at_least, system_of
from .random_swarms import random_swarm

_PRELUDE = """package test
swarm event Ask   : std_msgs/Empty
swarm event Grant : std_msgs/Empty
swarm event Done  : std_msgs/Empty
event Ready : std_msgs/Empty
function dock : abstraction { service "dock" : std_srvs/Empty }
"""
_DRONE = """
endless statemachine Charge {
  initial Fly
  state Fly { on Ready / send Ask to tower -> Wait }
  state Wait { on Grant -> Dock }
  state Dock {
    do dock
    on succeeded, aborted / send Done to tower -> Fly
  }
}
member Drone { behavior Charge }
"""
_TOWER = """
endless statemachine Watch {
  initial Free
  state Free { on Ask / send Grant -> Busy }
  state Busy { on Done -> Free }
}
member Tower { behavior Watch }
"""
FIELD = f"{_PRELUDE}{_DRONE}{_TOWER}swarm Field {{ drone : Drone[1..*]\n tower : Tower }}\n"

# Sentences with the verdict, its reason and the numbers of robots of a violation.
SENTENCES = {
    "never count(drone in Dock) > 2": ("fails", "it takes 3 drone"),
    "count(drone in Dock) <= 1 at all times": ("fails", "it takes 2 drone"),
    "never 4..* drone in Dock": ("fails", "it takes 4 drone"),
    "never count(drone in Dock) > 0 and tower in Free": ("fails", "it takes 2 drone"),
    "never tower in Free and some drone starts dock": ("fails", "it takes 2 drone"),
    "never some drone starts dock and some drone hears Ready": ("holds", "for 1 or more drone"),
    "some drone in Dock only after some drone sends Ask": ("holds", "for 1 or more drone"),
    "some drone in Dock only after tower in Busy": ("holds", "for 1 or more drone"),
    "2..* drone in Dock only after tower hears Done": ("fails", "it takes 2 drone"),
    "each drone : in Dock only after hears Grant": ("holds", "for 1 or more drone"),
    "each drone : in Dock only after sends Ask": ("holds", "for 1 or more drone"),
    "each drone : in Dock only after hears Ready": ("holds", "for 1 or more drone"),
    "each drone : never in Dock and some other drone in Dock": ("fails", "it takes 2 drone"),
    "each drone : after sends Ask, never in Fly": ("fails", "it takes 1 drone"),
    "each drone : never (in Dock and not in Dock)": ("holds", "for 1 or more drone"),
    "each drone : before hears Grant, never in Dock": ("holds", "for 1 or more drone"),
    "tower in Free at all times": ("fails", "it takes 1 drone"),
    "never (count(drone in Fly) > 1 or tower in Busy)": ("fails", "it takes 1 drone"),
    "never all drone in Dock": ("fails", "of 1 drone"),
    "never (all drone in Dock and tower in Free)": ("unknown", "more of `drone` can end"),
    "never tower in Free and not some drone in Fly": ("fails", "of 1 drone"),
    "all drone in Fly at all times": ("fails", "it takes 1 drone"),
    "after tower in Busy, never count(drone in Dock) > 1": ("unknown", "a part of each run"),
    "count(drone in Dock) > 1 at most 3 times": ("unknown", "it counts what happens"),
    "each drone : always possible in Fly": ("fails", "of 1 drone"),
    "eventually some drone in Fly": ("unknown", "what must happen; it holds for 1 drone"),
    "each drone : always possible in Fly or in Wait or in Dock": (
        *("unknown", "it is about what is possible; it holds for 1 drone"),
    ),
    "each drone : in Wait leads to in Dock within 5 s": ("fails", ""),
    # What it does at once it does whatever the others do.
    "each drone : sends Ask leads to in Wait within 5 s": ("holds", "for 1 or more drone"),
    "each drone : hears Ready leads to in Wait or in Dock": ("holds", "for 1 or more drone"),
    "never count(drone in Dock) > 200": ("unknown", "more than 100 robots"),
    "drone[0] in Dock only after drone[0] hears Grant": ("holds", "for 1 or more drone"),
}


def sized(text: str, path: Path) -> tuple[list[Property], Callable[[Mapping[str, int]], Model]]:
    """Return the properties of a model, and its automata for numbers of robots."""
    path.write_text(text, encoding="utf-8")
    system = system_of(path)
    subject = Subject(system.swarms[0].name, system, system.swarms[0])
    made: dict[str, Model] = {}

    def model(counts: Mapping[str, int]) -> Model:
        key = repr(sorted(counts.items()))
        if key not in made:
            report = Diagnostics()
            budget = Budget(Limits())
            made[key] = Model(subject, counts, watchable(subject), Options(), budget, report)
            assert not report.has_errors
        return made[key]

    return list(watchable(subject)), model


def for_every_number(
    property_: Property,
    role: str,
    model: Callable[[Mapping[str, int]], Model],
    least: int = 1,
    most: int | None = None,
) -> Verdict:
    """Prove a property for every number of robots of a role."""
    bounds = {role: (least, most)}
    return prove_any(
        property_,
        model(enough(bounds)),
        bounds,
        Budget(Limits()),
        lambda counts: prove(property_, model(counts), Budget(Limits(states=20_000))),
    )


def test_verdicts_with_their_reasons(tmp_path: Path) -> None:
    text = FIELD + "".join(
        f"property P{number} of Field : {sentence}\n" for number, sentence in enumerate(SENTENCES)
    )
    properties, model = sized(text, tmp_path / "field.swarm")

    for property_, (sentence, (outcome, reason)) in zip(properties, SENTENCES.items(), strict=True):
        verdict = for_every_number(property_, "drone", model)
        assert (verdict.outcome, reason in verdict.reason) == (outcome, True), (sentence, verdict)
        if outcome == "fails":
            assert verdict.run is not None
            numbers = {line.actor.robot.name for line in verdict.run.lines}
            assert verdict.size == {"drone": sum("drone" in (name or "") for name in numbers)}


_MEASURE = """package test
message Length { metres : float64 }
event Measure : Length
event Tick : std_msgs/Empty
swarm event Ask : Length
endless statemachine M {
  initial S0
  state S0 { on Tick / send Ask(metres = 2.0) -> S0 }
}
endless statemachine N {
  initial S0
  state S0 {
    on Measure -> S0
    on Ask -> S0
  }
}
member A { behavior M }
member B { behavior N }
swarm S { a : A[1..*]; b : B }
"""


@pytest.mark.parametrize(
    ("sentence", "outcome"),
    [
        # It arrives at `b`: both facts can be true at this moment.
        ("each a : never (Measure [event.metres > 5] and Measure)", "fails"),
        ("each a : never (Measure [event.metres > 5] and not Measure)", "holds"),
        ("never some a sends Ask [event.metres > 2]", "holds"),
        ("never (2..* a sends Ask [event.metres > 1] or b hears Ask [event.metres < 2])", "holds"),
        ("never b hears Ask [event.metres > 1]", "fails"),
    ],
)
def test_conditions_on_messages(sentence: str, outcome: str, tmp_path: Path) -> None:
    (property_,), model = sized(f"{_MEASURE}property P of S : {sentence}\n", tmp_path / "m.swarm")
    assert for_every_number(property_, "a", model).outcome == outcome


def test_robots_of_larger_swarms_are_told(tmp_path: Path) -> None:
    text = FIELD + "property P of Field : never drone[3] in Dock\n"
    (property_,), model = sized(text, tmp_path / "field.swarm")

    verdict = for_every_number(property_, "drone", model)

    assert "`drone[3]` is there in larger swarms only" in verdict.reason
    assert for_every_number(property_, "drone", model, 4).outcome == "fails"


def test_numbers_end_at_the_multiplicity(tmp_path: Path) -> None:
    text = FIELD + "property P of Field : never count(drone in Dock) > 2\n"
    (property_,), model = sized(text, tmp_path / "field.swarm")

    assert for_every_number(property_, "drone", model, 1, 2).reason.startswith("for 1 to 2 drone,")
    assert for_every_number(property_, "drone", model, 1, 3).outcome == "fails"
    assert for_every_number(property_, "drone", model, 5).reason == "it takes 5 drone"


def test_of_a_role_without_a_fixed_number_some_may_be_missing(tmp_path: Path) -> None:
    # A greatest number of robots does not tell how many are there.
    busy = "some drone in Wait or some drone in Dock"
    text = FIELD + f"property P of Field : {busy} or 2..* drone in Fly at all times\n"
    (property_,), model = sized(text, tmp_path / "field.swarm")

    assert for_every_number(property_, "drone", model, 1, 3).reason == "of 1 drone"
    assert "more of `drone` can end" in for_every_number(property_, "drone", model, 2, 3).reason
    assert for_every_number(property_, "drone", model, 3, 3).outcome == "holds"


def test_a_property_of_robots_that_are_not_there_holds(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / "field.swarm"
    text = FIELD.replace("tower : Tower", "tower : Tower[*]")
    path.write_text(f"{text}property P of Field : each tower : never in Busy\n", encoding="utf-8")

    assert run(["verify", str(path), "--size", "drone=any", "--size", "tower=0"]) == 0
    assert "P  holds  there is no `tower`" in capsys.readouterr().out


def test_numbers_begin_with_one(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    # Without drones, `Ask` would come from outside.
    path = tmp_path / "field.swarm"
    text = FIELD.replace("Drone[1..*]", "Drone[*]")
    text += "property P of Field : tower in Busy only after some drone sends Ask\n"
    path.write_text(text, encoding="utf-8")

    run(["verify", str(path), "--size", "drone=any", "--property", "P"])
    assert "P  holds  for 1 or more drone, " in capsys.readouterr().out


_OTHER_ROBOTS = {
    "robots are told apart": ("Drone[1..*]", "on Ready", "on Ready [self.index == 0]"),
    "the behavior depends on the number of `drone`": (
        *("Drone[1..*]", "on Ready", "on Ready [self.count > 3]"),
    ),
    "robots of `drone` differ in their params": (
        *("Drone[1..*]; drone[0] { high = true }", "on Ready", "on Ready [high]"),
    ),
}


@pytest.mark.parametrize("reason", _OTHER_ROBOTS)
def test_robots_that_differ_by_size_are_told(reason: str, tmp_path: Path) -> None:
    role, old, new = _OTHER_ROBOTS[reason]
    text = FIELD.replace(old, new).replace("Drone[1..*]", role)
    text = text.replace("Charge {\n", "Charge {\n  param high : bool = false\n")
    text = text.replace("behavior Charge", "behavior Charge\n param high : bool = false\n")
    text += "property P of Field : never count(drone in Wait) > 4\n"
    # What a robot does in the same step is in time, whatever the number.
    text += "property Q of Field : each drone : in Wait leads to in Wait within 1 s\n"
    properties, model = sized(text, tmp_path / "field.swarm")

    for property_ in properties:
        verdict = for_every_number(property_, "drone", model)
        assert verdict.outcome == "unknown"
        assert reason in verdict.reason
        assert (verdict.place is not None) == ("apart" not in reason)


# ---- random swarms

_ABOUT = (
    "never count(a in S1) > 1",
    "never count(a in S2) > 2",
    "never some a in S1 and some a in S2",
    "count(a in S0) <= 2 at all times",
    "some a in S2 only after some a hears Tell",
    "2..* a in S1 only after some a sends Ask",
    "each a : never in S2 and some other a in S2",
    "each a : in S2 only after hears Ask",
    "each a : after sends Tell, never in S1",
    "each a : never (in S1 and not in S1) and some other a hears Tell",
    "never some a starts attempt and some a in S2",
    "each a : between in S0 and in S1, sends Ask at most 1 times",
)
# Seeds of swarms of which a robot has few states.
FEW = (0, 1, 2, 3, 4)
MOST = 4


def compare(seed: int, path: Path) -> Counter[str]:
    """Compare the verdicts for every number with those for 1 to 4 robots.

    Return none if a robot has too many states.
    """
    machine, _, _ = random_swarm(seed).partition("member A")
    machine = machine.partition("statemachine Two")[0]
    text = f"{machine}member A {{ behavior One }}\nswarm S {{ a : A[1..*] }}\n"
    text += "".join(f"property P{n} of S : {about}\n" for n, about in enumerate(_ABOUT))
    properties, model = sized(text, path)
    found: Counter[str] = Counter()
    if not model({"a": MOST}).complete:
        return found
    for property_ in properties:
        verdict = for_every_number(property_, "a", model)
        outcomes = {
            number: prove(property_, model({"a": number}), Budget(Limits(states=3_000))).outcome
            for number in range(1, MOST + 1)
        }
        found[verdict.outcome] += 1
        about = (seed, property_.name, verdict.reason, outcomes)
        up_to_most = for_every_number(property_, "a", model, 1, MOST).outcome
        if "holds" in (verdict.outcome, up_to_most):
            assert "fails" not in outcomes.values(), about
        if verdict.outcome == "fails":
            assert verdict.size is not None
            least = verdict.size["a"]
            assert all(outcomes[n] != "fails" for n in outcomes if n < least), about
            assert outcomes.get(least, "fails") in ("fails", "up to"), about
    return found


@pytest.fixture
def small(monkeypatch: pytest.MonkeyPatch) -> None:
    """Look at robots with few states only."""
    monkeypatch.setattr(models, "MOST_STATES", 30)
    monkeypatch.setattr(models, "MOST_MOVES", 300)


@pytest.mark.usefixtures("small")
@pytest.mark.timeout(3000)
def test_verdicts_are_those_of_all_sizes(seeds: Sequence[int], tmp_path: Path) -> None:
    found: Counter[str] = Counter()
    for seed in seeds:
        found += compare(seed, tmp_path / "random.swarm")

    assert seeds is not FEW or found.total() == len(_ABOUT) * len(FEW)
    assert min(found["holds"], found["fails"]) >= at_least(6, seeds)


# ---- the command


@pytest.fixture
def field(tmp_path: Path) -> Path:
    """Return a model with properties that fail and hold."""
    path = tmp_path / "field.swarm"
    text = "property Two of Field : never count(drone in Dock) > 1\n"
    text += "property Granted of Field : each drone : in Dock only after hears Grant\n"
    path.write_text(FIELD + text, encoding="utf-8")
    return path


def test_a_violation_is_shown_with_its_robots(
    field: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    runs = tmp_path / "runs"

    assert run(["verify", str(field), "--size", "drone=any", "-o", str(runs)]) == 1
    out = capsys.readouterr().out
    assert out.startswith("Field: any number of drone, 1 tower\n  of 1 drone, 1 tower:\n")
    assert "\n  Two      fails  it takes 2 drone\n" in out
    assert "\n  Granted  holds  for 1 or more drone, " in out
    assert "a shortest run, of 2 drone, 1 tower:" in out
    scenario = tmp_path / "two.toml"
    scenario.write_text("[count]\ndrone = 2\n", encoding="utf-8")
    replay = ["--replay", str(runs / "Two.jsonl"), "--scenario", str(scenario)]
    run(["simulate", str(field), *replay])
    told = capsys.readouterr().err
    assert "as in the model" in told
    assert "Two       false" in told


def test_a_number_that_is_fixed_is_told(field: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["verify", str(field), "--size", "tower=any"]) == 1
    out = capsys.readouterr().out
    assert "error[SW1709]: this swarm cannot have any number of `tower`" in out
    assert "`Tower[2..8]`" in out


@pytest.mark.parametrize("size", ["=any", "drone=any=any", "drone=any..3", "drone=ANY"])
def test_what_is_no_size_is_told(
    size: str, field: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["verify", str(field), "--size", size]) == 2
    assert f"`{size}` is not a size like" in capsys.readouterr().err


def test_a_limit_ends_the_search(field: Path, capsys: pytest.CaptureFixture[str]) -> None:
    limits = ["--limit", "1", "--property", "Two"]
    assert run(["verify", str(field), "--size", "drone=any", *limits]) == 0
    assert "Two  unknown  the search came to its limit of states" in capsys.readouterr().out


def test_ctrl_c_ends_the_search(
    field: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def interrupted(*_: object) -> Cover:
        signal.raise_signal(signal.SIGINT)
        return Cover(None, 0, complete=False)

    monkeypatch.setattr(any_size, "cover", interrupted)

    assert run(["verify", str(field), "--size", "drone=any"]) == 130


def test_sizes_after_a_violation_are_looked_at(
    field: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    results = tmp_path / "results.json"
    options = ["--size", "drone=2..3", "--results", str(results)]
    assert run(["verify", str(field), *options]) == 1
    out = capsys.readouterr().out
    assert out.startswith("Field: 2 to 3 drone, 1 tower\n  2 drone, 1 tower: ")
    assert re.search(r"Two +fails +of 2 drone, 1 tower\n", out)
    sizes = {
        each["name"]: each.get("size") for each in json.loads(results.read_text())["properties"]
    }
    assert sizes["Two"] == {"drone": 2, "tower": 1}
    assert sizes["Granted"] is None


def test_results_and_tests_have_the_robots_of_a_violation(
    field: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    results, saved = tmp_path / "results.json", tmp_path / "two.swarmtest.toml"
    files = ["--results", str(results), "--save-test", str(saved)]

    assert run(["verify", str(field), "--size", "drone=any", *files]) == 1
    found = json.loads(results.read_text(encoding="utf-8"))
    assert found["any"] == ["drone"]
    assert [each.get("size") for each in found["properties"]] == [{"drone": 2}, None]
    assert run(["test", str(saved)]) == 1
    assert "`Two`" in capsys.readouterr().out
