"""Compact form of a recording: tables of values, columns of numbers, deflated.

Lines that do the same share a row of a table: everything but the time, the member, and what differs
from line to line (`VARYING`). Those have columns of their own:

    {"t": 12, "member": "uav[0]", "event": "Start", "at": [1.5, 2], ...}
    -> t +12, member 0, step 7, at [+1500, +2000]
"""

from __future__ import annotations

import json
import zlib
from base64 import b64encode
from collections.abc import Mapping, Sequence
from typing import Any

from swarmdsl.execution.simulate.machines.json_numbers import named_numbers
from swarmdsl.execution.simulate.scenario.durations import MILLISECOND
from swarmdsl.tools.player.recording import Recording, Step

VARYING = ("data", "envelope", "at", "moved", "variables", "lost", "cause", "measures")
"""Keys whose values have columns of their own."""
_THOUSANDTHS = 1000
_JSON = json.JSONEncoder(ensure_ascii=False, allow_nan=False, separators=(",", ":"))


class _Table:
    """Numbers of values, by their JSON."""

    def __init__(self) -> None:
        self._numbers: dict[str, int] = {}

    def number(self, value: Any) -> int:
        return self._numbers.setdefault(_written(value), len(self._numbers))

    def values(self) -> list[Any]:
        return [json.loads(text) for text in self._numbers]


def _written(value: Any) -> str:
    """Return a value as JSON; numbers that JSON does not have by their names."""
    try:
        return _JSON.encode(value)
    except ValueError:
        return _JSON.encode(named_numbers(value))


class _Lines:
    """Tables and columns of the lines so far."""

    def __init__(self) -> None:
        self._steps, self._members, self._values = _Table(), _Table(), _Table()
        self._time = 0
        self._places: dict[str, Sequence[int]] = {}
        self._columns: dict[str, list[Any]] = {key: [] for key in ("t", "member", "step", *VARYING)}

    def add(self, line: Step) -> None:
        """Add a line; its varying values leave a 0 in its step."""
        step = {key: 0 if key in VARYING else value for key, value in line.items()}
        member, time = step.pop("member", None), step.pop("t")
        columns = self._columns
        columns["t"].append(time - self._time)
        columns["member"].append(self._members.number(member) if "member" in line else -1)
        columns["step"].append(self._steps.number(step))
        self._time = time
        for key in VARYING:
            if key in line:
                columns[key].append(self._varying(key, line[key], line))

    def _varying(self, key: str, value: Any, line: Step) -> Any:
        if key == "envelope":
            since = line["t"] * MILLISECOND - value.get("sent", 0)
            return [self._members.number(value.get("sender", "")), since]
        if key == "at":
            return self._moved(str(line.get("member")), value)
        if key == "moved":
            return [
                [self._members.number(who), *self._moved(who, place)]
                for who, place in value.items()
            ]
        return self._values.number(value)

    def _moved(self, who: str, place: Sequence[float]) -> list[int]:
        """Return how far a robot has moved, in thousandths."""
        now = [round(each * _THOUSANDTHS) for each in place]
        before = self._places.get(who, ())
        if len(before) != len(now):
            before = [0] * len(now)
        self._places[who] = now
        return [each - was for each, was in zip(now, before, strict=True)]

    def document(self) -> dict[str, Any]:
        """Return tables and columns as plain data."""
        return {
            "steps": self._steps.values(),
            "names": self._members.values(),
            "values": self._values.values(),
            "columns": {key: column for key, column in self._columns.items() if column},
        }


def as_document(recording: Recording) -> Mapping[str, Any]:
    """Return a recording as plain data, lines in tables."""
    lines = _Lines()
    for line in recording.lines:
        lines.add(line)
    return {**recording.head(), "count": len(recording.lines), "lines": lines.document()}


def encode(recording: Recording) -> str:
    """Return a recording as base64 of deflated JSON, which has nothing that HTML could take."""
    return pack(_written(as_document(recording)))


def pack(text: str) -> str:
    """Return base64 of a deflated text, which `unpack.js` reads."""
    return b64encode(zlib.compress(text.encode("utf-8", "surrogatepass"), 9)).decode()
