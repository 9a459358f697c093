"""Proofs about one robot of a swarm of which the other robots cannot be looked at."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from pathlib import Path

import pytest

from swarmdsl.execution.verify import model as made
from swarmdsl.execution.verify.environment import Options
from swarmdsl.execution.verify.limits import Budget, Limits
from swarmdsl.execution.verify.model import Model
from swarmdsl.execution.verify.prove import prove

from .conftest import model_of, verdicts_of
from .random_swarms import random_swarm

MODEL = """
package counting

message Place { x : float64; y : float64 }
action Look { result { place : Place } }
function look : abstraction { action "look" : Look }
event Go : std_msgs/Empty
swarm event Seen : Place
swarm event Come : std_msgs/Bool
swarm event Near : Place

// It has more states than are looked at, and computes with places.
endless statemachine Count {
  var n : int32 = 0
  var place : Place
  initial Idle
  state Idle {
    on Seen / n = n + 1, place = Place(x = event.x + n, y = event.y) -> Tell
  }
  choice Tell {
    [hypot(place.x, place.y) > n] / send Come(data = true) -> Idle
    else / send Near(x = place.x, y = n) -> Idle
  }
}
endless statemachine Fly {
  var place : Place
  var home  : string = "base[0]"
  initial Search
  state Search {
    do look gives (place => place)
    on succeeded / send Seen(x = place.x, y = place.y) -> Search
    on aborted -> Search
    on Come [event.data] -> Land
    on Come [not event.data] -> Wait
    on Near [event.x < 2 and event.sender == home] -> Close
  }
  state Wait { on Go -> Search }
  state Close { on Go -> Search }
  state Land { on Go -> Search }
}
member Drone { behavior Fly }
member Base { behavior Count }
swarm Field {
  drone : Drone[2]
  base  : Base
}
"""


@pytest.mark.parametrize(
    ("sentence", "holds"),
    [
        ("in Land only after hears Come [event.data]", True),
        ("in Land only after hears Come [not event.data]", False),
        # The base sends no such event, but that is not looked at.
        ("never in Wait", False),
        ("in Close only after hears Near [event.x < 3]", True),
        ("in Close only after hears Near [event.x < 1]", False),
        ('in Close only after hears Near [event.sender == "base[0]"]', True),
        ('in Close only after hears Near [event.sender == "drone[0]"]', False),
        ("sends Seen [event.x > 0] only after starts look", True),
        ("in Land only after Go", False),
        ("after in Land until Go, in Land at all times", True),
        # What follows in the same step does so in any time, and before all else.
        ("sends Seen leads to starts look within 1 s", True),
        ("hears Go leads to in Search", True),
        ("in Wait leads to in Search within 1 s", False),
    ],
)
def test_a_robot_is_proved_whatever_those_do_that_have_too_many_states(
    sentence: str, holds: bool, modelled: Callable[..., Model], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(made, "MOST_STATES", 30)
    model = modelled(f"{MODEL}property P of Field : each drone : {sentence}\n")

    verdict = verdicts_of(model, 300)["P"]

    assert not model.complete
    assert (verdict.outcome, verdict.alone) == ("holds", True) if holds else not verdict.alone


def test_what_holds_so_holds_in_random_swarms(tmp_path: Path) -> None:
    found: Counter[str] = Counter()
    path = tmp_path / "random.swarm"
    for seed in range(40):
        path.write_text(random_swarm(seed, heartbeat=seed % 2 == 0), encoding="utf-8")
        model = model_of(path, None, Options(1, seed % 3 == 0, seed % 2))
        for property_ in model.system.properties:
            model.complete = False  # as if not all was known of the others
            alone = prove(property_, model, Budget(Limits(states=1))).alone
            model.complete = True
            known = prove(property_, model, Budget(Limits(states=1)))
            assert known.alone or not alone, (seed, property_.name)
            found["alone"] += alone
            found["missed"] += known.alone and not alone

    assert found["alone"] > 5
    assert found["missed"] < 3
