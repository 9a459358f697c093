"""Parse trace lines of a simulation or a robot."""

from __future__ import annotations

import json
from typing import Any

NAMES = ("configuration", "entered", "exited", "started", "cancelled", "sent")
"""Keys with lists of names; `taken` may be missing in traces of older nodes."""


def read_line(text: str | bytes) -> dict[str, Any] | str:
    """Return the values of a line, or the reason why it is invalid."""
    try:
        value = json.loads(text)
    except (ValueError, RecursionError):
        value = None
    if not isinstance(value, dict):
        return "it is not a JSON object"
    return _fault(value) or value


def _fault(value: dict[str, Any]) -> str:
    """Return the reason why a line is invalid, or ""."""
    time = value.get("t")
    if not isinstance(time, int) or isinstance(time, bool) or time < 0:
        return "`t` must be a number of milliseconds"
    if not isinstance(value.get("event", 0), (str, type(None))):
        return "`event` must be an event name or `null`"
    if not isinstance(value.get("member"), (str, type(None))):
        return "`member` must be a member name or `null`"
    for key in (*NAMES, "taken"):
        names = value.get(key, [] if key == "taken" else None)
        if not isinstance(names, list) or not all(isinstance(name, str) for name in names):
            return f"`{key}` is a list of names"
    return ""
