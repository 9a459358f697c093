"""Types of expressions and their compatibility."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from swarmdsl.analysis.resolve.interfaces import Interfaces
from swarmdsl.analysis.types import Typing, assignable, constant, fits
from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.project.loader import Project
from swarmdsl.syntax.ast import Assignment, Expression, ExpressionTree, walk
from swarmdsl.syntax.types import Array, Named, Primitive, Type

Typed = Callable[[str], tuple[ExpressionTree, Typing]]
BOOL, INT, FLOAT = Primitive("bool"), Primitive("int64"), Primitive("float64")
TEXT, DURATION = Primitive("string"), Primitive("duration")
POSE = Named("geometry_msgs", "Pose")


@pytest.fixture
def typed(linked: Callable[..., Project]) -> Typed:
    """Return a function that types an expression in a machine with variables of all types."""

    def expression(text: str) -> tuple[ExpressionTree, Typing]:
        project = linked(f"""
          message Status {{ level : float32, pose : geometry_msgs/Pose, path : float64[3] }}
          event Low : Status
          statemachine M {{
            param p : float64 = 1.0
            var i : int32; var u : uint8; var f : float32; var b : bool; var s : string
            var d : duration; var m : Status; var e : other_msgs/Pose
            var a : float64[]; var t : time
            initial A
            state A {{ on Low / i = {text} -> F }}
            final F
          }}
        """)
        (assignment,) = [n for n in walk(project.files[0].model) if isinstance(n, Assignment)]
        assert isinstance(assignment.value, Expression)
        assert assignment.value.tree is not None
        interfaces = Interfaces(project.declarations())
        status = Named("main", "Status")
        typing = Typing(interfaces, Diagnostics(), has_event=True, event=status)
        return assignment.value.tree, typing

    return expression


def infer(typed: Typed, text: str) -> tuple[Type | None, list[str]]:
    tree, typing = typed(text)
    return typing.infer(tree), [found.name for found in typing.report]


@pytest.mark.parametrize(
    ("text", "type_"),
    [
        *(("1", INT), ("1.5", FLOAT), ("1e3", FLOAT), ('"x"', TEXT), ("true", BOOL)),
        *(("3 s", DURATION), ("3.5 ms", DURATION), ("-3 s", DURATION), ("3 s - 1 min", DURATION)),
        *(("2 * 3 s", DURATION), ("3 s / 2", DURATION), ("3 s / 2 s", FLOAT), ("3 s < d", BOOL)),
        *(("1 + 2", INT), ("i + 1", INT), ("i + 1.5", FLOAT), ("7 / 2", FLOAT), ("7 % 2", INT)),
        *(("i < f", BOOL), ("not b", BOOL), ("b and i == 3", BOOL), ('s == "x"', BOOL)),
        *(("-i", Primitive("int32")), ('s + "x"', TEXT), ("p * 2", FLOAT)),
        *(("min(1, 2, 3)", INT), ("max(1, 2.5)", FLOAT), ("abs(-1)", INT), ("sqrt(2)", FLOAT)),
        *(("t == t", BOOL), ("t != t", BOOL), ("d != 3 s", BOOL)),
        *(("div(i, 2)", INT), ("int(f)", INT), ("round(2)", INT), ("floor(p)", INT)),
        *(("ceil(f)", INT), ("float(u)", FLOAT), ("clamp(i, 0, 3)", INT)),
        *(("clamp(i, 0, 1.5)", FLOAT), ("clamp(d, 1 s, 2 s)", DURATION), ("hypot(i, 2, f)", FLOAT)),
        *(("atan2(i, f)", FLOAT), ("sin(i * 1 rad)", FLOAT), ("cos(1 rad)", FLOAT)),
        *(("distance(m.pose, event.pose.position)", FLOAT), ("distance(e, m.pose)", FLOAT)),
        *(("len(s)", INT), ("len(a)", INT), ("min(1 s, d)", DURATION)),
        *(("m.level", Primitive("float32")), ("m.pose", POSE), ("m.path", Array(FLOAT, 3))),
        *(("event.level", Primitive("float32")), ("event", Named("main", "Status"))),
        # Fields of messages that the model does not describe are unknown.
        *(("e.position", None), ("e.position.x + 1", None), ("e.x < 3", BOOL)),
    ],
)
def test_types(typed: Typed, text: str, type_: Type | None) -> None:
    assert infer(typed, text) == (type_, [])


@pytest.mark.parametrize(
    ("text", "names"),
    [
        ("s < 3", ["bad-operand"]),
        ("s - s", ["bad-operand"]),
        ("d * d", ["bad-operand"]),
        ("1 + d", ["bad-operand"]),
        ("b + 1", ["bad-operand"]),
        ("not i", ["bad-operand"]),
        ("i and b", ["bad-operand"]),
        ("s == 1", ["bad-operand"]),
        ("d == 1", ["bad-operand"]),
        ("m == m", ["bad-operand"]),
        ("m.pose != m.pose", ["bad-operand"]),
        ("a == a", ["bad-operand"]),
        ("t < t", ["bad-operand"]),
        ("t - t", ["bad-operand"]),
        ("t == d", ["bad-operand"]),
        ("i / 0", ["no-result"]),
        ("s / 0", ["bad-operand"]),
        ("e.x % (1 - 1)", ["no-result"]),
        ("sqrt(-1.0) + sqrt(0 - 4)", ["no-result", "no-result"]),
        ("-(1e308 * 10) + 1", ["no-result"]),
        ("2147483647 * 4294967296 * 2", []),
        ("9223372036854775807 * 3", ["no-result"]),
        ("-18446744073709551615", ["no-result"]),
        ("d == 2000000 h * 2", ["no-result"]),
        ("1 / 0 > 1 or b", ["no-result"]),
        ("len(i)", ["bad-operand"]),
        ("min(1)", ["bad-operand"]),
        ("sqrt(1, 2)", ["bad-operand"]),
        ("m.name", ["unknown-field"]),
        ("i.name", ["unknown-field"]),
        ("fabs(1.5)", ["unresolved-name"]),
        ("i + s == s", ["bad-operand"]),
        ("-s + 1", ["bad-operand"]),
        ("abs(s) + s", ["bad-operand"]),
        ("(s < 3) and (i + s > 1)", ["bad-operand", "bad-operand"]),
    ],
)
def test_mistakes_are_reported_once(typed: Typed, text: str, names: list[str]) -> None:
    assert infer(typed, text)[1] == names


@pytest.mark.parametrize(
    ("found", "expected", "fine"),
    [
        (INT, FLOAT, True),
        (FLOAT, INT, False),
        (INT, Primitive("uint8"), True),
        (Primitive("float32"), FLOAT, True),
        (TEXT, INT, False),
        (INT, DURATION, False),
        (None, TEXT, True),
        (TEXT, None, True),
        (Array(INT, 3), Array(INT), True),
        (Array(INT), Array(INT, 3), False),
        (Array(INT, 2), Array(INT, 3), False),
        (Array(INT, 3), Array(INT, 3, bounded=True), True),
        (Array(INT, 2, bounded=True), Array(INT, 3, bounded=True), True),
        (Array(INT, 4, bounded=True), Array(INT, 3, bounded=True), False),
        (Array(INT, 3, bounded=True), Array(INT, 3), False),
        (Array(INT, 3, bounded=True), Array(INT), True),
        (Array(INT), Array(INT, 3, bounded=True), False),
        (Primitive("string"), Primitive("string", 3), True),
        (Array(TEXT, 3), Array(INT, 3), False),
        (POSE, POSE, True),
        (POSE, Named("geometry_msgs", "Point"), False),
    ],
)
def test_fits(found: Type | None, expected: Type | None, fine: bool) -> None:
    assert fits(found, expected) is fine


@pytest.mark.parametrize(
    ("text", "is_constant", "is_assignable"),
    [
        ("1 + 2 * min(3, 4)", True, False),
        ("i", False, True),
        ("m.level", False, True),
        ("p", False, False),
        ("event.level", False, False),
        ("1 + i", False, False),
        ("len(a)", False, False),
    ],
)
def test_constants_and_places(
    typed: Typed, text: str, is_constant: bool, is_assignable: bool
) -> None:
    tree, _ = typed(text)

    assert constant(tree) is is_constant
    assert assignable(tree) is is_assignable
