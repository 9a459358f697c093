"""Params of machines as parameters of ROS, and the values that members give them."""

from __future__ import annotations

from collections.abc import Mapping

from swarmdsl.diagnostics import Diagnostics
from swarmdsl.exchange.constants import Value, constant, params_by_name
from swarmdsl.ir import Array, Expression, Param, Primitive, StateMachine
from swarmdsl.ir.types import FLOATS
from swarmdsl.python_source import Call
from swarmdsl.source import Span

from .names import TARGET

_GREATEST = 2**63 - 1
"""What a whole number in a parameter of ROS 2 may be."""
_FLOATS = (*FLOATS, "duration")


def parameters(machine: StateMachine, report: Diagnostics) -> list[tuple[Param, Call]]:
    """How each param of a machine is declared."""
    found = []
    known = params_by_name(machine.params)
    for param in machine.params:
        element = param.type.element if isinstance(param.type, Array) else param.type
        if not isinstance(element, Primitive) or element.name == "time":
            _unsupported(f"a param of type `{param.type}`", param.origin, report)
            continue
        arguments: list[object] = [param.name, _type(param, element)]
        default = param.default if param.default is not None else param.declared
        if default is not None:
            value = _value(param, default, known, report)
            if value is None:
                what = "a param whose value is not known in advance"
                _unsupported(what, param.origin, report)
            arguments.append(value)
        doc = " ".join(param.doc.split())
        keywords = (("doc", doc),) if doc else ()
        found.append((param, Call("Parameter", tuple(arguments), keywords)))
    return found


def _value(
    param: Param, given: Expression, known: Mapping[str, Param], report: Diagnostics
) -> Value | None:
    """A value as ROS takes it for the param: a number of a float has a point."""
    value = constant(given, known)
    if isinstance(param.type, Primitive) and param.type.name in _FLOATS and value is not None:
        return float(value)
    if isinstance(value, int) and value > _GREATEST:
        what = f"a param of {value}, more than a parameter holds"
        way_out = f"a whole number in a parameter of ROS 2 is at most {_GREATEST}"
        _unsupported(what, given.origin or param.origin, report, way_out)
    return value


def given(
    machine: StateMachine,
    params: tuple[Param, ...],
    values: Mapping[str, Expression],
    around: tuple[Param, ...],
    report: Diagnostics,
) -> Mapping[str, Value]:
    """What whoever runs a machine says of its params: by params of its own, as a part by `values`.

    In the values of a part, params of the member can be meant, `around`.
    """
    wanted = params_by_name(machine.params)
    own, outer = params_by_name(params), params_by_name(around)
    found = {param.name: (param.default, own) for param in params if param.default is not None}
    found |= {name: (value, outer) for name, value in values.items()}
    read = {
        name: _value(wanted[name], value, known, report)
        for name, (value, known) in found.items()
        if name in wanted
    }
    return {name: value for name, value in read.items() if value is not None}


def _type(param: Param, element: Primitive) -> str:
    return f"{element.name}[]" if isinstance(param.type, Array) else element.name


def _unsupported(
    construct: str, at: Span | None, report: Diagnostics, way_out: str | None = None
) -> None:
    report.report("unsupported-construct", at, target=TARGET, construct=construct, help=way_out)
