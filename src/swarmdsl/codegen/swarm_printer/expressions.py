"""Print expressions in the language."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import isfinite
from typing import Any, TypeVar, cast

from swarmdsl.base.records import fields_of, replace
from swarmdsl.base.source import Span
from swarmdsl.codegen.swarm_printer.layout import UnprintableError, quoted
from swarmdsl.ir import Array, Expression, Literal, Named, Primitive, VariableRef
from swarmdsl.ir.expression_printer import (
    MODEL_FUNCTIONS,
    Dialect,
    envelope_name,
    points,
    translate,
)
from swarmdsl.syntax.parser.literals import UNITS
from swarmdsl.syntax.types import DURATION, declared_unit
from swarmdsl.syntax.units import written_in

T = TypeVar("T")


def expression(value: Expression, named: Callable[[str], str] = str) -> str:
    """Return an expression with minimal parentheses; `named` prints names."""
    functions = {**MODEL_FUNCTIONS, "distance": _distance}
    identity = "self.{}".format
    dialect = Dialect(_literal, named, named, "event", envelope_name, identity, {}, functions)
    return translate(value, replace(dialect, seconds="seconds({})".format))


def with_names(node: T) -> T:
    """Return a node of the IR in which values with a name in the model are printed as that name."""
    if isinstance(node, Literal):
        return cast("T", VariableRef(node.name, node.type)) if node.name else node
    if isinstance(node, tuple):
        return cast("T", tuple(map(with_names, node)))
    if isinstance(node, (Primitive, Named, Array, Span)) or not _is_record(node):
        return node
    changed = {name: with_names(getattr(node, name)) for name in fields_of(type(node))}
    return cast("T", replace(cast("Any", node), **changed))


def _is_record(value: object) -> bool:
    """Return True for a dataclass; its module is slow to import."""
    return "__parts__" in vars(type(value))


def _distance(coordinates: Sequence[str]) -> str:
    """Return the distance of two points."""
    first, second, _ = points(coordinates)
    return f"distance({first}, {second})"


def delay(value: Expression) -> str:
    """Return an expression after `after`, where a `/` would begin the effects."""
    text = expression(value)
    return f"({text})" if "/" in text or "%" in text else text


def default(value: Expression | None) -> str:
    """Return ` = value`, or nothing."""
    return "" if value is None else f" = {expression(value)}"


def _literal(literal: Literal) -> str:
    match literal.value:
        case bool():
            return "true" if literal.value else "false"
        case int() if literal.type == DURATION:
            return duration(literal.value)
        case float() if not isfinite(literal.value):
            raise UnprintableError(f"{literal.value} is not a number that can be written")
        case str():
            return quoted(literal.value)
        case value if (unit := declared_unit(literal.type)) is not None:
            return written_in(value, unit)
        case value:
            return repr(value)


def duration(nanoseconds: int) -> str:
    """Return a duration in the longest unit that divides it, else in `us`."""
    if nanoseconds < 0:
        return f"-{duration(-nanoseconds)}"
    if nanoseconds == 0:
        return "0 s"
    for unit, length in sorted(UNITS.items(), key=lambda item: -item[1]):
        if nanoseconds % length == 0:
            return f"{nanoseconds // length} {unit}"
    whole, rest = divmod(nanoseconds, UNITS["us"])
    return f"{whole}.{rest:03}".rstrip("0") + " us"
