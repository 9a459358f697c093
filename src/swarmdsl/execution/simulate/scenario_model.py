"""Read the model that a scenario gives to a function, with its arguments."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from swarmdsl.base.suggest import suggest
from swarmdsl.execution.simulate.scenario_table import Table
from swarmdsl.execution.simulate.space import Place
from swarmdsl.execution.simulate.subject import Subject
from swarmdsl.ir import Communication
from swarmdsl.ir.function_models import MODELS, Argument

_ENDS = ("duration", "aborted", "preempted", "never")


def model_setting(
    table: Table, subject: Subject, call: Communication | None
) -> Iterator[tuple[str, Any]]:
    """Yield `model` and `arguments` of a function, if they are valid."""
    if "model" not in table:
        if "arguments" in table:
            table.wrong(("arguments",), "no arguments without a `model`", table.values["arguments"])
        return
    if call is None:
        table.wrong(
            ("model",), "no model: it is for one function of a model", table.values["model"]
        )
        return
    for key in _ENDS:
        if key in table:
            table.wrong((key,), "no value beside a `model`, which decides", table.values[key])
    name = table.name("model", [*MODELS, *subject.models], "model")
    if name is None:
        return
    yield "model", name
    inner = table.inside("arguments")
    if name not in MODELS:
        yield "arguments", dict(inner.values)
        return
    known = {each.name: each for each in MODELS[name].arguments}
    inner.check_keys(known, f"model `{name}`", "arguments")
    values = ((key, _value(inner, known[key], subject)) for key in inner.values if key in known)
    yield "arguments", {key: value for key, value in values if value is not None}


def _value(table: Table, argument: Argument, subject: Subject) -> Any:
    """Read an argument by its kind: numbers are in metres, m/s and radians."""
    key, value = argument.name, table.values[argument.name]
    match argument.kind:
        case "time":
            return table.duration(key)
        case "place":
            return _place(table, key)
        case "path":
            return _path(table, key)
        case "area":
            return _area(table, key, subject)
        case "text" if argument.choices:
            return table.name(key, argument.choices, argument.name)
        case "text":
            return value if value == "" else table.text(key, "a string")
        case "share":
            return table.share(key)
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not abs(value) < 1e9:
        table.wrong((key,), f"a number: {_UNITS[argument.kind]}", value)
        return None
    if argument.kind in ("length", "speed") and value < 0:
        table.wrong((key,), f"a number from 0 on: {_UNITS[argument.kind]}", value)
        return None
    return float(value)


_UNITS = {
    "length": "a length in metres",
    "speed": "a speed in m/s",
    "angle": "an angle in radians",
    "number": "it has no unit",
}


def _place(table: Table, *way: str | int) -> Place | None:
    value: Any = table.values
    for key in way:
        value = value[key]
    is_list = isinstance(value, list) and len(value) in (2, 3)
    if not is_list or any(
        isinstance(each, bool) or not isinstance(each, (int, float)) or not abs(each) < 1e9
        for each in value
    ):
        table.wrong(way, "a place: a list of x, y and perhaps z, in metres", value)
        return None
    x, y, z = (*value, 0.0)[:3]
    return float(x), float(y), float(z)


def _path(table: Table, key: str) -> tuple[Place, ...] | None:
    value = table.values[key]
    if not isinstance(value, list) or not value:
        table.wrong((key,), "a path: a list of places", value)
        return None
    places = [_place(table, key, number) for number in range(len(value))]
    found = tuple(place for place in places if place is not None)
    return found if len(found) == len(places) else None


def _area(table: Table, key: str, subject: Subject) -> str | None:
    environment = subject.environment
    areas = [each.name for each in environment.areas] if environment is not None else []
    if not areas:
        place = table.value_place((key,))
        help_ = suggest(str(table.values[key]), areas, "areas") or "the environment has no areas"
        table.report.report(
            "unresolved-name", place, kind="area", name=table.values[key], help=help_
        )
        return None
    return table.name(key, areas, "area")
