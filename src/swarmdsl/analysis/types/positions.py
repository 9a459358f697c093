"""Positions: messages with coordinates, of which `distance` takes two."""

from __future__ import annotations

from typing import NamedTuple

from swarmdsl.analysis.resolve.interfaces import Interfaces
from swarmdsl.analysis.types.fitting import is_number
from swarmdsl.syntax.types import Named, Type, unit_of
from swarmdsl.syntax.units import Unit

# Fields in which messages of ROS have a position, such as `PoseStamped` with `pose.position`.
_INNER = ("position", "pose", "point")
_DEEPEST = 4


class Position(NamedTuple):
    """Fields that lead to a point in a message, and its coordinates: `x`, `y` and perhaps `z`.

    The coordinates of a message that is not described are not known: there are none. `unit` is
    that of `x`.
    """

    path: tuple[str, ...]
    coordinates: tuple[str, ...]
    unit: Unit | None = None


def position_of(type_: Type | None, interfaces: Interfaces) -> Position | None:
    """Return the position in a message; None if there is none."""
    path: list[str] = []
    while isinstance(type_, Named) and len(path) < _DEEPEST:
        described = interfaces.fields(type_)
        if described is None:
            return Position(tuple(path), ()) if interfaces.get(type_) is None else None
        fields = {str(known.name): known.type.type for known in described}
        found = tuple(name for name in ("x", "y", "z") if is_number(fields.get(name)))
        if found[:2] == ("x", "y"):
            # Four components are an orientation.
            return None if "w" in fields else Position(tuple(path), found, unit_of(fields["x"]))
        inner = next((name for name in _INNER if name in fields), None)
        if inner is None:
            return None
        path.append(inner)
        type_ = fields[inner]
    return None
