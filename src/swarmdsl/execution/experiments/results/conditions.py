"""Conditions on kept runs: `count of robot >= 4`, `Safe = false`, `robot.patience < 30 s`."""

from __future__ import annotations

import operator
import re
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from swarmdsl.execution.experiments.results.records import Record
from swarmdsl.execution.simulate.scenario.durations import SECOND, duration

_FORM = re.compile(r"\s*(?P<name>.+?)\s*(?P<sign><=|>=|!=|==|=|<|>)\s*(?P<value>.*?)\s*")
_SIGNS: dict[str, Callable[[Any, Any], bool]] = {
    "=": operator.eq,
    "==": operator.eq,
    "!=": operator.ne,
    "<": operator.lt,
    "<=": operator.le,
    ">": operator.gt,
    ">=": operator.ge,
}


@dataclass(frozen=True)
class Condition:
    """Condition on the value of a name."""

    name: str
    sign: str
    value: str

    def holds(self, record: Record) -> bool:
        """Return True if a run fulfils it; a run without the value only with `!=`."""
        found = record.get(self.name)
        if found is None:
            return self.sign == "!=" and self.value != ""
        left, right = _comparable(found), _comparable(self.value)
        if type(left) is not type(right):
            left, right = str(found), self.value
        return _SIGNS[self.sign](left, right)


def read_condition(text: str) -> Condition | None:
    """Parse a condition; None if it is none."""
    found = _FORM.fullmatch(text)
    return Condition(found["name"], found["sign"], found["value"]) if found else None


def _comparable(value: Any) -> float | str:
    """Return a number where there is one: times are in seconds."""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, (int, float)):
        return float(value)
    text = str(value)
    time = duration(text)
    if time is not None:
        return time / SECOND
    try:
        return float(text)
    except ValueError:
        return text
