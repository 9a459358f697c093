"""Axes and lines of parallel coordinates from candidates as plain data."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from swarmdsl.execution.experiments.designs.factors import Value
from swarmdsl.execution.experiments.report.canvas import short
from swarmdsl.execution.experiments.report.charts import Axis, Way, parallel_coordinates

_MOST_WAYS = 400
_MOST_LABELS = 8


@dataclass(frozen=True)
class Scored:
    """Settings of a candidate by name, and the mean of what counts; None if it has none.

    Times are in seconds. `kind` is empty, `best` or `today`.
    """

    settings: Mapping[str, Value]
    value: float | None
    kind: str = ""


def draw_candidates(candidates: Sequence[Scored], goal: str, name: str) -> str | None:
    """Draw candidates that have a value, at most 400: the marked ones and the best.

    None if there is nothing to draw.
    """
    sign = 1 if goal == "maximize" else -1
    scored = [(each, each.value) for each in candidates if each.value is not None]
    names = list(dict.fromkeys(name for each, _ in scored for name in each.settings))
    columns = {name: _Column([each.settings.get(name) for each, _ in scored]) for name in names}
    columns = {name: column for name, column in columns.items() if column.varies}
    if len(scored) < 2 or not columns:
        return None
    values = _Column([value for _, value in scored])
    ranked = sorted(range(len(scored)), key=lambda at: -sign * scored[at][1])
    shown = sorted(ranked, key=lambda at: not scored[at][0].kind)[:_MOST_WAYS]
    ranks = {at: rank for rank, at in enumerate(ranked)}
    ways = []
    for at in sorted(shown):
        candidate, value = scored[at]
        settings = ", ".join(f"{key} {_text(each)}" for key, each in candidate.settings.items())
        positions = [
            column.position(candidate.settings.get(key)) for key, column in columns.items()
        ]
        ways.append(
            Way(
                [*positions, values.position(value)],
                1 - ranks[at] / max(len(scored) - 1, 1),
                f"{settings}: {short(value)}",
                candidate.kind,
            )
        )
    axes = [Axis(key, column.labels) for key, column in columns.items()]
    return parallel_coordinates([*axes, Axis(name, values.labels)], ways)


def caption_of(candidates: Sequence[Scored], what: str) -> str:
    """Return the caption of the drawing; `what` names a candidate."""
    said = f"Each line is a {what}; strong lines are good ones. Point at one for its values."
    count = sum(each.value is not None for each in candidates)
    return f"{said} The best {_MOST_WAYS} of {count} are drawn." if count > _MOST_WAYS else said


class _Column:
    """Values of a setting on an axis: numbers by their size, names in their order."""

    def __init__(self, values: Sequence[Value | None]) -> None:
        self._names = list(dict.fromkeys(values))
        numbers = [
            float(each)
            for each in self._names
            if isinstance(each, (int, float)) and not isinstance(each, bool)
        ]
        self._numeric = len(numbers) == len(self._names)
        self._low = min(numbers) if self._numeric else 0.0
        self._high = max(numbers) if self._numeric else len(self._names) - 1.0

    @property
    def varies(self) -> bool:
        return len(self._names) > 1

    def position(self, value: Value | None) -> float:
        if not self.varies:
            return 0.5
        number = float(value or 0) if self._numeric else float(self._names.index(value))
        return (number - self._low) / (self._high - self._low)

    @property
    def labels(self) -> dict[float, str]:
        """Labels of some positions."""
        names = self._names
        if self._numeric and len(names) > _MOST_LABELS:
            middle = (self._low + self._high) / 2
            return {0.0: short(self._low), 0.5: short(middle), 1.0: short(self._high)}
        step = -(-len(names) // _MOST_LABELS)
        return {self.position(each): _text(each) for each in names[::step]}


def _text(value: Value | None) -> str:
    if value is None:
        return "-"
    return short(value) if isinstance(value, float) else str(value)
