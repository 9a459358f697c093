"""Values of the model as ROS parameters."""

from __future__ import annotations

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.records import replace
from swarmdsl.base.source import Span
from swarmdsl.codegen.shared.constants import Value
from swarmdsl.codegen.shared.nodes import BehaviorNode, ParamValue
from swarmdsl.ir import Primitive, Type
from swarmdsl.syntax.types import FLOATS

_BITS = {1: 32, 2: 64}
"""Of a whole number, by the generation of ROS: XML-RPC has less of them."""
_REAL = (*FLOATS, "duration")


def parameter_value(
    value: Value, type_: Type, ros: int, at: Span | None, target: str, report: Diagnostics
) -> Value:
    """Return a value as a parameter of that type; numbers of real types become floats.

    An integer that is too large for this generation of ROS is reported at `at`.
    """
    if isinstance(type_, Primitive) and type_.name in _REAL and isinstance(value, int):
        return float(value)
    greatest = 2 ** (_BITS[ros] - 1) - 1
    if isinstance(value, int) and not -greatest - 1 <= value <= greatest:
        bound = f"at least {-greatest - 1}" if value < 0 else f"at most {greatest}"
        way_out = f"an integer parameter of ROS {ros} is {bound}"
        construct = f"a param of {value}"
        report.report("unsupported-construct", at, target=target, construct=construct, help=way_out)
    return value


def with_parameters(node: BehaviorNode, ros: int, target: str, report: Diagnostics) -> BehaviorNode:
    """Return a node with its params converted to ROS parameters."""

    def held(given: ParamValue) -> ParamValue:
        if given.value is None or given.expression is None:
            return given
        at = given.expression.origin
        value = parameter_value(given.value, given.param.type, ros, at, target, report)
        return replace(given, value=value)

    return replace(node, params=tuple(map(held, node.params)))
