"""Parse trace lines of a simulation or a robot."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any

NAMES = ("configuration", "entered", "exited", "started", "cancelled", "sent")
"""Keys with lists of names; `taken` may be missing in traces of older nodes."""

_DEEPEST = 100
"""Levels of lists and objects in a line."""

# 292 years: the maximum in ROS.
_LONGEST = 2**63 // 1_000_000


def read_line(text: str | bytes) -> dict[str, Any] | str:
    """Return the values of a line, or the reason why it is invalid."""
    try:
        value = json.loads(text)
    except (ValueError, RecursionError):
        value = None
    if not isinstance(value, dict):
        return "it is not a JSON object"
    if len(text) > _DEEPEST and _is_deep(value):
        return f"it is nested more than {_DEEPEST} levels deep"
    return _fault(value) or value


def _is_deep(value: Any) -> bool:
    """Return True if a value is nested so deeply that functions which call themselves fail."""
    level = [value]
    for _ in range(_DEEPEST):
        lists = (each.values() if isinstance(each, dict) else each for each in level)
        level = [
            each for inside in lists for each in inside if each and isinstance(each, (dict, list))
        ]
        if not level:
            return False
    return True


def is_beside_steps(value: Mapping[str, Any]) -> bool:
    """Return True for a line without a step: verdicts, measures, places, or a lost event."""
    return (
        isinstance(value.get("property"), str)
        or isinstance(value.get("measures"), list)
        or isinstance(value.get("moved"), dict)
        or isinstance(value.get("lost"), dict)
    )


def _fault(value: dict[str, Any]) -> str:
    """Return the reason why a line is invalid, or ""."""
    for key in ("t", "began"):
        time = value.get(key, 0 if key == "began" else None)
        if not isinstance(time, int) or isinstance(time, bool) or not 0 <= time <= _LONGEST:
            return f"`{key}` must be a number of milliseconds"
    if is_beside_steps(value):
        return ""
    for key, least in (("loop", 0), ("cause", 1)):
        number = value.get(key, least)
        if not isinstance(number, int) or isinstance(number, bool) or number < least:
            return (
                f"`{key}` is a number of lines" if key == "loop" else f"`{key}` is that of a line"
            )
    if not isinstance(value.get("event", 0), (str, type(None))):
        return "`event` must be an event name or `null`"
    if not isinstance(value.get("member"), (str, type(None))):
        return "`member` must be a member name or `null`"
    for key in (*NAMES, "taken"):
        names = value.get(key, [] if key == "taken" else None)
        if not isinstance(names, list) or not all(isinstance(name, str) for name in names):
            return f"`{key}` is a list of names"
    to = value.get("to", [])
    if not isinstance(to, list) or not all(isinstance(name, (str, type(None))) for name in to):
        return "`to` is a list of names and `null`"
    return "" if _is_envelope(value.get("envelope", {})) else _BAD_ENVELOPE


_BAD_ENVELOPE = "`envelope` has a `sender`, which is a name, and `sent`, in nanoseconds"


def _is_envelope(value: Any) -> bool:
    kinds = {"sender": str, "sent": int}
    return isinstance(value, dict) and all(
        isinstance(each, kinds.get(key, ())) for key, each in value.items()
    )
