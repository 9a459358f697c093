"""Verdicts on random swarms are those of all runs on the engine."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from itertools import product
from pathlib import Path

import pytest

from swarmdsl.execution.verify.robot.environment import Options

from .conftest import at_least, model_of, system_of, verdicts_of
from .random_swarms import random_swarm
from .slow import refuted
from .slow_lassos import LIVE

MOST = 45
"""Number of states up to which the slow explorer plays all runs from their beginning."""
# Seeds of swarms that have no more states.
FEW = (0, 2, 3, 6, 15, 17, 19, 20, 22, 24, 26, 30, 33, 34, 42, 46, 48, 56, 69, 70)


# A swarm in which some events change no fact.
_CALM = """package test
event Go : std_msgs/Empty
event Tick : std_msgs/Empty
swarm event Ask : std_msgs/Empty
endless statemachine M {
  initial S0
  state S0 { on Go / send Ask -> S1 }
  state S1 {
    on Tick -> S1
    on Go -> S2
  }
  state S2 {
    on Tick -> S2
    on Ask -> S2
  }
}
member A { behavior M }
swarm S { a : A[1] }
"""
_MOMENTS = ("hears Go", "hears Ask", "sends Ask", "Go")
_LASTING = ("in S0", "in S1", "in S2")
_ABOUT = (
    *("({m} or {l}) at all times", "after {m}, ({m} or {l}) at all times"),
    *("never ({l} and not {m})", "after {m}, never ({l} and not {m})", "{l} only after {m}"),
)


def test_sentences_about_moments_are_as_in_all_runs(tmp_path: Path) -> None:
    path = tmp_path / "calm.swarm"
    found: Counter[str] = Counter()
    for moment, lasting, sentence in product(_MOMENTS, _LASTING, _ABOUT):
        text = sentence.format(m=moment, l=lasting)
        model = f"{_CALM}property P of S : each a : {text}\n"
        found += verdicts_as_in_all_runs(model, path)

    assert found.total() == len(_MOMENTS) * len(_LASTING) * len(_ABOUT)
    assert min(found["holds"], found["fails"]) > 5


def compare(seed: int, path: Path) -> Counter[str]:
    """Compare the verdicts on a random swarm."""
    return verdicts_as_in_all_runs(random_swarm(seed), path, lossy=seed % 3 == 0)


def verdicts_as_in_all_runs(
    text: str, path: Path, *, lossy: bool = False, faults: int = 0, most: int = MOST
) -> Counter[str]:
    """Compare the verdicts on a model; return how many of each kind there are.

    Return none if it has too many states.
    """
    path.write_text(text, encoding="utf-8")
    model = model_of(path, None, Options(1, lossy, faults))
    outside = list(model.outside)
    wanted = refuted(system_of(path), outside, 1, most, lossy=lossy, faults=faults)
    found: Counter[str] = Counter()
    if wanted is None:
        return found
    for name, verdict in verdicts_of(model, 5_000).items():
        found[verdict.outcome] += 1
        # A run that goes on for ever may violate it, which is not looked at here.
        owed = verdict.property.kind in LIVE
        match verdict.outcome:
            case "holds":
                assert name not in wanted, verdict
            case "fails":
                assert name in wanted or owed, verdict
            case "unknown" if "only some values" in verdict.reason:
                # What comes from outside is compared with a variable.
                assert name not in wanted, verdict
            case "unknown" if "counts" not in verdict.reason:
                # Some run violates it, but for times or an order of messages that cannot be.
                assert (name in wanted or owed) == ("is impossible" in verdict.reason), verdict
    return found


@pytest.mark.timeout(3000)
def test_verdicts_are_those_of_all_runs(seeds: Sequence[int], tmp_path: Path) -> None:
    found: Counter[str] = Counter()
    for seed in seeds:
        found += compare(seed, tmp_path / "random.swarm")

    assert min(found["holds"], found["fails"]) >= at_least(21, seeds)
    assert seeds is not FEW or found.total() == 6 * len(FEW)
