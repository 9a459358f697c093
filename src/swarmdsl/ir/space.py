"""Space of a swarm: the geometry of environments, sight, and models of functions.

Lengths are in metres, angles in radians (from x, counterclockwise), times in nanoseconds from the
start of the run. The origin of an environment is its lower left corner.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from typing import Literal

from swarmdsl.base.records import dataclass, field
from swarmdsl.base.source import Span
from swarmdsl.ir.docs import Docs
from swarmdsl.ir.expressions import Expression

Values = tuple[tuple[str, Expression], ...]


@dataclass(frozen=True, slots=True)
class Point:
    """Place on the ground."""

    x: float
    y: float


@dataclass(frozen=True, slots=True)
class Box:
    """Rectangle between two corners; `highest` None means that it has no top."""

    low: Point
    high: Point
    lowest: float = 0.0
    highest: float | None = None


@dataclass(frozen=True, slots=True)
class Disc:
    """Circle on the ground; `height` None means that it has no top."""

    centre: Point
    radius: float
    height: float | None = None


Shape = Box | Disc


@dataclass(frozen=True, slots=True)
class Area:
    """Named part of an environment: where robots start, targets are, or what is covered."""

    name: str
    box: Box
    doc: str = ""
    origin: Span | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Zone:
    """Named part of an environment that no robot may enter."""

    name: str
    box: Box
    doc: str = ""
    origin: Span | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Wall:
    """Wall along a line of two or more points; `height` None means that it has no top."""

    points: tuple[Point, ...]
    height: float | None = None
    doc: str = ""
    origin: Span | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Obstacle:
    """Solid body on the ground."""

    name: str
    shape: Shape
    doc: str = ""
    origin: Span | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Targets:
    """Things of one kind that sensors can find: at the `places`, else at random in an area.

    Without places and `area` they are anywhere in the environment.
    """

    kind: str
    count: int
    places: tuple[Point, ...] = ()
    area: str | None = None
    doc: str = ""
    origin: Span | None = field(default=None, compare=False, repr=False)


def target_names(targets: Iterable[Targets]) -> list[str]:
    """Return the names of all targets in order, numbered within their kind: `person[0]`."""
    numbers: Counter[str] = Counter()
    names = []
    for each in targets:
        first = numbers[each.kind]
        numbers[each.kind] += each.count
        names += [f"{each.kind}[{number}]" for number in range(first, numbers[each.kind])]
    return names


@dataclass(frozen=True, slots=True)
class Wind:
    """Wind of a speed in m/s towards an angle, from `start` until `end` or the end of the run."""

    speed: float
    angle: float
    start: int = 0
    end: int | None = None
    doc: str = ""
    origin: Span | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Rain:
    """Rain from `start` until `end` or the end of the run."""

    start: int = 0
    end: int | None = None
    doc: str = ""
    origin: Span | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Sight:
    """Kind of target that a sensor finds, and how well: range, view, miss, wrong, rate.

    The values may read params of the component.
    """

    kind: str
    values: Values
    doc: str = ""
    docs: Docs = ()
    origin: Span | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class ModelUse:
    """Model that a function has in space, with the arguments given to it.

    An argument may read params of the function and, as variables, fields of its goal or request.
    """

    name: str
    arguments: Values = ()
    doc: str = ""
    origin: Span | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class SpaceMeasure:
    """Value of a run that only a space knows.

    `distance` is the way of all robots of role `of` in metres, `energy` what they used in J, and
    `covered` the share of the environment that they have seen; `found` is the number of targets of
    kind `of` that a robot has seen.
    """

    quantity: Literal["distance", "energy", "covered", "found"]
    of: str
