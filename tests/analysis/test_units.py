"""Units of numbers: literals, results of operations, errors, and the way through a document."""

from __future__ import annotations

import math
from pathlib import Path

import pytest

from swarmdsl.base.diagnostics.collector import Severity
from swarmdsl.codegen.swarm_printer.expressions import expression
from swarmdsl.driver import pipeline
from swarmdsl.ir import FLOAT, Assignment, Binary, Expression, Literal, Send, System
from swarmdsl.syntax.types import unit_name, with_unit
from swarmdsl.syntax.units import UNITS, in_unit_of_ros, written_in

MODEL = """
message lab_msgs/Seen {{ range : float64 }}
event Seen : lab_msgs/Seen
statemachine M {{
  param x : float64 in m = 15 m
  param v : float64 in km/h = 36 km/h
  param d : duration = 90 s
  param n : float64 = 2
  var value : {type} = {initial}
  initial A
  state A {{
    on Seen [{guard}] / value = {value} -> B
    on Seen -> A
  }}
  state B {{ on Seen [value == value] -> Done }}
  final Done
}}
"""


def system(tmp_path: Path, **given: str) -> tuple[System | None, list[tuple[str, str | None]]]:
    parts = {"type": "float64", "initial": "0", "guard": "x > 3 m", "value": "0"}
    file = tmp_path / "model.swarm"
    file.write_text(MODEL.format(**{**parts, **given}), encoding="utf-8")
    checked = pipeline.check([file])
    found = [(each.code, each.help) for each in checked.report if each.severity is Severity.ERROR]
    return (None if found else checked.system), found


@pytest.mark.parametrize(
    ("digits", "unit", "value"),
    [
        ("15", "m", 15),
        ("0.1", "km", 100.0),
        ("0.3", "cm", 0.003),
        ("36", "km/h", 10.0),
        ("90", "deg", math.pi / 2),
        ("20", "%", 0.2),
        ("2", "Wh", 7200),
    ],
)
def test_a_literal_is_converted_once(digits: str, unit: str, value: float) -> None:
    found = in_unit_of_ros(digits, UNITS[unit])
    assert (found, type(found)) == (value, type(value))


@pytest.mark.parametrize("unit", UNITS.values(), ids=str)
def test_a_value_is_written_as_it_reads(unit: object) -> None:
    for value in (0.1, 1 / 3, 0.1 + 0.2, 15.0, 1e-9, 7e20):
        name = str(unit)
        text = written_in(value, UNITS[name])
        digits, _, written = text.strip("()").partition(" ")
        if text.startswith("("):  # as a product
            assert float(digits) == value
        else:
            assert in_unit_of_ros(digits, UNITS[written]) == value


@pytest.mark.parametrize(
    ("type_", "value"),
    [
        ("float64 in m", "x + 20 cm"),
        ("float64 in m/s", "x / 20 s"),
        ("float64 in m", "v * 2 s"),
        ("float64 in s", "x / v + d"),
        ("float64 in s", "d"),
        ("float64 in s", "seconds(d)"),
        ("int32 in s", "30 s"),
        ("duration", "1 s * (x / v / 1 s)"),
        ("float64", "x / 3 m"),
        ("float64", "n * 20 %"),
        ("float64 in %", "n"),
        ("float64 in m2", "x * x"),
        ("float64 in m", "sqrt(x * x) + hypot(x, 3 m)"),
        ("float64 in rad", "atan2(x, event.range)"),
        ("float64", "sin(30 deg) + cos(n * 1 rad)"),
        ("float64 in m", "event.range"),
        ("float64 in kg", "event.range"),
        ("float64 in Hz", "1 / 20 s"),
        ("float64", "n % 2 + 20 % 3"),
    ],
)
def test_units_of_results(type_: str, value: str, tmp_path: Path) -> None:
    initial = "0 s" if type_ == "duration" else f"0 {type_.partition(' in ')[2]}"
    assert system(tmp_path, type=type_, initial=initial, value=value)[1] == []


@pytest.mark.parametrize(
    ("guard", "help_"),
    [
        ("x > 3", "write `3 m`"),
        ("atan2(x, x) < 1", "write `1 rad`"),
        ("v > 3 m", "write a number in `km/h`"),
        ("x + d > x", "divided by its unit it is a plain number: `d / 1 s`"),
        ("sin(0.5) > 0", "write `0.5 rad`"),
        ("x > n", "give it a unit: `n * 1 m`, or declare it `in m`"),
    ],
)
def test_a_wrong_unit_has_a_way_out(guard: str, help_: str, tmp_path: Path) -> None:
    assert system(tmp_path, guard=guard)[1] == [("SW0621", help_)]


def test_a_declaration_keeps_its_unit(tmp_path: Path) -> None:
    made, _ = system(tmp_path)
    assert made is not None
    (machine,) = made.machines
    params = {each.name: each for each in machine.params}
    assert unit_name(params["v"].type) == "km/h"
    assert params["v"].default == Literal(10.0, FLOAT)
    assert expression(Literal(10.0, with_unit(FLOAT, UNITS["km/h"]))) == "36 km/h"


def test_a_guard_in_seconds_is_compared_with_a_duration(tmp_path: Path) -> None:
    guard = "seconds(d) < 3 s or value > 120 s and value < 1 min"
    made, found = system(tmp_path, type="float64 in s", initial="0 s", value="d", guard=guard)
    assert made is not None, found


FIELDS = """package lab

message Price {{
  cost  : float64 in s
  whole : int32 in s
  plain : float64
}}
struct Bid {{ cost : float64 in s }}
struct Offer {{ bid : Bid }}
action Act {{ goal {{ rest : float64 in s }} }}
function act : abstraction {{ action "act" : Act }}
sensor Cam {{ operation take(in exposure : float64 in s) }}
event Go   : std_msgs/Empty
event Told : Price
statemachine M {{
  var d    : duration = 3 s
  var bid  : Bid
  var best : Offer
  initial A
  state A {{
    do act(rest = {value})
    on Go / bid = Bid(cost = {value}), best = Offer(bid = Bid(cost = {value})) -> A
    on succeeded / send Told(cost = {value}, whole = 2 s, plain = {plain}) -> B
    on aborted -> C
  }}
  state B {{ on Go [bid.cost + best.bid.cost + 1 s > seconds(d)] -> C }}
  final C
}}
statemachine Eye {{
  initial A
  state A {{
    do Cam.take(exposure = 20 ms)
    on succeeded -> B
    on aborted -> B
  }}
  final B
}}
member Robot {{
  behavior M
  cam : Cam
}}
member Watcher {{
  behavior Eye
  cam : Cam
}}
"""


@pytest.mark.parametrize(
    ("value", "printed"),
    [("1500 ms", "1.5 s"), ("d + 1 s", "d + 1 s"), ("seconds(d)", "seconds(d)")],
)
def test_a_duration_is_a_number_in_a_field(value: str, printed: str, tmp_path: Path) -> None:
    file = tmp_path / "model.swarm"
    file.write_text(FIELDS.format(value=value, plain="1.0"), encoding="utf-8")
    made = pipeline.check([file]).system
    assert made is not None
    machine, eye = made.machines
    (state,) = (each for each in machine.states if each.id == "A")
    (looking,) = (each for each in eye.states if each.id == "A")

    def text(fields: tuple[tuple[str, Expression], ...]) -> dict[str, str]:
        return {name: expression(given) for name, given in fields}

    assert state.activity is not None
    assert looking.activity is not None
    assert text(state.activity.arguments) == {"rest": printed}
    assert text(looking.activity.arguments) == {"exposure": "0.02 s"}
    go, succeeded, _ = state.transitions
    rest = dict(state.activity.arguments)["rest"]
    assert unit_name(rest.type) == "s"
    assert isinstance(rest, Literal) or (isinstance(rest, Binary) and rest.operator == "/")
    (told,) = succeeded.effects
    assert isinstance(told, Send)
    assert text(told.arguments) == {"cost": printed, "whole": "2 s", "plain": "1.0"}
    shown = [expression(each.value) for each in go.effects if isinstance(each, Assignment)]
    assert shown == [f"Bid(cost = {printed})", f"Offer(bid = Bid(cost = {printed}))"]


def test_a_wrong_value_of_a_field_is_told_its_unit(tmp_path: Path) -> None:
    file = tmp_path / "model.swarm"
    file.write_text(FIELDS.format(value="true", plain="1 s"), encoding="utf-8")
    found = [(each.message, each.help) for each in pipeline.check([file]).report]
    wrong = ("expected `float64 in s`, found `bool`", None)
    assert found[:3] == [wrong] * 3
    assert wrong in found[3:]
    plain = ("expected `float64`, found `duration`", "`seconds(1 s)` is a number in `s`")
    assert plain in found


def test_a_unit_exists_and_is_that_of_a_number(tmp_path: Path) -> None:
    assert system(tmp_path, type="string in m", initial='""', value='""')[1][0][0] == "SW0621"
    assert system(tmp_path, type="float64 in metres", value="0")[1][0] == ("SW0202", "write `m`")


@pytest.mark.parametrize(
    ("unit", "code"), [("", None), (" in m", None), (" in s", "SW0621")], ids=("none", "m", "s")
)
def test_arguments_of_models_take_fields_of_goals(
    unit: str, code: str | None, tmp_path: Path
) -> None:
    """A field without a unit is a number of ROS that may have any unit."""
    file = tmp_path / "model.swarm"
    file.write_text(
        f"action lab_msgs/Sweep {{ goal {{ altitude : float64{unit} }} }}\n"
        'function sweep : swarm {\n  action "sweep" : lab_msgs/Sweep\n'
        "  model coverage(height = altitude)\n}\n",
        encoding="utf-8",
    )
    found = [each.code for each in pipeline.check([file]).report if each.severity is Severity.ERROR]
    assert found == ([code] if code else [])
