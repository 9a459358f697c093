"""Expressions have the same value in the language, Python, C++ and ECMAScript."""

from __future__ import annotations

import json
import math
import operator
import shutil
import subprocess
from fractions import Fraction
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from swarmdsl.codegen import cpp
from swarmdsl.codegen.exchange.scxml import ecmascript
from swarmdsl.codegen.shared import constants
from swarmdsl.codegen.swarm_printer.expressions import expression
from swarmdsl.execution.engine import Event, ExecutionError
from swarmdsl.execution.scxml.ecmascript import read
from swarmdsl.execution.simulate.machines.expressions import function_of
from swarmdsl.ir import (
    Binary,
    Call,
    EventData,
    Expression,
    FieldAccess,
    Literal,
    Named,
    Unary,
    VariableRef,
)
from swarmdsl.ir.expression_printer import (
    PYTHON_DIVISION,
    PYTHON_FUNCTIONS,
    Dialect,
    python_literal,
    translate,
)
from swarmdsl.syntax.types import BOOL, FLOAT, INT, STRING, Array

PYTHON = Dialect(
    python_literal,
    str,
    str,
    "event",
    "about.{0.field}".format,
    "own.{}".format,
    {},
    PYTHON_FUNCTIONS,
    division=PYTHON_DIVISION,
)
ECMASCRIPT = ecmascript.dialect({"n": "n", "report": "report"})
QUICK = settings(max_examples=100)

REPORT = Named("test", "Report")


def literals(values: st.SearchStrategy[Any], type_: Any) -> st.SearchStrategy[Expression]:
    return values.map(lambda value: Literal(value, type_))


def binary(symbols: str, operands: st.SearchStrategy[Expression], type_: Any) -> Any:
    symbol = st.sampled_from(symbols.split())
    return st.builds(lambda s, x, y: Binary(s, x, y, type_), symbol, operands, operands)


def calls(functions: str, operands: st.SearchStrategy[Expression], count: int) -> Any:
    names = st.sampled_from(functions.split())
    several = st.lists(operands, min_size=count, max_size=count + count // 2)
    return st.builds(lambda name, values: Call(name, tuple(values), FLOAT), names, several)


def negative(operands: st.SearchStrategy[Expression]) -> Any:
    return operands.map(lambda x: Unary("-", x, FLOAT))


WHOLE = literals(st.integers(-40, 40), INT)
WHOLE = st.recursive(
    WHOLE,
    lambda inner: (
        st.builds(lambda x, y: Call("div", (x, y), INT), inner, inner)
        | binary("+ - * %", inner, INT)
        | calls("int round floor ceil", inner, 1)
    ),
    max_leaves=4,
)
# Numbers on which no operation has to round: a remainder of rounded ones would differ.
EXACT = st.recursive(
    WHOLE | literals(st.integers(-16, 16).map(lambda n: n / 4), FLOAT),
    lambda inner: (
        binary("+ - * %", inner, FLOAT)
        | calls("int float round floor ceil", inner, 1)
        | st.builds(lambda *v: Call("clamp", v, FLOAT), inner, inner, inner)
        | negative(inner)
        | calls("min max", inner, 2)
        | calls("abs", inner, 1)
    ),
    max_leaves=8,
)
NUMBERS = st.recursive(
    EXACT,
    lambda inner: (
        binary("+ - * /", inner, FLOAT)
        | negative(inner)
        | calls("min max", inner, 2)
        | calls("abs sqrt", inner, 1)
    ),
    max_leaves=4,
)
CONDITIONS = st.recursive(
    literals(st.booleans(), BOOL) | binary("== != < <= > >=", NUMBERS, BOOL),
    lambda inner: binary("and or == !=", inner, BOOL) | inner.map(lambda x: Unary("not", x, BOOL)),
    max_leaves=6,
)
EXPRESSIONS = NUMBERS | CONDITIONS
LEAVES = st.sampled_from(
    (
        VariableRef("n", INT),
        FieldAccess(VariableRef("report", REPORT), "level", INT),
        FieldAccess(EventData(REPORT), "level", INT),
    )
)


def modulo(left: float, right: float) -> float:
    """Return the remainder with the sign of the divisor."""
    rest = math.fmod(left, right)
    return rest + right if rest and (rest < 0) != (right < 0) else rest


def even(value: float) -> int:
    """Return the nearest integer, the even one of two."""
    below, rest = divmod(Fraction(value), 1)
    return below + (rest > Fraction(1, 2) or (rest == Fraction(1, 2) and below % 2 == 1))


OPERATIONS: dict[str, Any] = {
    "+": operator.add,
    "-": operator.sub,
    "*": operator.mul,
    "/": operator.truediv,
    "==": operator.eq,
    "!=": operator.ne,
    "<": operator.lt,
    "<=": operator.le,
    ">": operator.gt,
    ">=": operator.ge,
    "%": modulo,
    "min": min,
    "max": max,
    "abs": abs,
    "sqrt": math.sqrt,
    "div": lambda x, y: math.floor(Fraction(x) / Fraction(y)),
    "int": math.trunc,
    "float": float,
    "round": even,
    "floor": math.floor,
    "ceil": math.ceil,
    "clamp": lambda x, low, high: high if max(x, low) > high else max(x, low),
}


def value(expression: Expression) -> Any:
    """Return the value that the language gives an expression."""
    match expression:
        case Literal(value=written):
            return written
        case Unary(operator="not", operand=operand):
            return not value(operand)
        case Unary(operand=operand):
            return -value(operand)
        case Binary(operator="and", left=left, right=right):
            return value(left) and value(right)
        case Binary(operator="or", left=left, right=right):
            return value(left) or value(right)
        case Binary(operator=symbol, left=left, right=right):
            return OPERATIONS[symbol](value(left), value(right))
        case Call(function=function, arguments=arguments):
            return OPERATIONS[function](*map(value, arguments))
    raise AssertionError(expression)


def defined_value(expression: Expression) -> Any:
    """Return the value; discard divisions by zero and roots of negative numbers."""
    try:
        return value(expression)
    except (ZeroDivisionError, ValueError):
        assume(False)


def in_node(texts: list[str]) -> list[Any]:
    """Evaluate strings in one JavaScript engine, which is started once."""
    node = shutil.which("node")
    if node is None:
        pytest.skip("no Node: apt-get install nodejs")
    script = """
        const texts = JSON.parse(require("fs").readFileSync(0, "utf8"));
        console.log(JSON.stringify(texts.map((text) => (0, eval)(text))));
    """
    run = subprocess.run(
        [node, "-e", script], input=json.dumps(texts), capture_output=True, text=True, check=True
    )
    values: list[Any] = json.loads(run.stdout)
    return values


@QUICK
@given(EXPRESSIONS)
def test_python_has_the_value_of_the_language(expression: Expression) -> None:
    expected = defined_value(expression)

    text = translate(expression, PYTHON)
    assert eval(text, {"math": math}) == expected, text


@QUICK
@given(EXPRESSIONS)
def test_the_compiler_computes_the_value_of_the_language(expression: Expression) -> None:
    assert constants.constant(expression, {}) == defined_value(expression)


@QUICK
@given(EXPRESSIONS)
def test_the_engine_computes_the_value_of_the_language(expression: Expression) -> None:
    expected = defined_value(expression)

    assert function_of(expression)({}, None) == expected


@QUICK
@given(st.recursive(NUMBERS, lambda inner: binary("and or < + %", inner | LEAVES, FLOAT)))
def test_the_engine_and_python_fail_alike(expression: Expression) -> None:
    data = {"n": 3, "report": {"level": 2}}
    names = {"n": 3, "report": SimpleNamespace(level=2), "math": math}
    try:
        expected = eval(translate(expression, PYTHON), {**names, "event": names["report"]})
    except (ArithmeticError, ValueError) as error:
        with pytest.raises(type(error)):
            function_of(expression)(data, Event("report", data["report"]))
    else:
        assert function_of(expression)(data, Event("report", data["report"])) == expected


def test_ecmascript_has_the_value_of_the_language() -> None:
    expected: dict[str, Any] = {}

    @QUICK
    @given(EXPRESSIONS)
    def collect(expression: Expression) -> None:
        known = defined_value(expression)
        expected[translate(expression, ECMASCRIPT)] = known

    collect()
    found = dict(zip(expected, in_node(list(expected)), strict=True))
    # `True == 1` in Python: only with the types are they the same.
    assert {text: (type(v) is bool, v) for text, v in found.items()} == {
        text: (type(v) is bool, v) for text, v in expected.items()
    }


def in_cpp(texts: list[str], folder: Path) -> list[Any]:
    """Evaluate strings in one C++ program; bool and number differ."""
    compiler = shutil.which("g++")
    if compiler is None:
        pytest.skip("no g++: apt-get install g++")
    lines = "".join(f"  show({text});\n" for text in texts)
    program = folder / "values.cpp"
    program.write_text(
        "#include <algorithm>\n#include <cmath>\n#include <cstdio>\n#include <string>\n"
        'void show(bool value) { std::puts(value ? "true" : "false"); }\n'
        'void show(double value) { std::printf("%.17g\\n", value); }\n'
        "void show(int value) { show(static_cast<double>(value)); }\n"
        "void show(const std::string& value) {\n"
        '  for (unsigned char c : value) std::printf("%02x", c);\n'
        '  std::puts("");\n}\n'
        f"int main() {{\n{lines}  return 0;\n}}\n",
        encoding="utf-8",
    )
    subprocess.run([compiler, "-std=c++11", program, "-o", folder / "values"], check=True)
    run = subprocess.run([folder / "values"], capture_output=True, text=True, check=True)
    return run.stdout.split()


CPP = cpp.dialect(str, str, "event", "about.{0.field}".format, "own.{}".format)


def test_cpp_has_the_value_of_the_language(tmp_path: Path) -> None:
    expected: dict[str, Any] = {}

    @QUICK
    @given(EXPRESSIONS)
    def collect(expression: Expression) -> None:
        expected[translate(expression, CPP)] = defined_value(expression)

    collect()
    found = dict(zip(expected, in_cpp(list(expected), tmp_path), strict=True))
    for text, known in expected.items():
        if isinstance(known, bool):
            assert found[text] == str(known).lower(), text
        else:
            assert float(found[text]) == pytest.approx(known, rel=1e-12), text


def test_texts_in_cpp(tmp_path: Path) -> None:
    texts = ["", 'a "b" \\ c', "\t1\n", "é🚁", "\x017", "%d ??/"]

    written = [cpp.literal(Literal(text, STRING)) for text in texts]
    found = in_cpp([f"{text} + std::string(1, 'x')" for text in written], tmp_path)
    assert [bytes.fromhex(text).decode() for text in found] == [f"{text}x" for text in texts]


@pytest.mark.parametrize(
    ("left", "right", "expected"), [(7, 3, 1), (-7, 3, 2), (7, -3, -2), (-7, -3, -1), (-6, 3, 0)]
)
def test_a_remainder_has_the_sign_of_the_divisor(left: int, right: int, expected: int) -> None:
    expression = Binary("%", Literal(left, INT), Literal(right, INT), INT)

    assert eval(translate(expression, PYTHON)) == expected
    assert in_node([translate(expression, ECMASCRIPT)]) == [expected]


# Numbers near a half, whose sum with a half would be rounded, and beyond the exact ones.
ROUNDED = [
    *((0.5, 0), (1.5, 2), (2.5, 2), (-0.5, 0), (-1.5, -2), (-2.5, -2), (3.5, 4)),
    *((0.49999999999999994, 0), (-0.49999999999999994, 0), (0.5000000000000001, 1)),
    *((2.0**52 + 1, 2**52 + 1), (-(2.0**52) - 1, -(2**52) - 1), (1e300, int(1e300)), (-1e-20, 0)),
]


def test_halves_are_rounded_to_the_even_neighbour(tmp_path: Path) -> None:
    calls = [Call("round", (Literal(value, FLOAT),), INT) for value, _ in ROUNDED]
    expected = [whole for _, whole in ROUNDED]

    assert [function_of(call)({}, None) for call in calls] == expected
    assert [eval(translate(call, PYTHON)) for call in calls] == expected
    assert [value_of_document(translate(call, ECMASCRIPT)) for call in calls] == expected
    assert in_node([translate(call, ECMASCRIPT) for call in calls]) == expected
    assert [*map(float, in_cpp([translate(call, CPP) for call in calls], tmp_path))] == expected


def value_of_document(text: str) -> Any:
    """Return the value of an expression in a document that our engine runs."""
    return read(text)(SimpleNamespace(data={}), None, {})  # type: ignore[arg-type]


ANGLES = st.floats(-1000, 1000, allow_subnormal=False)
POINT = Named("geometry_msgs", "Point")


@given(st.lists(ANGLES, min_size=6, max_size=6))
@settings(max_examples=50)
def test_lengths_and_angles(numbers: list[float]) -> None:
    x, y, *_ = values = [Literal(number, FLOAT) for number in numbers]
    zero = Unary("-", Literal(0, INT), INT)
    calls = [
        *(Call(word, (x,), FLOAT) for word in ("sin", "cos")),
        *(Call("atan2", pair, FLOAT) for pair in ((y, x), (zero, x), (y, zero), (zero, zero))),
        *(Call("hypot", tuple(values[:count]), FLOAT) for count in (2, 3)),
    ]
    a, b, *_ = numbers
    angles = [math.atan2(b, a), math.atan2(0, a + 0.0), math.atan2(b, 0), 0]
    lengths = [math.hypot(*numbers[:count]) for count in (2, 3)]
    # A library may compute these with another last digit.
    expected = pytest.approx([math.sin(a), math.cos(a), *angles, *lengths], rel=1e-9, abs=1e-12)

    assert [function_of(call)({}, None) for call in calls] == expected
    assert [eval(translate(call, PYTHON), {"math": math}) for call in calls] == expected
    assert [value_of_document(translate(call, ECMASCRIPT)) for call in calls] == expected
    assert [constants.constant(call, {}) for call in calls] == expected


def test_lengths_and_angles_in_other_languages(tmp_path: Path) -> None:
    x, y, z = Literal(3.0, FLOAT), Literal(-4.0, FLOAT), Literal(12.0, FLOAT)
    zero = Unary("-", Literal(0, INT), INT)
    calls = [
        *(Call(word, (x,), FLOAT) for word in ("sin", "cos")),
        *(Call("atan2", pair, FLOAT) for pair in ((y, x), (zero, y), (zero, zero))),
        *(Call("hypot", given, FLOAT) for given in ((x, y), (x, y, z))),
    ]
    expected = pytest.approx(
        [math.sin(3), math.cos(3), math.atan2(-4, 3), math.pi, 0, 5, 13], rel=1e-12
    )

    assert in_node([translate(call, ECMASCRIPT) for call in calls]) == expected
    assert [*map(float, in_cpp([translate(call, CPP) for call in calls], tmp_path))] == expected


@pytest.mark.parametrize(("names", "length"), [("xy", 5), ("xyz", 13)])
def test_a_distance(names: str, length: int) -> None:
    here, there = {"x": 1, "y": 2, "z": 3}, {"x": 4, "y": 6, "z": 15}
    data = {"n": here, "report": there}
    call = Call(
        "distance",
        tuple(
            FieldAccess(VariableRef(point, POINT), name, FLOAT) for point in data for name in names
        ),
        FLOAT,
    )
    objects = {name: SimpleNamespace(**point) for name, point in data.items()}

    assert function_of(call)(data, None) == length
    assert eval(translate(call, PYTHON), {"math": math, **objects}) == length
    text = translate(call, ECMASCRIPT)
    assert read(text)(SimpleNamespace(data=data), None, {}) == length  # type: ignore[arg-type]
    head = f"var n = {json.dumps(here)}, report = {json.dumps(there)}; "
    assert in_node([head + text]) == [length]
    assert expression(call) == "distance(n, report)"


@pytest.mark.parametrize(
    ("word", "number"),
    [
        *((word, -math.inf) for word in ("int", "round", "floor", "ceil", "sin", "cos")),
        *((word, math.nan) for word in ("int", "round", "floor", "ceil")),
    ],
)
def test_functions_of_what_is_not_finite_have_no_value(word: str, number: float) -> None:
    call = Call(word, (VariableRef("n", FLOAT),), FLOAT)

    with pytest.raises((ArithmeticError, ValueError)):
        function_of(call)({"n": number}, None)
    with pytest.raises((ArithmeticError, ValueError)):
        eval(translate(call, PYTHON), {"math": math, "n": number})
    with pytest.raises(ExecutionError):
        read(translate(call, ECMASCRIPT))(SimpleNamespace(data={"n": number}), None, {})  # type: ignore[arg-type]


def test_a_division_of_integers_by_zero_has_no_value() -> None:
    call = Call("div", (Literal(7, INT), VariableRef("n", INT)), INT)

    with pytest.raises(ZeroDivisionError):
        function_of(call)({"n": 0}, None)
    with pytest.raises(ZeroDivisionError):
        eval(translate(call, PYTHON), {"n": 0})
    with pytest.raises(ExecutionError):
        read(translate(call, ECMASCRIPT))(SimpleNamespace(data={"n": 0}), None, {})  # type: ignore[arg-type]


@given(st.integers(-(2**53), 2**53), st.integers(-(2**53), 2**53).filter(bool))
def test_a_division_of_integers_and_its_remainder(left: int, right: int) -> None:
    given = Literal(left, INT), Literal(right, INT)
    quotient = function_of(Call("div", given, INT))({}, None)

    assert quotient * right + function_of(Binary("%", *given, INT))({}, None) == left
    assert eval(translate(Call("div", given, INT), PYTHON)) == quotient
    assert value_of_document(translate(Call("div", given, INT), ECMASCRIPT)) == quotient


def test_remainders_of_remainders_stay_short() -> None:
    expression: Expression = VariableRef("n", INT)
    for divisor in range(60):
        expression = Binary("%", Literal(divisor + 2, INT), expression, INT)

    assert len(translate(expression, ECMASCRIPT)) < 10_000


@pytest.mark.parametrize(
    ("expression", "text"),
    [
        (VariableRef("report", REPORT), "JSON.parse(JSON.stringify(report))"),
        (VariableRef("report", Array(INT)), "JSON.parse(JSON.stringify(report))"),
        (EventData(REPORT), "JSON.parse(JSON.stringify(_event.data))"),
        (VariableRef("n", INT), "n"),
        (Binary("+", VariableRef("n", INT), Literal(1, INT), None), "n + 1"),
    ],
)
def test_what_is_stored_is_a_copy(expression: Expression, text: str) -> None:
    assert ecmascript.stored(expression, ECMASCRIPT) == text
