"""Proofs about robots that count others nearby: any number of them may be there."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

import pytest

from swarmdsl.cli import run
from swarmdsl.execution.verify.any_size.prove import prove_any
from swarmdsl.execution.verify.automata.limits import Budget, Limits
from swarmdsl.execution.verify.findings.findings import survey
from swarmdsl.execution.verify.proofs.prove import prove
from swarmdsl.execution.verify.robot.choices import Nearness
from swarmdsl.execution.verify.swarm.model import Model

from .conftest import verdicts_of

MODEL = """
package near

event Go : std_msgs/Empty
swarm event Met : std_msgs/Empty

endless statemachine Fly {
  param reach : float64 in m = 5 m
  var count : int32 = 0
  initial Alone
  state Alone { @ALONE@ }
  state Close { @CLOSE@ }
  choice Check {
    [count > 2] -> Lost
    else -> Alone
  }
  state Lost { on Go -> Alone }
}
member Bird { behavior Fly }
swarm Flock { bird : Bird[@SIZE@] }
property Safe     of Flock : each bird : never in Lost
property Calm     of Flock : never some bird in Lost
property Possible of Flock : each bird : always possible in Alone
property Goes     of Flock : each bird : in Close leads to in Alone
"""
Modelled = Callable[..., Model]
NEVER = "on Go [neighbors within 5 m < 0] -> Lost"
CLOSER = "on Go [neighbors within reach > 0 and neighbors within (2 * reach) == 0] -> Lost"
FURTHER = "on Go [neighbors within reach == 0 and neighbors within (2 * reach) > 0] -> Lost"


def of(modelled: Modelled, alone: str, close: str = "on Go -> Alone", size: int = 3) -> Model:
    text = MODEL.replace("@ALONE@", alone).replace("@CLOSE@", close)
    return modelled(text.replace("@SIZE@", str(size)))


@pytest.mark.parametrize(
    ("alone", "size", "safe"),
    [
        ("on Go [neighbors within reach >= 3] -> Lost", 3, True),
        ("on Go [neighbors within reach >= 3] -> Lost", 4, False),
        ("on Go / count = neighbors within reach -> Check", 3, True),
        ("on Go / count = neighbors within reach -> Check", 4, False),
        # A message of another robot is a moment, too.
        ("after 1 s / send Met -> Alone; on Met [neighbors within reach > 1] -> Lost", 2, True),
        ("after 1 s / send Met -> Alone; on Met [neighbors within reach > 1] -> Lost", 3, False),
        (NEVER, 4, True),
        (CLOSER, 4, True),
        (FURTHER, 4, False),
    ],
)
def test_any_number_of_others_may_be_near(
    alone: str, size: int, safe: bool, modelled: Modelled
) -> None:
    model = of(modelled, alone, size=size)
    verdicts = verdicts_of(model)

    for name in ("Safe", "Calm"):
        verdict = verdicts[name]
        assert verdict.outcome == ("holds" if safe else "unknown")
        assert safe or "depends on their places" in verdict.reason
    found = survey(model, Budget(Limits())).findings
    # A robot waits in `Alone` for ever, or never gets into `Lost`.
    names = {each.name for each in found if each.fault in ("waits", "unreachable")}
    assert bool(names & {"Alone", "Lost"}) == safe


def test_a_run_in_which_nobody_is_near_is_a_violation(modelled: Modelled) -> None:
    # With others nearby, it takes one step less.
    model = of(
        modelled,
        "on Go [neighbors within reach > 0] -> Lost; on Go -> Close",
        "on Go [neighbors within reach == 0] -> Lost",
    )
    verdicts = verdicts_of(model)

    assert verdicts["Safe"].outcome == verdicts["Calm"].outcome == "fails"
    assert verdicts["Goes"].outcome == "fails"
    assert verdicts["Calm"].run is not None
    assert [line.event for line in verdicts["Calm"].run.lines if line.event] == ["Go", "Go"]


def test_a_fault_is_shown_by_a_run_in_which_nobody_is_near_or_told_to_be_open(
    modelled: Modelled,
) -> None:
    fails = "/ count = 1 % count -> Alone"
    far = f"on Go [neighbors within reach == 0] {fails}"
    for close, is_open in ((far, False), ("on Go -> Alone", True)):
        near = f"on Go [neighbors within reach > 0] {fails}; on Go -> Close"
        found = survey(of(modelled, near, close), Budget(Limits()))
        failed = [each for each in found.findings if each.fault == "fails"]
        assert [each.fault for each, _ in found.open] == ["fails"] * is_open
        assert len(failed) == (not is_open)
        for each in failed:
            assert each.run is not None
            assert [line.event for line in each.run.lines if line.event] == ["Go", "Go"]


def test_an_open_fault_is_told_once(modelled: Modelled) -> None:
    """A robot may wait with several values, and nothing may happen any more then."""
    near = "on {} [neighbors within reach > 0] / count = {} -> Close"
    alone = f"{near.format('Go', 1)}; {near.format('Met', 2)}"
    text = MODEL.replace("@ALONE@", alone).replace("@CLOSE@", "on Go [count > 2] -> Alone")
    text += "property One of Flock : each bird : never has [count == 1] and in Lost\n"

    found = survey(modelled(text.replace("@SIZE@", "2")), Budget(Limits()))

    assert [(each.fault, each.name) for each, _ in found.open] == [("waits", "Close")]


def test_what_is_possible_only_with_others_nearby_is_open(modelled: Modelled) -> None:
    model = of(modelled, "on Go -> Close", "on Go [neighbors within reach > 0] -> Alone")

    verdict = verdicts_of(model)["Possible"]

    assert verdict.outcome == "unknown"
    assert "who is near" in verdict.reason


def test_what_must_happen_does_so_whoever_is_near(modelled: Modelled) -> None:
    asks = "after 1 s [neighbors within reach > 0] -> Alone; after 1 s -> Alone"
    waits = "after 1 s [neighbors within reach > 0] -> Alone; after 2 s -> Close"

    assert verdicts_of(of(modelled, "on Go -> Close", asks))["Goes"].outcome == "holds"
    assert verdicts_of(of(modelled, "on Go -> Close", waits))["Goes"].outcome == "fails"


def test_the_start_and_a_machine_alone_are_open(
    modelled: Modelled, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    asks = "entry / count = neighbors within reach; on Go -> Check"
    verdict = verdicts_of(of(modelled, asks))["Safe"]
    assert (verdict.outcome, "when the robots start" in verdict.reason) == ("unknown", True)

    text = MODEL.replace("@ALONE@", FURTHER).replace("@CLOSE@", "on Go -> Alone")
    path = tmp_path / "alone.swarm"
    path.write_text(text.replace("@SIZE@", "1") + "property Never of Fly : never in Lost\n")
    run(["verify", str(path), "--machine", "Fly"])
    assert re.search("Never +unknown +without a swarm", capsys.readouterr().out)


def test_more_robots_may_be_nearer_than_few(modelled: Modelled) -> None:
    model = of(modelled, NEVER)
    safe = next(each for each in model.system.properties if each.name == "Safe")

    budget = Budget(Limits())
    verdict = prove_any(
        safe, model, {"bird": (3, None)}, budget, lambda _: prove(safe, model, budget)
    )

    assert verdict.outcome == "unknown"
    assert "how many robots are near" in verdict.reason


def test_all_answers_are_tried_once_and_grow_with_the_distance() -> None:
    nearness = Nearness(2)
    todo: list[tuple[int, ...]] = [()]
    seen = []
    while todo:
        nearness.choose(todo.pop(0))
        seen.append((nearness.count(5), nearness.count(9), nearness.count(5), nearness.count(7)))
        todo += nearness.others()

    expected = [(a, b, a, c) for a in range(3) for b in range(a, 3) for c in range(a, b + 1)]
    assert sorted(seen) == expected
