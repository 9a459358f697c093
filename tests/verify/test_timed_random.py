"""Verdicts on random swarms with times are those of all runs on the engine, second by second."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from pathlib import Path

import pytest

from swarmdsl.execution.simulate.scenario.durations import SECOND, Fixed, Uniform
from swarmdsl.execution.simulate.scenario.scenario import EVERY_FUNCTION, Scenario
from swarmdsl.execution.verify.automata import clock_classes
from swarmdsl.execution.verify.proofs.verdict import Verdict
from swarmdsl.execution.verify.robot.environment import Options

from .conftest import at_least, model_of, system_of, verdicts_of
from .random_timed import STATES, random_timed_swarm
from .slow_timed import Bounds, refuted_in_time

MOST = 350
"""Number of states up to which the slow explorer plays all runs from their beginning."""
TIMES: tuple[tuple[Bounds, Bounds], ...] = (((1, 1), (0, 0)), ((1, 2), (0, 0)), ((2, 2), (0, 1)))
"""Times of functions and of events between robots, in seconds."""
# Seeds of swarms that have far fewer states.
FEW = (0, 2, 3, 4, 5, 6, 7, 9, 10, 11, 12, 17, 19)


def compare(seed: int, path: Path) -> Counter[str]:
    """Compare the verdicts on a random swarm; return how many of each kind there are."""
    # Where only states count, what changes none is not told apart.
    of_states = seed not in FEW and seed % 2
    text = random_timed_swarm(seed, STATES) if of_states else random_timed_swarm(seed)
    path.write_text(text, encoding="utf-8")
    function, latency = TIMES[seed % len(TIMES)]
    lengths = {(EVERY_FUNCTION, ""): {"duration": _length(function)}}
    scenario = Scenario(functions=lengths, latency=_length(latency))
    model = model_of(path, None, Options(2, times=scenario, exact=True))
    found: Counter[str] = Counter()
    wanted = refuted_in_time(system_of(path), list(model.outside), function, latency, MOST)
    if wanted is None:
        return found
    for name, verdict in verdicts_of(model, 50_000).items():
        found[verdict.outcome] += 1
        match verdict.outcome:
            case "holds":
                assert name not in wanted, (seed, verdict)
            case "fails":
                assert name in wanted, (seed, verdict)
            case _:
                # Only for an order of messages that cannot be.
                assert "overtakes" in verdict.reason or "on the way" in verdict.reason, verdict
    return found


def _length(bounds: Bounds) -> Fixed | Uniform:
    least, most = bounds
    return Fixed(least * SECOND) if least == most else Uniform(least * SECOND, most * SECOND)


@pytest.mark.timeout(3000)
def test_verdicts_with_clocks_are_those_of_all_runs(seeds: Sequence[int], tmp_path: Path) -> None:
    found: Counter[str] = Counter()
    for seed in seeds:
        found += compare(seed, tmp_path / "random.swarm")

    assert min(found["holds"], found["fails"]) >= at_least(21, seeds)
    assert seeds is not FEW or found.total() == 6 * len(FEW)


WAITING = """package test
function attempt : abstraction { service "attempt" : std_srvs/Empty }
event Go : std_msgs/Empty
endless statemachine M {
  initial Look
  state Look {
    do attempt
    on succeeded, aborted -> Look
    on Go -> Rest
  }
  state Rest { after 3 s -> Look }
}
member A { behavior M }
swarm S { a : A[5] }
property Wakes of S : some a in Rest leads to some a in Look within 3 s
property Sleeps of S : some a in Rest leads to some a in Look within 2 s
"""


def test_states_that_no_run_tells_apart_are_one(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "model.swarm"

    def both(text: str) -> list[dict[str, Verdict]]:
        path.write_text(text, encoding="utf-8")
        found = []
        for most in (2_000, 0):
            monkeypatch.setattr(clock_classes, "MOST_STATES", most)
            found.append(verdicts_of(model_of(path, None, Options(2, exact=True))))
        return found

    classes, states = both(WAITING)
    assert [each.outcome for each in classes.values()] == ["holds", "fails"]
    assert 2 * classes["Wakes"].states <= states["Wakes"].states
    for seed in range(20, 30):
        classes, states = both(random_timed_swarm(seed, STATES))
        for name, verdict in states.items():
            assert (verdict.outcome, verdict.robot) == (
                classes[name].outcome,
                classes[name].robot,
            ), (seed, name)
