"""Params of machines as parameters of ROS, and the values that members give them."""

from __future__ import annotations

from collections.abc import Mapping

from swarmdsl.diagnostics import Diagnostics
from swarmdsl.exchange.constants import Value, constant, params_by_name
from swarmdsl.ir import Array, Expression, Param, Primitive, StateMachine
from swarmdsl.python_source import Call

from .names import TARGET

_GREATEST = 2**63 - 1
"""What a whole number in a parameter of ROS 2 may be."""


def parameters(machine: StateMachine, report: Diagnostics) -> list[tuple[Param, Call]]:
    """How each param of a machine is declared."""
    found = []
    known = params_by_name(machine.params)
    for param in machine.params:
        element = param.type.element if isinstance(param.type, Array) else param.type
        if not isinstance(element, Primitive) or element.name == "time":
            _unsupported(f"a param of type `{param.type}`", param, report)
            continue
        arguments: list[object] = [param.name, _type(param, element)]
        given = param.default if param.default is not None else param.declared
        if given is not None:
            value = constant(given, known)
            if value is None:
                _unsupported("a param whose value is not known in advance", param, report)
            elif isinstance(value, int) and value > _GREATEST:
                _unsupported(f"a param of {value}, more than a parameter holds", param, report)
            arguments.append(fitted(param, value))
        doc = " ".join(param.doc.split())
        keywords = (("doc", doc),) if doc else ()
        found.append((param, Call("Parameter", tuple(arguments), keywords)))
    return found


def fitted(param: Param, value: Value | None) -> Value | None:
    """The value as ROS takes it for the param: a number of a float has a point."""
    floats = isinstance(param.type, Primitive) and param.type.name in (
        *("float32", "float64"),
        "duration",
    )
    return float(value) if floats and isinstance(value, (int, float)) else value


def given(
    machine: StateMachine,
    params: tuple[Param, ...],
    values: Mapping[str, Expression],
    around: tuple[Param, ...],
) -> Mapping[str, Value]:
    """What whoever runs a machine says of its params: by params of its own, as a part by `values`.

    In the values of a part, params of the member can be meant, `around`.
    """
    names = {param.name: param for param in machine.params}
    known = params_by_name(params)
    found: dict[str, Value] = {}
    for param in params:
        value = constant(param.default, known) if param.default is not None else None
        if value is not None:
            found[param.name] = value
    for name, expression in values.items():
        value = constant(expression, params_by_name(around))
        if value is not None:
            found[name] = value
    return {
        name: fitted(names[name], value)  # type: ignore[misc]
        for name, value in found.items()
        if name in names
    }


def _type(param: Param, element: Primitive) -> str:
    return f"{element.name}[]" if isinstance(param.type, Array) else element.name


def _unsupported(construct: str, param: Param, report: Diagnostics) -> None:
    report.report("unsupported-construct", param.origin, target=TARGET, construct=construct)
