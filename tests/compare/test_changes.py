"""Changes between two models."""

from __future__ import annotations

import json
from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import Phase, given, settings

from swarmdsl.driver import pipeline
from swarmdsl.ir import System
from swarmdsl.tools.compare.changes import Action, display_name
from swarmdsl.tools.compare.comparison import compare
from swarmdsl.tools.compare.model import model_element
from swarmdsl.tools.compare.report import format_breaking_changes, format_changes
from swarmdsl.tools.compare.rules import RULES

from ..swarm_printer.systems import systems

MODEL = """package lab

enum Mode {
  SLOW = 0
  FAST = 1
}
struct Spot {
  x : float64
  y : float64
}
swarm event Alarm : Spot
event Reset : std_msgs/Empty on "reset"
action Look {
  goal {
    range : float32
    mode  : uint8
  }
  result { seen : bool }
}
function look : abstraction {
  action "look" : Look
  in "scan" : sensor_msgs/LaserScan
  param rate : float64 = 10.0
}
sensor Eye {
  out spot : Spot on "spot"
  param gain : float64 = 1.0
}
controller Brain { in spot : Spot on "spot" }
statemachine Watch {
  param range : float32 = 2.0
  var seen : bool
  var tries : int32
  initial Idle
  state Idle { on Alarm [event.x > 1.0] / tries = 0 -> Search }
  state Search {
    initial Look
    state Look {
      do look(range = range, mode = 1) gives (seen => seen)
      on succeeded [seen] / send Alarm(x = 1.0) -> Found
      on succeeded -> Pause
      on aborted -> Pause
    }
    state Pause { after 5 s / tries = tries + 1 -> Look }
    on Reset -> Idle
  }
  final Found
}
member Robot {
  behavior Watch
  param range : float32 = 3.0
  eye : Eye
  brain : Brain
  connect eye.spot -> brain.spot
}
swarm Lab {
  robot : Robot[2..6]
}
property Finds of Lab : each robot : hears Alarm leads to in Found within 1 min
property Sees of Lab : never some robot in Look and some robot has [tries > 9]
"""

CHANGES = {
    "a property that allows more": (
        "within 1 min",
        "within 2 min",
        [
            "~ property Finds",
            (
                "    ~ says is `each robot : hears Alarm leads to in Found within 2 min`, "
                "was `each robot : hears Alarm leads to in Found within 1 min`, weaker"
            ),
        ],
    ),
    "a property about fewer messages": (
        "each robot : hears Alarm leads",
        "each robot : hears Alarm [event.x > 2] leads",
        [
            "~ property Finds",
            (
                "    ~ says is `each robot : hears Alarm [event.x > 2] leads to in Found within "
                "1 min`, was `each robot : hears Alarm leads to in Found within 1 min`, weaker"
            ),
        ],
    ),
    "a property of others": (
        "hears Alarm leads",
        "in Idle leads",
        [
            "~ property Finds",
            (
                "    ~ says is `each robot : in Idle leads to in Found within 1 min`, "
                "was `each robot : hears Alarm leads to in Found within 1 min`"
            ),
        ],
    ),
    "layout": ("state Pause {", "state   Pause\n  {", []),
    "the order of declarations": (
        'event Reset : std_msgs/Empty on "reset"\naction',
        "action",
        ["- event Reset [EVENT_REMOVED]"],
    ),
    "an event renamed": (
        "Alarm",
        "Panic",
        [
            "~ event Panic",
            "    ~ renamed from `Alarm` [EVENT_REMOVED]",
            "    ~ topic is `panic`, was `alarm` [EVENT_TOPIC]",
        ],
    ),
    "a field added": (
        "  y : float64",
        "  y : float64\n  z : float64",
        ["~ message lab/Spot", "    + field `z` [FIELD_ADDED]"],
    ),
    "fields in another order": (
        "  x : float64\n  y : float64",
        "  y : float64\n  x : float64",
        ["~ message lab/Spot", "    ~ fields reordered [FIELD_ORDER]"],
    ),
    "a field retyped": (
        "range : float32\n    mode",
        "range : float64\n    mode",
        [
            "~ action lab/Look",
            "    ~ goal field `range`: type is `float64`, was `float32` [FIELD_TYPE]",
        ],
    ),
    "a constant": (
        "FAST = 1",
        "FAST = 2",
        ["~ message lab/Mode", "    ~ constant `FAST`: value is `2`, was `1` [CONSTANT_VALUE]"],
    ),
    "a server": (
        'action "look"',
        'action "cmd/look"',
        ["~ function look", "    ~ server is `cmd/look`, was `look` [FUNCTION_SERVER]"],
    ),
    "a default gone": (
        "rate : float64 = 10.0",
        "rate : float64",
        [
            "~ function look",
            "    ~ param `rate`: default `10.0` removed [PARAM_REQUIRED]",
        ],
    ),
    "a default": (
        "gain : float64 = 1.0",
        "gain : float64 = 2.0",
        ["~ component Eye", "    ~ param `gain`: default is `2.0`, was `1.0`"],
    ),
    "a port on another topic": (
        'out spot : Spot on "spot"',
        'out spot : Spot on "eye/spot"',
        ["~ component Eye", "    ~ port `spot`: topic is `eye/spot`, was `spot` [PORT_TOPIC]"],
    ),
    "a state renamed": (
        "Pause",
        "Rest",
        ["~ statemachine Watch", "    ~ state `Search.Rest`: renamed from `Pause`"],
    ),
    "a state with its inside renamed": (
        "Search",
        "Hunt",
        ["~ statemachine Watch", "    ~ state `Hunt`: renamed from `Search`"],
    ),
    "a transition retargeted": (
        "on aborted -> Pause",
        "on aborted -> Look",
        [
            "~ statemachine Watch",
            (
                "    ~ transition `on aborted` of state `Search.Look`: "
                "target is `Search.Look`, was `Search.Pause`"
            ),
        ],
    ),
    "one of two transitions on the same": (
        "on succeeded -> Pause",
        "on succeeded -> Look",
        [
            "~ statemachine Watch",
            (
                "    ~ transition `on succeeded` of state `Search.Look`: "
                "target is `Search.Look`, was `Search.Pause`"
            ),
        ],
    ),
    "a guard": (
        "[event.x > 1.0]",
        "[event.x > 2.0]",
        [
            "~ statemachine Watch",
            (
                "    ~ transition `on Alarm` of state `Idle`: "
                "guard is `event.x > 2.0`, was `event.x > 1.0`"
            ),
        ],
    ),
    "a guard on the robot itself": (
        "[event.x > 1.0]",
        "[event.x > self.index]",
        [
            "~ statemachine Watch",
            (
                "    ~ transition `on Alarm` of state `Idle`: "
                "guard is `event.x > self.index`, was `event.x > 1.0`"
            ),
        ],
    ),
    "a variable renamed": (
        "tries",
        "count",
        ["~ statemachine Watch", "    ~ variable `count`: renamed from `tries`"],
    ),
    "an event that nothing handles": (
        "    on Reset -> Idle\n",
        "",
        ["~ statemachine Watch", "    - transition `on Reset -> Idle` of state `Search`"],
    ),
    "fewer robots": (
        "Robot[2..6]",
        "Robot[2..4]",
        ["~ swarm Lab", "    ~ role `robot`: number is `2..4`, was `2..6` [ROLE_NUMBER]"],
    ),
    "more robots": (
        "Robot[2..6]",
        "Robot[1..*]",
        ["~ swarm Lab", "    ~ role `robot`: number is `1..*`, was `2..6`"],
    ),
    "a connector gone": (
        "  connect eye.spot -> brain.spot\n",
        "",
        ["~ member Robot", "    - connector `eye.spot -> brain.spot`"],
    ),
    "a final state renamed": (
        "Found",
        "Done",
        ["~ statemachine Watch", "    ~ state `Done`: renamed from `Found` [OUTCOME_LOST]"],
    ),
    "a comment": (
        "statemachine Watch {",
        "/// Looks out.\nstatemachine Watch {",
        ["~ statemachine Watch", "    ~ documentation `Looks out.` added"],
    ),
    "a comment on a call": (
        "do look(",
        "/// Once around.\n      do look(",
        [
            "~ statemachine Watch",
            "    ~ state `Search.Look`: documentation of activity `Once around.` added",
        ],
    ),
    "a state moved out": (
        "    state Pause { after 5 s / tries = tries + 1 -> Look }\n    on Reset -> Idle\n  }",
        "    on Reset -> Idle\n  }\n  state Pause { after 5 s / tries = tries + 1 -> Search.Look }",
        ["~ statemachine Watch", "    > state `Pause`: moved from `Search` to the top level"],
    ),
}


def system(text: str, folder: Path) -> System:
    path = folder / "lab.swarm"
    path.write_text(text, encoding="utf-8")
    result = pipeline.check([path])
    assert result.system is not None, [found.message for found in result.report]
    return result.system


def report(before: System, after: System) -> list[str]:
    changes, breaking = compare(before, after)
    lines = format_changes(changes, breaking, "text", lambda _: "")
    return [line.removesuffix(" ()") for line in lines]


@pytest.mark.parametrize("case", CHANGES)
def test_changes(case: str, tmp_path: Path) -> None:
    old, new, expected = CHANGES[case]
    assert old in MODEL
    text = MODEL.replace(old, new)
    if case == "the order of declarations":
        text = text.replace("    on Reset -> Idle\n", "")
    before, after = system(MODEL, tmp_path), system(text, tmp_path)

    found = report(before, after)
    if case == "the order of declarations":
        found = found[-1:]
    assert found == expected
    assert bool(report(after, before)) == bool(expected)


def test_what_a_machine_no_longer_does(tmp_path: Path) -> None:
    text = MODEL.replace("    on Reset -> Idle\n", "").replace(" / send Alarm(x = 1.0)", "")
    _, breaking = compare(system(MODEL, tmp_path), system(text, tmp_path))

    assert list(format_breaking_changes(breaking, "text", lambda span: f"{span.line}")) == [
        "30: statemachine `Watch` no longer handles `Reset` [EVENT_UNHANDLED]",
        "30: statemachine `Watch` no longer sends `Alarm` [EVENT_UNSENT]",
    ]


def test_what_is_inherited_is_told_once(tmp_path: Path) -> None:
    model = MODEL + "member Big extends Robot { }\nsensor BigEye extends Eye { }\n"
    before = system(model, tmp_path)
    after = system(model.replace("gain : float64 = 1.0", "gain : float64 = 2.0"), tmp_path)

    assert report(before, after) == [
        "~ component Eye",
        "    ~ param `gain`: default is `2.0`, was `1.0`",
    ]


def test_a_submachine_is_compared_where_it_is_declared(tmp_path: Path) -> None:
    model = MODEL + "statemachine Twice { initial A; state A = Watch { on done -> B } final B }\n"
    before = system(model, tmp_path)
    after = system(model.replace("after 5 s", "after 7 s"), tmp_path)

    assert report(before, after) == [
        "~ statemachine Watch",
        "    ~ transition `after 7 s` of state `Search.Pause`: was `after 5 s`",
    ]


RECEIVERS = """package lab
swarm event Alarm : std_msgs/Empty{delivery}
statemachine Watch {{
  initial Idle
  state Idle {{ on Alarm -> Done }}
  final Done
}}
"""
DELIVERIES = {
    # Before, after: True if receivers can rely on less.
    ("", "reliable"): False,
    ("reliable", ""): False,
    ("reliable, latest", "best effort"): True,
    ("", "best effort"): True,
    ("best effort", "reliable, latest, keep 1"): False,
    ("reliable, latest", "reliable"): True,
    ("reliable, keep 1", "reliable, latest"): False,
    ("reliable", "reliable, latest"): True,  # one waits, where all did
    ("keep 5", "keep 4"): True,
    ("keep 5", "keep 6"): False,
    ("", "keep 6"): True,
    ("lifespan 2 s", "lifespan 3 s"): False,
    ("lifespan 2 s", "lifespan 1 s"): True,
    ("", "lifespan 1 s"): True,
    ("deadline 2 s", "deadline 3 s"): True,
    ("deadline 2 s", "deadline 1 s"): False,
    ("deadline 2 s", ""): True,
    ("keep 5, lifespan 1 s", "keep 4, lifespan 2 s"): True,
}


@pytest.mark.parametrize(("before", "after"), DELIVERIES)
def test_a_delivery_breaks_who_relies_on_more(before: str, after: str, tmp_path: Path) -> None:
    old, new = (
        system(RECEIVERS.format(delivery=f" {{ {each} }}" if each else ""), tmp_path)
        for each in (before, after)
    )
    changes, breaking = compare(old, new)

    assert [each.property_name for each in changes] == ["delivery"]
    expected = ["EVENT_DELIVERY"] if DELIVERIES[before, after] else []
    assert [each.rule for each in breaking] == expected


def test_who_sends_an_event_relies_on_being_asked_to(tmp_path: Path) -> None:
    robots = system(RECEIVERS.format(delivery=""), tmp_path)
    text = RECEIVERS.format(delivery="").replace("swarm event", "swarm operator event")
    person = system(text, tmp_path)

    for old, new, expected in ((person, robots, ["EVENT_OPERATOR"]), (robots, person, [])):
        changes, breaking = compare(old, new)
        assert [each.property_name for each in changes] == ["operator"]
        assert [each.rule for each in breaking] == expected


def test_a_delivery_is_told_where_it_is(tmp_path: Path) -> None:
    before = system(RECEIVERS.format(delivery=" {\n  reliable\n  latest\n}"), tmp_path)
    after = system(RECEIVERS.format(delivery=" {\n\n  best effort\n}"), tmp_path)
    changes, breaking = compare(before, after)

    expected = ["4: event `Alarm` delivery is `best effort`, was `reliable, latest`"]
    lines = format_breaking_changes(breaking, "text", lambda span: f"{span.line}")
    assert list(lines) == [f"{line} [EVENT_DELIVERY]" for line in expected]
    told = list(format_changes(changes, (), "json", lambda span: f"{span.line}"))
    assert [
        (json.loads(each)["place_before"], json.loads(each)["place_after"]) for each in told
    ] == [("3", "4")]


ROBOTS = """package lab
event Go : std_msgs/Empty
endless statemachine Watch {
  initial Idle
  state Idle { on Go -> Idle; on member_lost -> Idle }
}
member Robot {
  behavior Watch
  param rate : float64 = 1.0
}
swarm Lab {
  one : Robot[3]
  two : Robot[3]
  one[2] { rate = 7.0 }

  heartbeat 1 s lost after 3 s
}
"""


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        ("one[2]", "one[1]", ["    - robot `one[2]` (14)", "    + robot `one[1]` (14)"]),
        ("one[2]", "two[2]", ["    - robot `one[2]` (14)", "    + robot `two[2]` (14)"]),
        ("one", "first", ["    ~ role `first`: renamed from `one` [ROLE_REMOVED] (12)"]),
        ("7.0", "8.0", ["    ~ robot `one[2]`: values is `rate = 8.0`, was `rate = 7.0` (14)"]),
        (
            "after 3 s",
            "after 4 s",
            ["    ~ heartbeat is `1 s lost after 4 s`, was `1 s lost after 3 s` (16)"],
        ),
        ("  heartbeat", "\n  heartbeat", []),
    ],
)
def test_robots_have_numbers(old: str, new: str, expected: list[str], tmp_path: Path) -> None:
    before, after = system(ROBOTS, tmp_path), system(ROBOTS.replace(old, new), tmp_path)
    changes, breaking = compare(before, after)

    lines = list(format_changes(changes, breaking, "text", lambda span: f"{span.line}"))
    assert lines[1:] == expected


LOCAL = """package lab
event Go : std_msgs/Empty
statemachine Fly {
  initial Up
  state Up {
    var tries : int32 = 0
    on Go / tries = tries + 1
    [tries > 3] -> Down
  }
  final Down
}
member Robot { behavior Fly }
swarm Lab { robot : Robot }
property Few of Lab : never robot has [tries > 5]
"""


def test_variables_of_states_have_their_names_in_the_model(tmp_path: Path) -> None:
    new = LOCAL.replace("= 0", "= 2").replace("tries + 1", "tries + 2").replace("5]", "6]")
    changes, breaking = compare(system(LOCAL, tmp_path), system(new, tmp_path))

    assert list(format_changes(changes, breaking, "text", lambda span: f"{span.line}")) == [
        "~ statemachine Fly (3)",
        "    ~ variable `Up.tries`: initial is `2`, was `0` (6)",
        (
            "    ~ transition `on Go` of state `Up`: effect is `Up.tries = Up.tries + 2`, "
            "was `Up.tries = Up.tries + 1` (7)"
        ),
        "~ property Few (14)",
        (
            "    ~ says is `never robot has [Up.tries > 6]`, "
            "was `never robot has [Up.tries > 5]`, weaker (14)"
        ),
    ]


def test_every_rule_is_explained() -> None:
    assert all(rule == rule.upper() and about for rule, about in RULES.items())


@settings(
    max_examples=60,
    phases=[Phase.generate],
)
@given(systems(), systems())
def test_any_two(before: System, after: System) -> None:
    """Nothing is different from itself, and all that has a new name is told."""
    assert compare(before, before) == ([], [])
    changes, _ = compare(before, after)
    whole = replace(before, doc="", name=after.name) == replace(after, doc="", name=after.name)
    assert bool(changes) or whole
    named = {(each.kind, display_name(each)) for each in model_element(before).children}
    told = {
        (each.kind, display_name(each.element))
        for each in changes
        if each.element is each.top and each.action in (Action.ADDED, Action.RENAMED)
    }
    new = {(each.kind, display_name(each)) for each in model_element(after).children} - named
    assert {name for name in new if name[0] != "optimization"} <= told
