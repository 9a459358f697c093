"""Built-in functions of expressions: their parameters and what they are for."""

from __future__ import annotations

from collections.abc import Mapping

from swarmdsl.analysis.types.unit_rules import NUMBER_OF_SECONDS
from swarmdsl.base.records import dataclass
from swarmdsl.syntax.ast import NEIGHBORS
from swarmdsl.syntax.types import BOOL, DURATION, FLOAT, INT, Primitive, Type, with_unit, written
from swarmdsl.syntax.units import RADIAN


@dataclass(frozen=True)
class BuiltIn:
    """Function with its parameters; `more` allows further ones of the last kind.

    `result` is None if it has the type of the arguments. The last `optional` ones can be left out.
    """

    parameters: tuple[str, ...]
    result: Type | None
    doc: str
    more: bool = False
    optional: int = 0

    def signature(self, name: str) -> str:
        """Return the declaration, as the reference shows it."""
        more = ", ..." if self.more else ""
        if name == NEIGHBORS:
            return f"{name} {self.parameters[0]} : {written(self.result)}"
        result = f" : {written(self.result)}" if self.result is not None else ""
        return f"{name}({', '.join(self.parameters)}{more}){result}"


_X = ("x",)
_PAIR = ("a", "b")

BUILT_INS: Mapping[str, BuiltIn] = {
    "min": BuiltIn(_PAIR, None, "The least of numbers or durations.", more=True),
    "max": BuiltIn(_PAIR, None, "The greatest of numbers or durations.", more=True),
    "clamp": BuiltIn(
        ("x", "low", "high"),
        None,
        "A number or duration, kept between two: min(max(x, low), high).",
    ),
    "abs": BuiltIn(_X, None, "A number or duration without its sign."),
    "div": BuiltIn(_PAIR, INT, "The quotient of two integers, rounded down."),
    "int": BuiltIn(_X, INT, "A number, rounded towards 0."),
    "round": BuiltIn(_X, INT, "The nearest integer; of two, the even one."),
    "floor": BuiltIn(_X, INT, "A number, rounded down."),
    "ceil": BuiltIn(_X, INT, "A number, rounded up."),
    "float": BuiltIn(_X, FLOAT, "A number as a floating-point number."),
    "sqrt": BuiltIn(_X, FLOAT, "The square root."),
    "hypot": BuiltIn(("x", "y"), FLOAT, "The square root of the sum of squares.", more=True),
    "seconds": BuiltIn(("d",), NUMBER_OF_SECONDS, "A duration as a number in `s`."),
    "sin": BuiltIn(_X, FLOAT, "The sine of an angle in `rad`."),
    "cos": BuiltIn(_X, FLOAT, "The cosine of an angle in `rad`."),
    "atan2": BuiltIn(
        ("y", "x"), with_unit(FLOAT, RADIAN), "The angle of the direction (x, y), from -π to π."
    ),
    "distance": BuiltIn(_PAIR, FLOAT, "The distance of two messages with `x`, `y`, perhaps `z`."),
    "len": BuiltIn(_X, INT, "The length of a string or array."),
    "elapsed": BuiltIn(
        ("state",),
        DURATION,
        "For how long this state has been active, or one around it.",
        optional=1,
    ),
    "present": BuiltIn(
        ("role",),
        Primitive("int32"),
        "The number of robots of a role, or of the swarm, that are there.",
        optional=1,
    ),
    NEIGHBORS: BuiltIn(
        ("distance",),
        Primitive("int32"),
        "The number of other robots of the swarm within a distance, now.",
    ),
    "contains": BuiltIn(("array", "x"), BOOL, "True if an item of an array equals `x`."),
}
