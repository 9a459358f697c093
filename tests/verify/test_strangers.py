"""Proofs about one robot of a swarm of which the other robots cannot be looked at."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from pathlib import Path

import pytest

from swarmdsl.execution.verify.automata.limits import Budget, Limits
from swarmdsl.execution.verify.proofs.overapproximation import robot_alone
from swarmdsl.execution.verify.proofs.prove import prove
from swarmdsl.execution.verify.proofs.single_robot import hearing_all
from swarmdsl.execution.verify.robot.environment import Options
from swarmdsl.execution.verify.swarm import model as made
from swarmdsl.execution.verify.swarm.model import Model

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
        # The base sends no such event, whatever the places are.
        ("never in Wait", True),
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
        ("in Land leads to in Search within 1 s", False),
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


LOOSE = """
package farm

swarm event Bid  : std_msgs/Float64
swarm event Take : std_msgs/Empty
swarm event Halt : std_msgs/Empty
event Go : std_msgs/Bool

struct Offer {
  way : float64
  id  : string
}
// Its states are too many, and where it sends depends on numbers that others compute.
endless statemachine Sell {
  var offers : Offer[<=8]
  var best   : Offer
  var lost   : int32 = 0
  initial Open
  state Open {
    on Bid [len(offers) < 8] / append Offer(way = event.data, id = event.sender) to offers
    on Go [event.data] -> Choose
    on Go [not event.data and lost < 100] / lost = lost + 1, send Take
    on Halt -> Shut
  }
  choice Choose {
    [len(offers) > 0] / best = min(o in offers by o.way), send Take to best.id, clear offers -> Sold
    else -> Open
  }
  state Sold {
    on Go [in(Sold) and lost > 3] -> Open
    on Go [in(Open)] -> Shut
    on Halt -> Shut
  }
  state Shut { on Go [event.data] -> Open }
}
endless statemachine Buy {
  var way : float64
  initial Near
  state Near { on Go / way = way + 1.5, send Bid(data = way) -> Near }
}
member Seller { behavior Sell }
member Buyer { behavior Buy }
swarm Market {
  seller : Seller
  buyer  : Buyer[2]
}
"""


@pytest.mark.parametrize(
    ("sentence", "holds"),
    [
        ("hears Halt leads to in Shut within 1 s", True),
        ("sends Take leads to in Sold or in Open", True),
        ("in Sold only after Go", True),
        ("in Shut only after hears Halt", True),
        ("after hears Halt until Go [event.data], in Shut at all times", True),
        # Data decide, or it is about them.
        ("sends Take only after hears Bid", False),
        ("never has [lost > 100]", False),
        ("sends Take leads to in Sold", False),
    ],
)
def test_data_are_left_open_where_they_have_too_many_values(
    sentence: str, holds: bool, modelled: Callable[..., Model], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(made, "MOST_STATES", 30)
    monkeypatch.setattr(made, "MOST_MOVES", 300)
    model = modelled(f"{LOOSE}property P of Market : each seller : {sentence}\n")

    verdict = verdicts_of(model, 300)["P"]

    assert (verdict.outcome == "holds", verdict.open) == (
        holds,
        ("its variables",) if holds else (),
    )


SMALL = """
package small

swarm event Take : std_msgs/Empty
swarm event Halt : std_msgs/Empty
event Go : std_msgs/Bool
endless statemachine Work {
  var full : bool = false
  initial A
  state A {
    on Go [event.data and not full] / full = true -> B
    on Go [full] / send Take, full = false -> C
    on Halt -> C
  }
  state B {
    on Halt [full] -> A
    on Go [not full] -> C
    on Halt -> C
  }
  state C { on Go / full = event.data -> A }
}
endless statemachine Tell {
  initial On
  state On { on Go / send Halt -> On }
}
member Worker { behavior Work }
member Teller { behavior Tell }
swarm S {
  worker : Worker
  teller : Teller
}
"""


def test_what_holds_without_data_holds_with_them(modelled: Callable[..., Model]) -> None:
    facts = ("in A", "in B", "in C", "sends Take", "hears Halt", "hears Go [event.data]")
    forms = ("{} only after {}", "{} leads to {}", "never {} and {}", "after {}, never {}")
    pairs = [form.format(a, b) for a in facts for b in facts if a != b for form in forms]
    said = [f"property P{n} of S : each worker : {each}\n" for n, each in enumerate(pairs)]
    model = modelled(SMALL + "".join(said))
    found: Counter[tuple[bool, bool]] = Counter()
    for property_, sentence in zip(model.system.properties, pairs, strict=True):
        shown = []
        for loose in (False, True):
            alone = robot_alone(model, [property_], "worker[0]", Budget(Limits()), is_open=loose)
            assert alone is not None
            (own,) = alone.groups([property_], me="worker[0]")
            assert alone.complete
            shown.append(hearing_all(property_, own.automaton) is not None)
        known, without_data = shown
        assert known or not without_data, sentence
        found[known, without_data] += 1

    assert found[True, True] > 10
    assert found[True, False] > 2
