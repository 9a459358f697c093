"""Strings of nodes of target `ros2`: lines of traces, heartbeats, models, verdicts."""

from __future__ import annotations

import json
from typing import Any

LINES = ("transitions", "verdicts")
"""Last parts of the topics of nodes with lines of traces."""
TOPICS = ("verdicts", "members", "models")
"""Last parts of topics beside those of the machines: of monitors, and of swarms."""


def object_in(text: str | bytes) -> dict[str, Any]:
    """Return the object in a text, empty if there is none."""
    try:
        value = json.loads(text)
    except (ValueError, RecursionError):
        return {}
    return value if isinstance(value, dict) else {}


def time_of(text: str | bytes) -> int:
    """Return the time of a line on the clock of its robot, in milliseconds; 0 if it has none."""
    value = object_in(text)
    times = [each for key in ("began", "t") if isinstance(each := value.get(key), int)]
    return sum(times)


def member_in(text: str) -> str:
    """Return the member of a line, or an empty text."""
    member = object_in(text).get("member")
    return member if isinstance(member, str) else ""


def model_in(text: str) -> tuple[str, str, str] | None:
    """Return the member, the node and the model that a node tells: `sar 1.0 (3f2a)`."""
    value = object_in(text)
    names = [value.get(key) for key in ("member", "node", "model", "version", "digest")]
    if not all(isinstance(each, str) for each in names) or not names[1]:
        return None
    member, node, model, version, digest = map(str, names)
    return member or node, node, f"{model} {version} ({digest})"
