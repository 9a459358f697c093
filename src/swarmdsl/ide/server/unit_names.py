"""Units of a number, those of the expected dimension first."""

from __future__ import annotations

from collections.abc import Iterator

from swarmdsl.ide.server.completion_entry import BEST, LIKELY
from swarmdsl.syntax.types import DURATION, Type, declared_unit
from swarmdsl.syntax.units import UNITS

_DURATIONS = ("s", "ms", "min", "h", "us")


def ranked_units(expected: Type | None) -> Iterator[tuple[str, int]]:
    """Yield the units that a number of a type can have; all of them if it is not known."""
    if expected == DURATION:
        yield from ((name, BEST) for name in _DURATIONS)
        return
    wanted = declared_unit(expected)
    if wanted is None and expected is not None:
        return
    for name, unit in UNITS.items():
        if name != "%" and (wanted is None or unit.dimension == wanted.dimension):
            yield name, BEST if wanted is not None else LIKELY
