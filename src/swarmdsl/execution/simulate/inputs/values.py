"""Convert JSON and TOML values to data of model types."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

from swarmdsl.base.diagnostics.collector import listed
from swarmdsl.base.numerals import fits_64_bits
from swarmdsl.base.suggest import did_you_mean, suggest
from swarmdsl.codegen.shared.default_values import default_fields, default_result, result_fields
from swarmdsl.execution.simulate.machines.json_numbers import NOT_FINITE, numbers
from swarmdsl.execution.simulate.scenario.durations import duration
from swarmdsl.ir import (
    Array,
    Communication,
    Field,
    Literal,
    Message,
    Named,
    Primitive,
    System,
    Type,
)
from swarmdsl.syntax.types import FLOATS, INTEGERS

_BITS = {name: int(name.lstrip("uint")) for name in INTEGERS} | {"byte": 8, "char": 8}
_UNSIGNED = ("byte", "char")
Way = tuple[str | int, ...]


class MisfitError(ValueError):
    """Value does not have the expected type; `way` is the path to the invalid part.

    `code`, `fields` and `help` are those of the diagnostic.
    """

    def __init__(self, way: Way, code: str, help_: str | None, **fields: Any) -> None:
        super().__init__(code)
        self.way = way
        self.code = code
        self.help = help_
        self.fields = fields


def fitted(type_: Type, value: Any, system: System, way: Way = ()) -> Any:
    """Convert a value to engine data; missing fields get their defaults.

    Raises MisfitError if it does not fit.
    """
    match type_:
        case Primitive(enum=Named() as enum):
            return _enum_value(type_, enum, value, system, way)
        case Primitive():
            return _primitive(type_.name, value, way)
        case Array(element=element, size=size, bounded=bounded):
            if not isinstance(value, list):
                raise _misfit(way, "a list", value)
            if size is not None and (len(value) > size or (not bounded and len(value) < size)):
                raise _misfit(way, f"{'at most ' if bounded else ''}{size} items", value)
            return [fitted(element, each, system, (*way, i)) for i, each in enumerate(value)]
    if not isinstance(value, dict):
        raise _misfit(way, f"the fields of `{type_}`", value)
    described = system.known_interface(type_)
    if not isinstance(described, Message):
        return numbers(value)
    given = _given(described.fields, value, system, f"`{type_}`", way)
    return {**default_fields(described.fields, system), **given}


def fitted_result(
    call: Communication, values: Mapping[str, Any], system: System, owner: str, way: Way
) -> dict[str, Any]:
    """Convert the result of a function; any values if its type is unknown."""
    fields = result_fields(call, system)
    if fields is None:
        return dict(numbers(values))
    if not isinstance(values, dict):
        raise _misfit(way, "a table of fields", values)
    return {**default_result(call, system), **_given(fields, values, system, owner, way)}


def _given(
    fields: Iterable[Field], values: Mapping[str, Any], system: System, owner: str, way: Way
) -> dict[str, Any]:
    """Convert the given fields."""
    known = {field.name: field.type for field in fields}
    for name in values:
        if name not in known:
            help_ = suggest(name, known, "fields")
            raise MisfitError((*way, name), "unknown-field", help_, owner=owner, name=name)
    return {name: fitted(known[name], values[name], system, (*way, name)) for name in values}


def _enum_value(type_: Primitive, enum: Named, value: Any, system: System, way: Way) -> Any:
    """Return the number of a value of an enum, which is given by its name or as a number."""
    described = system.interface(enum)
    if not isinstance(value, str) or not isinstance(described, Message):
        return _primitive(type_.name, value, way)
    values = ((each.name, each.value) for each in described.constants)
    known = {name: each.value for name, each in values if isinstance(each, Literal)}
    if value not in known:
        names = listed(list(known), "or")
        misfit = _misfit(way, f"a value of `{enum.name}`: {names}", value)
        misfit.help = did_you_mean(value, known)
        raise misfit
    return known[value]


def _primitive(name: str, value: Any, way: Way) -> Any:
    if name in ("string", "wstring"):
        if isinstance(value, str):
            return value
        raise _misfit(way, "a string", value)
    if name == "bool":
        if isinstance(value, bool):
            return value
        raise _misfit(way, "`true` or `false`", value)
    if name in ("time", "duration"):
        length = duration(value) if isinstance(value, str) else None
        if length is not None:
            return length
        raise _misfit(way, 'a time like "1.5 s"', value)
    if name in FLOATS:
        if isinstance(value, float) or (type(value) is int and fits_64_bits(value)):
            return float(value)
        if value in NOT_FINITE:
            return float(value)
        raise _misfit(way, "a number", value)
    bits = _BITS[name]
    signed = not (name in _UNSIGNED or name.startswith("u"))
    low, high = (-(2 ** (bits - 1)), 2 ** (bits - 1)) if signed else (0, 2**bits)
    if isinstance(value, int) and not isinstance(value, bool) and low <= value < high:
        return value
    raise _misfit(way, f"a whole number from {low} to {high - 1}", value)


def _misfit(way: Way, expected: str, value: Any) -> MisfitError:
    name = next((str(each) for each in reversed(way) if isinstance(each, str)), "data")
    return MisfitError(way, "wrong-value", None, name=name, expected=expected, found=kind(value))


def kind(value: Any) -> str:
    """Describe a value in a message."""
    match value:
        case None:
            return "nothing"
        case int() if not fits_64_bits(value):
            return "so large a number"
        case bool():
            return f"`{str(value).lower()}`"
        case int() | float() | str():
            text = repr(value) if not isinstance(value, str) else f'"{value}"'
            return f"`{text}`" if len(text) <= 40 else "this"
        case list():
            return f"a list of {len(value)}"
        case dict():
            return "a table"
    return "a date"
