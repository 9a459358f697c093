"""Params of functions and components as ROS parameters, with values of the model."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from swarmdsl.codegen import Diagnostics, Span, dataclass
from swarmdsl.codegen.ros import parameter_value
from swarmdsl.codegen.shared import Value, constant, doc_with_unit, params_by_name
from swarmdsl.ir import Array, Expression, Param, Primitive

from .names import TARGET, identifiers


@dataclass(frozen=True)
class Setting:
    """A ROS parameter; `key` is its name in ROS, `default` None if a value is required."""

    name: str
    key: str
    type: Primitive | Array
    default: Value | None
    doc: str
    origin: Span | None


def settings_of(params: tuple[Param, ...], ros: int, report: Diagnostics) -> Iterator[Setting]:
    """Return the parameters of a node."""
    known = params_by_name(params)
    for param, name in zip(params, identifiers(param.name for param in params), strict=True):
        type_ = param.type
        element = type_.element if isinstance(type_, Array) else type_
        if not isinstance(element, Primitive) or element.name in ("time", "wstring"):
            _unsupported(f"a param of type `{type_}`", param.origin, report)
            continue
        assert isinstance(type_, (Primitive, Array))
        value = None
        if param.default is not None:
            value = value_of(param.default, type_, known, ros, report)
            if value is None:
                _unsupported("a default that is not constant", param.origin, report)
        doc = doc_with_unit(param.doc, type_)
        yield Setting(name, param.name, type_, value, doc, param.origin)


def value_of(
    given: Expression,
    type_: Primitive | Array,
    known: Mapping[str, Param],
    ros: int,
    report: Diagnostics,
) -> Value | None:
    """Return a value of the model as a parameter value; None if it is not constant."""
    value = constant(given, known)
    if value is None:
        return None
    return parameter_value(value, type_, ros, given.origin, TARGET, report)


def _unsupported(construct: str, at: Span | None, report: Diagnostics) -> None:
    report.report("unsupported-construct", at, target=TARGET, construct=construct)
