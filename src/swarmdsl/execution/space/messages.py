"""Messages of devices and results of functions, filled by the structure of their types."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from swarmdsl.base.records import dataclass
from swarmdsl.codegen.shared.default_values import default_value, result_fields
from swarmdsl.execution.simulate.machines.copying import copied
from swarmdsl.ir import Function, Message, Named, Primitive, System, Type
from swarmdsl.syntax.types import FLOATS, INTEGERS

Place = tuple[float, float, float]
_HEADER = Named("std_msgs", "Header")
_FLAT, _POINT, _QUATERNION = {"x", "y"}, {"x", "y", "z"}, {"x", "y", "z", "w"}
_DISTANCES = ("distance", "range")
_CHARGES = ("percentage", "charge", "state_of_charge", "soc")
FRAME = "map"


@dataclass(frozen=True)
class Facts:
    """Contents of a message; None and an empty `id` are left out."""

    now: int
    place: Place | None = None
    heading: tuple[float, float] | None = None
    id: str = ""
    distance: float | None = None
    charge: float | None = None


Writer = Callable[[Facts], Any]


class Messages:
    """Writes messages of a model: facts where fields look like them, else defaults."""

    def __init__(self, system: System) -> None:
        self._system = system
        self._writers: dict[Type, Writer] = {}
        self._fields: dict[str, Sequence[tuple[str, Writer, Any]]] = {}

    def message(self, type_: Type, facts: Facts) -> Any:
        """Return a message of a type."""
        if type_ not in self._writers:
            self._writers[type_] = self._writer("", type_)
        return self._writers[type_](facts)

    def result(self, function: Function, facts: Facts) -> dict[str, Any]:
        """Return the fields of the result of a function that facts say something of."""
        if function.name not in self._fields:
            fields = result_fields(function.communication, self._system) or ()
            self._fields[function.name] = [
                (
                    field.name,
                    self._writer(field.name, field.type),
                    default_value(field.type, self._system),
                )
                for field in fields
            ]
        written = (
            (name, write(facts), default) for name, write, default in self._fields[function.name]
        )
        return {name: value for name, value, default in written if value != default}

    def _writer(self, name: str, type_: Type) -> Writer:
        """Return the function that writes a field."""
        system = self._system
        match type_:
            case Primitive(name="string" | "wstring", enum=None) if _is_id(name):
                return lambda facts: facts.id
            case Primitive() if _is_float(type_) and name in _DISTANCES:
                return lambda facts: 0 if facts.distance is None else facts.distance
            case Primitive() if _is_float(type_) and name in _CHARGES:
                return lambda facts: 0 if facts.charge is None else facts.charge
            case Primitive(enum=None) if type_.name in INTEGERS and name in _CHARGES:
                return lambda facts: 0 if facts.charge is None else int(100 * facts.charge)
            case Named():
                message = system.known_interface(type_)
                if isinstance(message, Message):
                    return self._of_message(type_, message)
        default = default_value(type_, system)
        if isinstance(default, (dict, list)):
            return lambda facts: copied(default)
        return lambda facts: default

    def _of_message(self, type_: Type, message: Message) -> Writer:
        names = {field.name for field in message.fields}
        if names == _POINT:
            return lambda facts: dict(zip("xyz", facts.place or (0, 0, 0), strict=True))
        if names == _FLAT and all(_is_float(field.type) for field in message.fields):
            return lambda facts: dict(zip("xy", (facts.place or (0, 0))[:2], strict=True))
        if names == _QUATERNION:
            return lambda facts: _orientation(*(facts.heading or (1.0, 0.0)))
        # sensor_msgs/BatteryState has a percentage, and a charge in ampere hours.
        charges = [name for name in _CHARGES if name in names][1:]
        parts = [
            (field.name, self._writer("" if field.name in charges else field.name, field.type))
            for field in message.fields
        ]
        if type_ == _HEADER:
            own = {"stamp": lambda facts: facts.now, "frame_id": lambda facts: FRAME}
            parts = [(name, own.get(name, write)) for name, write in parts]
        return lambda facts: {name: write(facts) for name, write in parts}


def _is_id(name: str) -> bool:
    return name == "id" or name.endswith("_id")


def place_in(value: Any) -> Place | None:
    """Return the first place in a message: `x`, `y` and perhaps `z`, at any depth."""
    if not isinstance(value, Mapping):
        return None
    if {"x", "y"} <= value.keys() and "w" not in value:
        x, y, z = value["x"], value["y"], value.get("z", 0.0)
        if all(isinstance(each, (int, float)) and math.isfinite(each) for each in (x, y, z)):
            return float(x), float(y), float(z)
        return None
    places = (place_in(each) for each in value.values())
    return next((place for place in places if place is not None), None)


def path_in(value: Any) -> tuple[Place, ...] | None:
    """Return the places in the first list of a message, at any depth, or in a list."""
    if isinstance(value, Sequence) and not isinstance(value, str):
        places = [place_in(each) for each in value]
        found = tuple(place for place in places if place is not None)
        return found if found and len(found) == len(places) else None
    if not isinstance(value, Mapping):
        return None
    return next((path for path in map(path_in, value.values()) if path), None)


def is_of_battery(type_: Type, system: System) -> bool:
    """Return True for a message that tells the charge of a battery."""
    message = system.known_interface(type_)
    fields = message.fields if isinstance(message, Message) else ()
    return any(field.name in _CHARGES and _is_number(field.type) for field in fields)


def _orientation(cosine: float, sine: float) -> dict[str, float]:
    """Return the quaternion of a direction on the ground."""
    z = math.sqrt(max((1 - cosine) / 2, 0.0))
    return {
        "x": 0.0,
        "y": 0.0,
        "z": z if sine >= 0 else -z,
        "w": math.sqrt(max((1 + cosine) / 2, 0.0)),
    }


def _is_number(type_: Type) -> bool:
    return _is_float(type_) or (
        isinstance(type_, Primitive) and type_.name in INTEGERS and type_.enum is None
    )


def _is_float(type_: Type) -> bool:
    return isinstance(type_, Primitive) and type_.name in FLOATS
