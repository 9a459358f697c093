"""Expressions in C++ (C++11 and later), for roscpp and rclcpp.

The code needs `<algorithm>`, `<cmath>` and `<string>`. Numbers behave as in the language:
`/` is the division of real numbers, `%` has the sign of the divisor. Integers that a division or
a rounding makes are whole numbers in a `double`.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import reduce

from swarmdsl.ir import EnvelopeField, Literal
from swarmdsl.ir.expression_printer import Dialect, differences
from swarmdsl.syntax.types import DURATION

_MODULO = (
    "[](double a, double b) {{ const double r = std::fmod(a, b); "
    "return r != 0 && (r < 0) != (b < 0) ? r + b : r; }}({}, {})"
)
_LARGEST_INT = 2**31 - 1


def dialect(
    variable: Callable[[str], str],
    param: Callable[[str], str],
    event: str,
    envelope: Callable[[EnvelopeField], str],
    identity: Callable[[str], str],
) -> Dialect:
    """Return the dialect, given the event and the printers of values that it does not have."""
    return Dialect(
        literal=literal,
        variable=variable,
        param=param,
        event=event,
        envelope=envelope,
        identity=identity,
        operators={"and": "&&", "or": "||", "not": "!"},
        functions={
            "sqrt": "std::sqrt",
            "abs": "std::abs",
            "len": ".size()",
            "min": lambda values: _extreme("min", values),
            "max": lambda values: _extreme("max", values),
            "int": "std::trunc",
            "float": "static_cast<double>",
            # Halves go to the even neighbour, in the mode in which every program starts.
            "round": "std::nearbyint",
            "floor": "std::floor",
            "ceil": "std::ceil",
            "clamp": _clamped,
            "hypot": _length,
            "sin": "std::sin",
            "cos": "std::cos",
            "atan2": lambda values: "std::atan2({} + 0.0, {} + 0.0)".format(*values),
            "distance": lambda values: _length(differences(values).split(", ")),
        },
        modulo=_MODULO.format,
        division="std::floor(static_cast<double>({}) / {})".format,
        quotient="static_cast<double>({}) / {}".format,
    )


def comment_line(text: str) -> str:
    """Return a line that can end a comment: one that ends in a backslash would go on."""
    return f"{text} ." if text.endswith(("\\", "??/")) else text


def literal(value: Literal) -> str:
    """Return a C++ literal; durations in seconds, as in `ros::Duration`."""
    if value.type == DURATION:
        return repr(value.milliseconds / 1000)
    match value.value:
        case bool() as truth:
            return "true" if truth else "false"
        case int() as number:
            return f"{number}LL" if abs(number) > _LARGEST_INT else str(number)
        case float() as number:
            return repr(number)
        case str() as text:
            return f'std::string("{"".join(map(_character, text))}")'


def _character(character: str) -> str:
    if character in '"\\?':  # `??/` would be a trigraph
        return f"\\{character}"
    # An octal escape ends after three digits; a hexadecimal one would include what follows.
    return (
        character if character.isprintable() else "".join(f"\\{b:03o}" for b in character.encode())
    )


def _clamped(values: Sequence[str]) -> str:
    value, low, high = values
    return _extreme("min", [_extreme("max", [value, low]), high])


def _length(values: Sequence[str]) -> str:
    """Return the length of a vector: three arguments of `hypot` need C++17."""
    return reduce("std::hypot({}, {})".format, values)


def _extreme(name: str, values: Sequence[str]) -> str:
    """Return the minimum or maximum of values cast to double, so that types agree."""
    numbers = ", ".join(f"static_cast<double>({value})" for value in values)
    return f"std::{name}({{{numbers}}})"
