"""Data in the traces of robots, in the types of the model."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from swarmdsl.codegen.shared.default_values import default_value
from swarmdsl.execution.simulate.machines.json_numbers import numbers
from swarmdsl.ir import Array, Field, Message, Primitive, System, Type
from swarmdsl.syntax.types import FLOATS


def convert(type_: Type, data: Any, system: System) -> Any:
    """Convert data of a robot to a type of the model; unknown fields are dropped."""
    match type_:
        case Primitive(name=name) if name in FLOATS:
            # Older nodes wrote `null` for numbers that JSON does not have.
            return math.nan if data is None else numbers(data)
        case Array(element=element) if isinstance(data, list):
            return [convert(element, each, system) for each in data]
    described = system.interface(type_)
    if isinstance(described, Message):
        return with_fields(described.fields, data, system)
    return default_value(type_, system) if data is None else numbers(data)


def with_fields(fields: Sequence[Field], data: Any, system: System) -> dict[str, Any]:
    """Convert the fields of a message; those that are missing have their default values."""
    given = data if isinstance(data, dict) else {}
    return {
        field.name: convert(field.type, given[field.name], system)
        if field.name in given
        else default_value(field.type, system)
        for field in fields
    }
