"""Verdicts on a run, with its violations."""

from __future__ import annotations

from typing import Any, NamedTuple

from .claims import Property
from .monitor import Verdict


class Violation(NamedTuple):
    """Violation of a property, by a robot if it is about each one, with the last trace lines."""

    property: Property
    robot: str | None
    time: int
    last: tuple[Any, ...]


class PropertyResult(NamedTuple):
    """Verdict on a property at the end of a run; `robots` are those with the same verdict.

    `remark` says why a true one says nothing of the run.
    """

    property: Property
    verdict: Verdict
    robots: tuple[str, ...]
    violations: tuple[Violation, ...]
    remark: str = ""


class ViolatedError(Exception):
    """A property is violated, and the run must stop then."""
