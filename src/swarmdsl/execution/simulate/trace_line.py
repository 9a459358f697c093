"""A line of a trace, read: of a simulation, or of a robot."""

from __future__ import annotations

import json
from typing import Any

NAMES = ("configuration", "entered", "exited", "started", "cancelled", "sent")
"""The keys that have lists of names. `taken` may be missing, as in traces of older nodes."""


def read_line(text: str | bytes) -> dict[str, Any] | str:
    """The values of a line; of one that is none, what is wrong with it."""
    try:
        value = json.loads(text)
    except (ValueError, RecursionError):
        value = None
    if not isinstance(value, dict):
        return "it is no object of JSON"
    return _fault(value) or value


def _fault(value: dict[str, Any]) -> str:
    """What is wrong with a line; empty where nothing is."""
    time = value.get("t")
    if not isinstance(time, int) or isinstance(time, bool) or time < 0:
        return "`t` is a number of milliseconds"
    if not isinstance(value.get("event", 0), (str, type(None))):
        return "`event` is the name of one, or `null`"
    if not isinstance(value.get("member"), (str, type(None))):
        return "`member` is the name of one, or `null`"
    for key in (*NAMES, "taken"):
        names = value.get(key, [] if key == "taken" else None)
        if not isinstance(names, list) or not all(isinstance(name, str) for name in names):
            return f"`{key}` is a list of names"
    return ""
