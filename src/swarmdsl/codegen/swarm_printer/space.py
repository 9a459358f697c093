"""Print the geometry and weather of environments, starts, sights and models of functions."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from decimal import Decimal

from swarmdsl.codegen.swarm_printer.expressions import duration, expression
from swarmdsl.codegen.swarm_printer.layout import UnprintableError, block, documented
from swarmdsl.ir import (
    Area,
    Box,
    Disc,
    Environment,
    ModelUse,
    Obstacle,
    Point,
    Rain,
    Shape,
    Sight,
    SpaceMeasure,
    Targets,
    Wall,
    Wind,
    Zone,
    doc_of,
)
from swarmdsl.syntax.units import UNITS, written_in

Item = Area | Zone | Wall | Obstacle | Targets | Wind | Rain


def space_items(environment: Environment) -> Iterator[Item]:
    """Yield what an environment has besides its world and size, in the order of printing."""
    yield from environment.areas
    yield from environment.zones
    yield from environment.walls
    yield from environment.obstacles
    yield from environment.targets
    yield from environment.winds
    yield from environment.rains


def print_space(environment: Environment) -> list[str]:
    """Print the geometry and the weather of an environment, one item a line."""
    return [
        line for item in space_items(environment) for line in documented(item.doc, [text(item)])
    ]


def text(item: Item) -> str:
    """Return an item of an environment as in the model."""
    match item:
        case Area() | Zone():
            return f"{type(item).__name__.lower()} {item.name} : {shape(item.box)}"
        case Wall():
            return f"wall : {wall_line(item)}"
        case Obstacle():
            return f"obstacle {item.name} : {shape(item.shape)}"
        case Targets():
            return f"target {_counted(item)} at {places(item)}"
        case Wind():
            return f"wind {wind(item)}{_times(item)}"
        case Rain():
            return f"rain{_times(item)}"


def shape(of: Shape) -> str:
    """Return a shape with its height: `(1 m, 2 m) radius 3 m height 10 m`."""
    match of:
        case Box():
            height = _height(of.lowest, of.highest)
            return f"{point(of.low)} .. {point(of.high)}{height}"
        case Disc():
            height = _height(0.0, of.height)
            return f"{point(of.centre)} radius {metres(of.radius)}{height}"


def wall_line(wall: Wall) -> str:
    """Return the points of a wall and its height."""
    return " -> ".join(map(point, wall.points)) + _height(0.0, wall.height)


def places(targets: Targets) -> str:
    """Return where targets are: `random in meadow`, or their points."""
    if targets.places:
        return ", ".join(map(point, targets.places))
    return "random" if targets.area is None else f"random in {targets.area}"


def wind(of: Wind) -> str:
    """Return the speed and the direction of a wind."""
    speed, angle = written_in(of.speed, UNITS["m/s"]), written_in(of.angle, UNITS["deg"])
    return f"{_plain(speed)} to {_plain(angle)}"


def point(at: Point) -> str:
    """Return a point in metres."""
    return f"({metres(at.x)}, {metres(at.y)})"


def metres(length: float) -> str:
    """Return a length as a decimal number: without exponent, and without `.0`."""
    return f"{_plain(f'{Decimal(repr(length)):f}')} m"


def start(of: str | Point | None) -> str:
    """Return ` in area` or ` at (x, y)`, or nothing."""
    if of is None:
        return ""
    return f" in {of}" if isinstance(of, str) else f" at {point(of)}"


def space_measure(measure: SpaceMeasure) -> str:
    """Return a measure of space: `distance(uav)`."""
    return f"{measure.quantity}({measure.of})"


def print_sights(sights: Iterable[Sight]) -> list[str]:
    """Print what a component finds."""
    return [
        line
        for sight in sights
        for line in documented(
            sight.doc,
            block(
                f"senses {sight.kind}",
                [
                    line
                    for name, value in sight.values
                    for line in documented(
                        doc_of(sight.docs, name), [f"{name} = {expression(value)}"]
                    )
                ],
            ),
        )
    ]


def model(use: ModelUse) -> str:
    """Return the model of a function with its arguments: `coverage(width = 4 m)`."""
    given = ", ".join(f"{name} = {expression(value)}" for name, value in use.arguments)
    return f"{use.name}({given})" if given else use.name


def times(item: Wind | Rain) -> str:
    """Return when it is: `from 5 min until 10 min`, or `all the time`."""
    return _times(item).strip() or "all the time"


def _times(item: Wind | Rain) -> str:
    begin = f" from {duration(item.start)}" if item.start else ""
    return begin if item.end is None else f"{begin} until {duration(item.end)}"


def _counted(targets: Targets) -> str:
    if targets.places and targets.count != len(targets.places):
        raise UnprintableError(f"`{targets.kind}` has not as many targets as places")
    return (
        targets.kind
        if targets.count == max(len(targets.places), 1)
        else (f"{targets.kind}[{targets.count}]")
    )


def _height(lowest: float, highest: float | None) -> str:
    if highest is None:
        if lowest:
            raise UnprintableError("a shape without a top begins on the ground")
        return ""
    return (
        f" height {metres(lowest)} .. {metres(highest)}" if lowest else f" height {metres(highest)}"
    )


def _plain(number: str) -> str:
    """Leave out `.0`, before a unit too."""
    digits, _, unit = number.partition(" ")
    return f"{digits.removesuffix('.0')} {unit}".rstrip()
