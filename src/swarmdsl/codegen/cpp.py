"""Expressions in C++ (C++11 and later): what roscpp and rclcpp code can hold.

Needs `<algorithm>`, `<cmath>` and `<string>`. Numbers are computed as in the language:
`/` is the division of real numbers, `%` has the sign of the divisor.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from swarmdsl.ir import Literal
from swarmdsl.ir.expression_printer import Dialect
from swarmdsl.syntax.types import DURATION

_MODULO = (
    "[](double a, double b) {{ const double r = std::fmod(a, b); "
    "return r != 0 && (r < 0) != (b < 0) ? r + b : r; }}({}, {})"
)
_LARGEST_INT = 2**31 - 1


def dialect(variable: Callable[[str], str], param: Callable[[str], str], event: str) -> Dialect:
    """How expressions are written, given the texts for variables, params and the event."""
    return Dialect(
        literal=literal,
        variable=variable,
        param=param,
        event=event,
        operators={"and": "&&", "or": "||", "not": "!"},
        functions={
            "sqrt": "std::sqrt",
            "abs": "std::abs",
            "len": ".size()",
            "min": lambda values: _extreme("min", values),
            "max": lambda values: _extreme("max", values),
        },
        modulo=_MODULO.format,
        quotient="static_cast<double>({}) / {}".format,
    )


def literal(value: Literal) -> str:
    """A literal; a duration in seconds, as `ros::Duration` takes it."""
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
    # Octal ends after three digits; a hexadecimal escape would take what follows it too.
    return (
        character if character.isprintable() else "".join(f"\\{b:03o}" for b in character.encode())
    )


def _extreme(name: str, values: Sequence[str]) -> str:
    """The least or greatest of several: real numbers, so that they are of one type."""
    numbers = ", ".join(f"static_cast<double>({value})" for value in values)
    return f"std::{name}({{{numbers}}})"
