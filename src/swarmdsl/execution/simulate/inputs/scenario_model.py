"""Read the model that a scenario gives to a function, with its arguments."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from swarmdsl.execution.simulate.inputs.scenario_table import Table
from swarmdsl.execution.simulate.machines.subject import Subject
from swarmdsl.execution.simulate.scenario.durations import SECOND
from swarmdsl.execution.simulate.scenario.space import Place
from swarmdsl.ir import Communication
from swarmdsl.ir.function_models import ANY_TARGET, MODELS, Argument
from swarmdsl.ir.space import target_names

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
            time = table.duration(key)
            fits = time is not None and _is_in_range(table, argument, time / SECOND)
            return time if fits else None
        case "place":
            return _place(table, key)
        case "path":
            return _path(table, key)
        case "area":
            return _area(table, key, subject)
        case "target":
            return str(value) if value in ("", ANY_TARGET) else _target(table, key, subject)
        case "text" if argument.choices:
            return table.name(key, argument.choices, argument.name)
        case "text":
            return value if value == "" else table.text(key, "a string")
        case "share":
            return table.share(key)
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        table.wrong((key,), f"a number: {_UNITS[argument.kind]}", value)
        return None
    return float(value) if _is_in_range(table, argument, value) else None


_UNITS = {
    "length": "a length in metres",
    "speed": "a speed in m/s",
    "angle": "an angle in radians",
    "number": "it has no unit",
    "time": "a time",
}


def _is_in_range(table: Table, argument: Argument, value: float) -> bool:
    """Return True if a number may be the value of an argument; report one that may not."""
    limits = argument.limits(value)
    if limits is not None:
        expected = f"{_UNITS[argument.kind]}, {limits}"
        table.wrong((argument.name,), expected, table.values[argument.name])
    return limits is None


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
        _report_none(table, key, "area")
        return None
    return table.name(key, areas, "area")


def _target(table: Table, key: str, subject: Subject) -> str | None:
    """Read a kind of targets, or the name of one."""
    environment = subject.environment
    targets = environment.targets if environment is not None else ()
    kinds = list(dict.fromkeys(each.kind for each in targets))
    if not kinds:
        _report_none(table, key, "target")
        return None
    value = table.values[key]
    return value if value in target_names(targets) else table.name(key, kinds, "target")


def _report_none(table: Table, key: str, kind: str) -> None:
    """Report a name of which there is nothing in the environment."""
    name = table.text(key, f"the name of a {kind}")
    if name is not None:
        place, help_ = table.value_place((key,)), f"the environment has no {kind}s"
        table.report.report("unresolved-name", place, kind=kind, name=name, help=help_)
