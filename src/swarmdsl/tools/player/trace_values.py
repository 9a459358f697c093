"""Values in lines of traces, as far as they are what a page expects.

A trace may come from anywhere: a value of another kind is left out, so that no view meets it.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from swarmdsl.execution.simulate.world.trace_line import is_beside_steps

_AXES = (2, 3)
_FAR = 1e9
"""Metres to which no robot comes."""
_LARGE = 2**63
"""Number that no time in nanoseconds reaches."""
_BESIDE = (
    *("t", "began", "property", "verdict", "remark", "measures", "fitness"),
    *("moved", "links", "targets", "saw", "lost"),
)
"""Keys of lines without a step."""

Check = Callable[[Any], bool]


def fitting(value: dict[str, Any]) -> dict[str, Any] | None:
    """Return the values of a line that fit; None if nothing is left that could be shown."""
    if is_beside_steps(value):
        value = {key: value[key] for key in _BESIDE if key in value}
    unfit = [key for key, fits in _CHECKS.items() if key in value and not fits(value[key])]
    for key in unfit:
        del value[key]
    return value if "configuration" in value or is_beside_steps(value) else None


def _is_number(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool) and abs(value) < _LARGE


def _is_place(value: Any) -> bool:
    return (
        isinstance(value, list)
        and len(value) in _AXES
        and all(_is_number(each) and abs(each) < _FAR for each in value)
    )


def _is_name(value: Any) -> bool:
    return isinstance(value, str)


def _of(check: Check) -> Check:
    """Return the check of a list of such values."""
    return lambda value: isinstance(value, list) and all(map(check, value))


def _record(needed: Mapping[str, Check]) -> Check:
    """Return the check of an object that has at least these keys."""
    return lambda value: (
        isinstance(value, dict)
        and all(key in value and check(value[key]) for key, check in needed.items())
    )


def _is_moved(value: Any) -> bool:
    return isinstance(value, dict) and all(map(_is_place, value.values()))


def _is_target(value: Any) -> bool:
    """Return True for a place, followed by whether it is found."""
    return isinstance(value, list) and _is_place(value[:-1]) and isinstance(value[-1], bool)


def _is_true(value: Any) -> bool:
    return value is True


_NAMES = _of(_is_name)
_CHECKS: Mapping[str, Check] = {
    "envelope": lambda value: _is_number(value.get("sent", 0)),
    "at": _is_place,
    "moved": _is_moved,
    "lost": _record(
        {"event": _is_name, "sender": _is_name, "member": _is_name, "sent": _is_number}
    ),
    "variables": _record({}),
    "nobody": _NAMES,
    "dropped": _NAMES,
    "withdrawn": _NAMES,
    "scheduled": _of(_record({"event": _is_name, "after": _is_number})),
    "ignored": _is_true,
    "deferred": _is_true,
    "recalled": _is_true,
    "property": _is_name,
    "verdict": lambda value: value in ("true", "open", "false"),
    "remark": _is_name,
    "measures": _of(_record({"name": _is_name})),
    "fitness": lambda value: _is_name(value) or _record({"name": _is_name})(value),
    "links": _of(_of(_is_name)),
    "targets": lambda value: isinstance(value, dict) and all(map(_is_target, value.values())),
    "saw": _record({"member": _is_name, "target": _is_name}),
}
