"""Compare values of params and constants and print them for a type."""

from __future__ import annotations

from swarmdsl.analysis.types.constant_folding import Folded, Folding
from swarmdsl.analysis.types.fitting import is_float, is_number, is_text, range_of
from swarmdsl.base.records import dataclass
from swarmdsl.base.source import Span
from swarmdsl.codegen.swarm_printer.expressions import expression
from swarmdsl.ir import Literal
from swarmdsl.syntax.ast import Constant, OperatorUse, Param, Value
from swarmdsl.syntax.types import DURATION, FLOAT, INT, Named, Primitive, Type

_NANOSECONDS = 1_000_000_000


@dataclass(frozen=True)
class DefaultChange:
    """Change of a param.

    `type` is the span of the type and its replacement; `place` is the span of the value, empty if
    there is none. `computed` is True if the value is an expression.
    """

    place: Span
    value: str | None
    type: tuple[Span, str] | None
    computed: bool


def default_change(
    old: Param | Constant, new: Param | Constant, folding: Folding
) -> DefaultChange | None:
    """Change that gives an old param the value of a new one; None if they are equal.

    A chosen number type stays as long as the value fits. A duration without unit is in seconds, as
    in ROS.
    """
    tree = new.default.tree if isinstance(new, Param) and new.default else None
    if isinstance(new, Constant):
        tree = new.value.tree
    value = folding.value(tree) if tree is not None else None
    known = old.value if isinstance(old, Constant) else old.default
    before = folding.value(known.tree) if known is not None and known.tree is not None else None
    type_ = old.type.type
    changed = None
    if not _holds(type_, new.type.type, value):
        changed, type_ = (old.type.span, new.type.span.text), new.type.type
    if type_ == DURATION != new.type.type and value is not None:
        assert not isinstance(value, str)
        value = round(value * _NANOSECONDS)
    if value == before and isinstance(value, bool) == isinstance(before, bool):
        value = None
    if changed is None and value is None:
        return None
    end = old.type.span.end
    place = known.span if known is not None else Span(old.type.span.source, end, end)
    computed = known is not None and not _is_literal(known.tree)
    return DefaultChange(place, _text(value, type_), changed, computed and value is not None)


def _holds(old: Type | None, new: Type | None, value: Folded | None) -> bool:
    """Return True if a type can stay although another one is imported."""
    if old == new or old is None:
        return True
    if is_text(old) and is_text(new):
        bound = old.bound if isinstance(old, Primitive) else None
        return bound is None or not isinstance(value, str) or len(value) <= bound
    if not is_number(new) or isinstance(value, (bool, str)):
        return False
    if value is None or is_float(old) or isinstance(old, Named):
        return is_number(old) or isinstance(old, Named) or old == DURATION
    if old == DURATION:
        return abs(value * _NANOSECONDS) < 2**63
    return is_number(old) and value == int(value) and int(value) in (range_of(old) or range(2**8))


def _text(value: Folded | None, type_: Type | None) -> str | None:
    """Text of a value for a type."""
    if value is None:
        return None
    if type_ == DURATION:
        return expression(Literal(value, DURATION))
    if isinstance(value, float) and not is_float(type_):
        return expression(Literal(int(value), INT))
    return expression(Literal(value, FLOAT))


def _is_literal(tree: object) -> bool:
    if isinstance(tree, OperatorUse) and len(tree.operands) == 1:
        return _is_literal(tree.operands[0])
    return isinstance(tree, Value)
