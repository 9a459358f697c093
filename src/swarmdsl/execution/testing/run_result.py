"""Result of one run of a test."""

from __future__ import annotations

from collections.abc import Mapping

from swarmdsl.base.diagnostics.collector import Label
from swarmdsl.base.records import dataclass
from swarmdsl.base.source import Span
from swarmdsl.execution.simulate.world.line import Line


@dataclass(frozen=True)
class Failure:
    """Failure of a run: the parts of its diagnostic, and the last trace lines."""

    code: str
    place: Span
    fields: dict[str, str]
    label: str
    related: tuple[Label, ...]
    last: tuple[Line, ...]


@dataclass(frozen=True)
class RunResult:
    """Result of a run; `faults` are failed guards and effects, by machine.

    `remarks` by property say why it says nothing of the run; `skipped` is the number of
    impossible actions that were left out.
    """

    failure: Failure | None
    faults: tuple[tuple[str, str], ...]
    remarks: Mapping[str, str]
    skipped: int = 0
