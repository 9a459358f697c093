"""Proofs that leave data open: conditions on them may hold or not, each time."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from pathlib import Path

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.execution.verify.abstraction.places import Node
from swarmdsl.execution.verify.automata.limits import Budget, Limits
from swarmdsl.execution.verify.proofs.open_data import is_about, loosened
from swarmdsl.execution.verify.proofs.prove import prove
from swarmdsl.execution.verify.robot.environment import Options
from swarmdsl.execution.verify.swarm.model import Model

from .conftest import model_of, verdicts_of
from .random_swarms import random_swarm

MODEL = """
package patrol

message Spill { id : string; size : float64 }
event Seen : Spill
event Go : std_msgs/Empty
swarm event Found : Spill
swarm event Help  : Spill

endless statemachine Patrol {
  var known : string[<=3]
  var area  : float64 = 0.0
  var last  : string
  initial Round
  state Round {
    on Seen [not contains(known, event.id) and len(known) < 3]
      / append event.id to known, area = area + event.size, last = event.id,
        send Found(id = event.id, size = event.size) -> Mark
    on Found [not contains(known, event.id)] / append event.id to known, last = event.sender
    on Help [event.size > 1.5] -> Assist
  }
  state Mark {
    on Go [area > 10.0] / send Help(size = 2.0) to last -> Round
    on Go -> Round
  }
  state Assist { on Go -> Round }
}
member Robot { behavior Patrol }
swarm Night { robot : Robot[2] }
"""


@pytest.mark.parametrize(
    ("sentence", "outcome", "left_open"),
    [
        (
            "some robot in Assist only after some robot in Mark",
            "holds",
            ("`Seen.id`", "`Seen.size`"),
        ),
        (
            "each robot : in Assist only after hears Help [event.size > 1.0]",
            "holds",
            ("`Seen.id`", "`Seen.size`"),
        ),
        # It is about the data.
        ("never some robot has [len(known) > 2]", "unknown", ()),
        ("some robot in Round only after Go", "fails", ()),
    ],
)
def test_guards_on_what_is_not_all_covered_may_hold_or_not(
    sentence: str, outcome: str, left_open: tuple[str, ...], modelled: Callable[..., Model]
) -> None:
    model = modelled(f"{MODEL}property P of Night : {sentence}\n")

    verdict = verdicts_of(model, 6_000)["P"]

    assert (verdict.outcome, verdict.open) == (outcome, left_open), verdict.reason


DATA: tuple[Node, ...] = (
    ("event", "Ask", ("word",)),
    ("event", "Tell", ("word",)),
    ("result", "attempt", ("ok",)),
    ("var", "One.n", ()),
    ("var", "One.ok", ()),
)


def test_what_holds_with_open_data_holds_in_random_swarms(tmp_path: Path) -> None:
    found: Counter[str] = Counter()
    path = tmp_path / "random.swarm"
    limits = Limits(states=4_000)
    for seed in range(10):
        path.write_text(random_swarm(seed), encoding="utf-8")
        real = model_of(path, None, Options(1, seed % 3 == 0, seed % 2))
        data = real.demands.reached_from([DATA[seed % len(DATA)]])
        loose = loosened(real.subject, real.machines.values(), data, ["a", "a[0]", "a[1]", "b[0]"])
        assert loose is not None
        properties = [p for p in real.properties if not is_about(p, real.cast, data)]
        model = Model(loose, {}, properties, real.options, Budget(limits), Diagnostics())
        for property_ in properties:
            with_open = prove(property_, model, Budget(limits)).outcome
            known = prove(property_, real, Budget(limits)).outcome
            assert with_open != "holds" or known in ("holds", "up to"), (seed, property_.name)
            found[with_open if known == "holds" else known] += 1

    assert found["holds"] > 5
    assert found["fails"] > 5
