"""Data of machines: their first values, and values that effects store or send."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from swarmdsl import ir
from swarmdsl.codegen.shared.default_values import default_value, field_type
from swarmdsl.execution.engine import ExecutionError, bounded
from swarmdsl.execution.simulate.machines.copying import copied
from swarmdsl.execution.simulate.machines.expressions import SELF, Value, applied, function_of
from swarmdsl.execution.simulate.scenario.scenario import Robot
from swarmdsl.ir import Array, Call, Construction, Expression, Primitive, System, Type
from swarmdsl.ir.integer_ranges import bound_of
from swarmdsl.syntax.types import DURATION

_ALONE = Robot()


def first_data(
    machine: ir.StateMachine, system: System, params: Mapping[str, Any], robot: Robot = _ALONE
) -> dict[str, Any]:
    """Return the initial variables and params on a robot, given the values of some params.

    Raises ValueError for a param without a value.
    """
    data: dict[str, Any] = {SELF: robot.identity}
    for param in machine.params:
        if param.name in params:
            data[param.name] = copied(params[param.name])
        elif (default := first_value(param)) is not None:
            data[param.name] = stored(default, param.type, system)(data, None)
        else:
            raise ValueError(f"param `{param.name}` of `{machine.name}` has no value")
    for variable in machine.variables:
        if variable.initial is not None:
            data[variable.name] = stored(variable.initial, variable.type, system)(data, None)
        else:
            data[variable.name] = default_value(variable.type, system)
    return data


def first_value(param: ir.Param) -> Expression | None:
    """Return the default of a param; that of the machine if its owners disagree."""
    return param.default if param.default is not None else param.declared


def stored(expression: Expression, wanted: Type | None, system: System | None) -> Value:
    """Compile an expression whose value is stored or sent as type `wanted`.

    The value is a copy, as in ROS; durations are whole nanoseconds, integers are in range.
    """
    match expression:
        case Construction():
            assert system is not None
            return _new_message(expression, system)
        case Call(function="append" | "replace" as word, type=Array(element=element)):
            # The items of the array itself have been copied when they were stored.
            at = 1 if word == "append" else 2
            values = [
                stored(part, element, system) if number == at else function_of(part)
                for number, part in enumerate(expression.arguments)
            ]
            return applied(word, values)
    value = function_of(expression)
    bound = bound_of(expression, wanted)
    if bound is not None:
        return lambda data, event: bounded(value(data, event), bound)
    if expression.type == DURATION:
        return lambda data, event: round(value(data, event))
    if isinstance(expression.type, Primitive):
        return value
    return lambda data, event: copied(value(data, event))


def _new_message(made: Construction, system: System) -> Value:
    """Compile a new message: its fields have their defaults or values."""
    fields = [
        (name, stored(value, field_type(made.type, (name,), system), system))
        for name, value in made.values
    ]

    def value(data: Mapping[str, Any], event: Any) -> Any:
        message = default_value(made.type, system)
        for name, given in fields:
            message[name] = given(data, event)
        return message

    return value


def store(data: dict[str, Any], variable: str, path: tuple[str, ...], value: Any) -> None:
    """Assign a value to a variable, or to the field of a path in it."""
    if not path:
        data[variable] = value
        return
    held = data[variable]
    for field in path[:-1]:
        held = held.setdefault(field, {}) if isinstance(held, dict) else None
    if not isinstance(held, dict):
        raise ExecutionError(f"`{variable}` has no `{'.'.join(path)}` to assign to")
    held[path[-1]] = value
