"""Steps of behaviour tests in TOML, on one line each."""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Mapping
from typing import Any

from swarmdsl import ir
from swarmdsl.execution.simulate.scenario.durations import MICROSECOND, MILLISECOND, SECOND

_BARE = re.compile(r"[A-Za-z0-9_-]+")


def step_text(**keys: Any) -> str:
    """Return a step; keys without a value are left out."""
    return toml_text({key: value for key, value in keys.items() if value is not None})


def time_text(length: int) -> str:
    """Return a duration as tests have it."""
    for unit, size in (("s", SECOND), ("ms", MILLISECOND), ("us", MICROSECOND)):
        if length % size == 0:
            return f"{length // size} {unit}"
    return f"{length / MICROSECOND} us"


def with_times(type_: ir.Type | None, data: Any, system: ir.System) -> Any:
    """Return data of a type as tests have them, with times as text."""
    match type_, data:
        case ir.Primitive(name="time" | "duration"), int():
            return time_text(data)
        case ir.Array(element=element), list() | tuple():
            return [with_times(element, each, system) for each in data]
        case ir.Named(), Mapping():
            known = system.known_interface(type_)
            fields = known.fields if isinstance(known, ir.Message) else None
            return fields_with_times(fields, data, system)
    return data


def fields_with_times(
    fields: Iterable[ir.Field] | None, data: Mapping[str, Any], system: ir.System
) -> dict[str, Any]:
    """Return the values of fields as tests have them, with times as text."""
    types = {field.name: field.type for field in fields or ()}
    return {name: with_times(types.get(name), each, system) for name, each in data.items()}


def toml_text(value: Any) -> str:
    """Return a value in TOML, on one line."""
    match value:
        case bool():
            return "true" if value else "false"
        case str():
            return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
        case Mapping():
            inner = ", ".join(f"{_key(key)} = {toml_text(each)}" for key, each in value.items())
            return f"{{ {inner} }}" if inner else "{}"
        case list() | tuple():
            return f"[{', '.join(map(toml_text, value))}]"
    return repr(value)


def _key(name: str) -> str:
    return name if _BARE.fullmatch(name) else toml_text(name)
