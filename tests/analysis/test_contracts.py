"""Contracts: states that ignore the event, paths that miss the safe states, safe states left."""

from __future__ import annotations

from pathlib import Path

import pytest

from swarmdsl.driver import pipeline

MODEL = """
swarm event Go : std_msgs/Empty
swarm event Halt : std_msgs/Empty
event Level : std_msgs/Float64
event Own : std_msgs/Empty
function land : abstraction {{ service "land" : std_srvs/Empty }}
member Uav {{
  behavior Fly
  contract Safe : {contract}
}}
endless statemachine Fly {{
  initial {initial}
  {states}
  state Down {{ on Go -> {initial} }}
}}
"""
HALT = "on Halt within 2 s reach Down"
LEVEL = "on Level [event.data < 10] within 2 s reach Down"
WORK = """state Work {
  initial A
  state A { on Go -> B }
  state B { on Go -> A }
  %s
}"""
REGIONS = """parallel state Work {
  region One { initial A; state A { on Go -> B }; state B { on Go -> A } }
  region Two { initial C; %s }
  on Two.done -> Down
}"""


def found(folder: Path, contract: str, states: str, initial: str = "Work") -> list[str]:
    """Return the messages about a contract of a model."""
    model = folder / "model.swarm"
    text = MODEL.format(contract=contract, states=states, initial=initial)
    model.write_text(text, encoding="utf-8")
    report = pipeline.check([model]).report
    return [each.message for each in report if each.code.startswith("SW16")]


@pytest.mark.parametrize(
    ("contract", "states"),
    [
        (HALT, WORK % "on Halt -> Down"),
        (HALT, "state Work { on Halt -> Brake }; state Brake { after 1 s -> Down }"),
        (HALT, "state Work { on Halt -> Pick }; choice Pick { [1 < 2] -> Down; else -> Down }"),
        (
            HALT,
            "state Work { on Halt -> L }; state L { do land; on succeeded, aborted -> Down }",
        ),
        (HALT, "state Work { on Halt -> Tell }; state Tell { entry / send Own; on Own -> Down }"),
        (HALT, REGIONS % "state C { on Halt -> D }; final D"),
        (HALT, "state Work = Inner { on Halt -> Down }"),
        (LEVEL, "state Work { on Level [event.data < 20] -> Down }"),
        (LEVEL, "state Work { on Level [event.data < 5] -> Down; on Level -> Down }"),
    ],
    ids=["around", "delay", "choice", "function", "own", "region", "reused", "implied", "both"],
)
def test_kept(contract: str, states: str, tmp_path: Path) -> None:
    inner = (
        "endless statemachine Inner { initial X; state X { on Go -> Y }; state Y { on Go -> X } }"
    )

    assert found(tmp_path, contract, f"{states}\n}}\n{inner.removesuffix('}')}") == []


@pytest.mark.parametrize(
    ("contract", "states", "message"),
    [
        (HALT, WORK % "on Go -> Down", "`Work.A` and `Work.B` ignore `Halt`"),
        (HALT, WORK % "on Halt -> Work", "in `Work.A`, `Halt` leads to a safe"),
        (HALT, "state Work { defer Halt; on Go -> Down }", "`Work` ignores `Halt`"),
        (
            HALT,
            "state Work { on Halt / send Own }",
            "in `Work`, `Halt` leaves the robot where it is",
        ),
        (
            HALT,
            "state Work { on Halt -> Wait }; state Wait { on Go -> Down; on Halt -> Down }",
            "in `Work`, `Halt` leads to `Wait`, from where no path leads to a safe state",
        ),
        (
            HALT,
            "state Work { on Halt -> Brake }; state Brake { after 3 s -> Down; on Halt -> Down }",
            "in `Work`, `Halt` leads to a safe state after 3 s at the earliest",
        ),
        (HALT, REGIONS % "state C { on Go -> D }; final D", "ignore `Halt`"),
        (LEVEL, "state Work { on Level [event.data < 5] -> Down }", "`Work` ignores `Level`"),
    ],
    ids=["all", "back", "deferred", "stays", "waits", "late", "region", "guard"],
)
def test_broken(contract: str, states: str, message: str, tmp_path: Path) -> None:
    if "Halt -> Work" in states:  # a way round that is too long
        states = states.replace("on Halt -> Work", "on Halt -> Work; after 1 min -> Down")
        message = "in `Work.A`, `Halt` leads to a safe state after 60 s at the earliest"
    first, *_ = found(tmp_path, contract, states)

    assert first.startswith("contract `Safe`: ")
    assert message in first


def test_a_safe_state_is_left_only_for_another_one_or_on_an_event(tmp_path: Path) -> None:
    states = "state Work { on Halt -> Land }; state Land { after 1 s -> Work; on Go -> Work }"
    left = found(tmp_path, "on Halt within 2 s reach Land, Down", states)
    named = found(tmp_path, "on Halt within 2 s reach Land, Work, Down", states)

    assert left == ["contract `Safe`: a robot leaves `Land` by itself"]
    assert named == []


def test_states_count_as_on_the_way_only_after_the_event(tmp_path: Path) -> None:
    states = """state Work { do land; on succeeded, aborted -> Halting }
    state Halting { on Halt -> Brake; after 1 s -> Brake }
    state Brake { after 1 s -> Down }"""

    assert found(tmp_path, HALT, states) == ["contract `Safe`: `Work` ignores `Halt`"]


def test_a_region_that_has_ended_takes_nothing(tmp_path: Path) -> None:
    regions = """parallel state Work {{
      region One {{ initial A; state A {{ on Go -> A }} }}
      region Two {{ initial C; state C {{ on Halt -> D; on Own -> E }}; final D; final E }}
      on Two.{} -> Down
    }}"""
    (ignored,) = found(tmp_path, HALT, regions.format("done.D"))

    assert "`Work.A` and `Work.E` ignore `Halt`" in ignored
    assert found(tmp_path, HALT, regions.format("done")) == []


def test_guards_of_one_text_may_mean_other_values(tmp_path: Path) -> None:
    contract = "on Level [event.data < limit] within 2 s reach Down"
    states = "state Work { on Level [event.data < limit] -> Down }"
    param = "param limit : float64 = 10.0"

    def with_limits(machine: str) -> list[str]:
        return found(tmp_path, f"{contract}\n  {param}", f"{machine}\n  {states}")

    assert with_limits("param limit : float64") == []
    assert with_limits("var limit : float64 = 3.0") == ["contract `Safe`: `Work` ignores `Level`"]


def test_many_ways_are_followed_once(tmp_path: Path) -> None:
    steps = [
        f"state S{n} {{ after 1 ms -> S{n + 1}; after 2 ms -> S{n + 1}; on Go -> S60 }}"
        for n in range(60)
    ]
    states = "\n".join(["state Work { on Halt -> S0 }", *steps, "state S60 { after 1 ms -> Down }"])

    assert found(tmp_path, HALT.replace("2 s", "3 s"), states) == []


def test_one_function_is_called_for_a_dead_node(tmp_path: Path) -> None:
    model = tmp_path / "model.swarm"
    one, two = (f"contract {name} : when dead call land" for name in ("Dies", "Falls"))
    base = MODEL.format(contract=HALT, states="state Work { on Halt -> Down }", initial="Work")
    more = f"member Base {{ {one} }}\nmember Other extends Base {{ {two} }}\n"
    model.write_text(base + more, encoding="utf-8")
    (second,) = pipeline.check([model]).report

    assert (second.code, second.message) == ("SW0404", "the call of a watchdog is given twice")


def test_inherited_contracts_hold_in_another_machine(tmp_path: Path) -> None:
    other = """
endless statemachine Other {{
  initial Work
  state Work {{ on {event} -> {target} }}
  state {target} {{ on Go -> Work }}
}}
member Tug extends Uav {{ behavior Other }}
"""

    def of(event: str, target: str) -> list[str]:
        inside = "state Work { on Halt -> Down }"
        base = MODEL.format(contract=HALT, states=inside, initial="Work")
        path = tmp_path / "model.swarm"
        path.write_text(base + other.format(event=event, target=target), encoding="utf-8")
        return [each.message for each in pipeline.check([path]).report if each.code[:4] == "SW16"]

    assert of("Halt", "Down") == []
    assert of("Go", "Down") == ["contract `Safe`: `Work` ignores `Halt`"]
    nothing = "contract `Safe` promises nothing: no state of `Other` is called `Down`"
    assert of("Halt", "Hover") == [nothing]
