"""Latin hypercube (M. McKay, R. Beckman, W. Conover, 1979)."""

from __future__ import annotations

from swarmdsl.execution.simulate.scenario.random_source import RandomSource

Shares = tuple[float, ...]


def latin_hypercube(dimensions: int, points: int, seed: int) -> list[Shares]:
    """Return points in the unit cube: in each dimension, one in each of `points` equal parts."""
    columns = [_column(points, seed, dimension) for dimension in range(dimensions)]
    return list(zip(*columns, strict=True))


def _column(points: int, seed: int, dimension: int) -> list[float]:
    stream = RandomSource(seed).stream("latin", dimension)
    parts = list(range(points))
    # Fisher and Yates; `shuffle` of Python may change, `random` does not.
    for last in range(points - 1, 0, -1):
        other = int(stream.random() * (last + 1))
        parts[last], parts[other] = parts[other], parts[last]
    return [(part + stream.random()) / points for part in parts]
