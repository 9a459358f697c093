"""Types of the values in a space: settings by their unit, arguments of models by their kind."""

from __future__ import annotations

from swarmdsl.ir.function_models import NAMES
from swarmdsl.syntax.types import DURATION, FLOAT, STRING, Type, with_unit
from swarmdsl.syntax.units import UNITS

LENGTH = with_unit(FLOAT, UNITS["m"])
SPEED = with_unit(FLOAT, UNITS["m/s"])
ANGLE = with_unit(FLOAT, UNITS["deg"])

# Units that people write, for messages; the values are in those of ROS in any case.
_WRITTEN = {"rad": "deg", "rad/s": "deg/s", "J": "Wh"}
_OF_KINDS: dict[str, Type | None] = {
    "length": LENGTH,
    "speed": SPEED,
    "angle": ANGLE,
    "time": DURATION,
    "number": FLOAT,
    "share": FLOAT,
    **dict.fromkeys(NAMES, STRING),
}


def setting_type(unit: str) -> Type:
    """Return the type of a setting in a unit, a plain number without one."""
    return with_unit(FLOAT, UNITS[_WRITTEN.get(unit, unit)]) if unit else FLOAT


def argument_type(kind: str) -> Type | None:
    """Return the type of an argument of a model; None for a message, of any type."""
    return _OF_KINDS.get(kind)
