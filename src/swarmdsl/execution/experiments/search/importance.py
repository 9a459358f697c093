"""Importance of settings in a search: how much of the differences between candidates is theirs."""

from __future__ import annotations

import math
from collections.abc import Sequence

from swarmdsl.execution.experiments.report.canvas import short
from swarmdsl.execution.experiments.report.importance import Importance
from swarmdsl.execution.experiments.search.space import Dimension, SearchSpace
from swarmdsl.execution.experiments.task import Candidate
from swarmdsl.execution.simulate.scenario.durations import SECOND, duration

_MOST_GROUPS = 8
_MOST_ROUNDS = 100
"""Rounds of the fit, for candidates that are spread very unevenly."""


def importances(
    observed: Sequence[tuple[Candidate, float]], space: SearchSpace
) -> list[Importance]:
    """Return the importance of each setting that varies, the greatest first."""
    values = [value for _, value in observed]
    named: dict[str, tuple[list[str], list[int]]] = {}
    for dimension in space.dimensions:
        settings = [each.values[dimension.name] for each, _ in observed]
        names, numbers = _groups(dimension, settings)
        if len(names) > 1:
            named[dimension.name] = names, numbers
    columns = {name: numbers for name, (_, numbers) in named.items()}
    shares = dict(zip(columns, _shares(list(columns.values()), values), strict=True))
    found = []
    for setting, (names, numbers) in named.items():
        parts = [
            [value for at, value in zip(numbers, values, strict=True) if at == number]
            for number in range(len(names))
        ]
        groups = tuple(
            (name, _mean(part), len(part)) for name, part in zip(names, parts, strict=True)
        )
        found.append(Importance(setting, shares[setting], groups))
    return sorted(found, key=lambda each: -(each.share or 0.0))


def _groups(
    dimension: Dimension, settings: Sequence[int | float | str]
) -> tuple[list[str], list[int]]:
    """Return the names of groups, single settings or ranges of equal width, and those of each."""
    numbers = [_number(setting) for setting in settings]
    names = {number: str(setting) for number, setting in zip(numbers, settings, strict=True)}
    if len(names) <= _MOST_GROUPS:
        ordered = sorted(names)
        return [names[number] for number in ordered], [ordered.index(each) for each in numbers]
    low, high = float(dimension.lower), float(dimension.upper)
    width = (high - low) / _MOST_GROUPS
    parts = [min(max(int((each - low) / width), 0), _MOST_GROUPS - 1) for each in numbers]
    unit = " s" if dimension.kind == "time" else ""
    used = sorted(set(parts))
    ranges = [f"{short(low + at * width)} to {short(low + (at + 1) * width)}{unit}" for at in used]
    return ranges, [used.index(part) for part in parts]


def _number(setting: int | float | str) -> float:
    if isinstance(setting, str):
        return (duration(setting) or 0) / SECOND
    return float(setting)


def _mean(values: Sequence[float]) -> float:
    return math.fsum(values) / len(values)


def _shares(columns: Sequence[Sequence[int]], values: Sequence[float]) -> list[float | None]:
    """Return the share of each column of groups."""
    whole = _unexplained([], values)
    if not values or whole <= len(values) * (1e-12 * _mean(values)) ** 2:
        return [None for _ in columns]
    left = _unexplained(columns, values)
    sizes = [max(column) for column in columns]
    freedom = len(values) - 1 - sum(sizes)
    # As many groups as candidates explain everything, also by chance.
    if freedom <= 0:
        return [None for _ in columns]
    chance = left / freedom
    found: list[float | None] = []
    for number, size in enumerate(sizes):
        others = [column for at, column in enumerate(columns) if at != number]
        alone = _unexplained(others, values) - left
        found.append(min(max(alone - size * chance, 0.0) / whole, 1.0))
    return found


def _unexplained(columns: Sequence[Sequence[int]], values: Sequence[float]) -> float:
    """Return the squares that a sum of group effects leaves, fitted one column after the other."""
    mean = _mean(values) if values else 0.0
    left = [value - mean for value in values]
    before = math.inf
    for _ in range(_MOST_ROUNDS):
        for column in columns:
            sums, counts = [0.0] * (max(column) + 1), [0] * (max(column) + 1)
            for group, value in zip(column, left, strict=True):
                sums[group] += value
                counts[group] += 1
            left = [v - sums[g] / counts[g] for v, g in zip(left, column, strict=True)]
        squares = math.fsum(value**2 for value in left)
        if squares >= before * (1 - 1e-9):
            break
        before = squares
    return math.fsum(value**2 for value in left)
