"""Checks of the geometry and the weather of environments."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from swarmdsl.analysis.checks.context import Context
from swarmdsl.analysis.space_shapes import (
    Circle,
    Rectangle,
    corners_of,
    heights_of,
    number_of,
    place_of,
    shape_of,
    size_of,
)
from swarmdsl.analysis.types.space_types import ANGLE, LENGTH, SPEED
from swarmdsl.base.diagnostics.advice import Advice, behind, edits, write
from swarmdsl.base.diagnostics.collector import Label
from swarmdsl.base.numerals import integer
from swarmdsl.base.source import Span
from swarmdsl.syntax.ast import (
    Area,
    Environment,
    Height,
    Obstacle,
    Point,
    Rain,
    Size,
    Targets,
    Wall,
    Wind,
    Zone,
    nodes_of,
)
from swarmdsl.syntax.types import DURATION

_MOST_TARGETS = 10_000
"""Of one declaration; simulations have arrays and names of all of them."""
_RADIUS = Advice("give it a radius", "propose", "1 m")


def check_geometry(environment: Environment, context: Context) -> None:
    """Check the values, the shapes and the places in an environment."""
    for point in nodes_of(environment, Point):
        context.check_constant(point.x, LENGTH)
        context.check_constant(point.y, LENGTH)
    for item in environment.items:
        match item:
            case Area() | Zone() | Obstacle():
                _check_shape(item, context)
            case Wall():
                _check_wall(item, context)
            case Targets():
                _check_targets(item, context)
            case Wind() | Rain():
                _check_weather(item, context)
    _check_inside(environment, context)


def what_is(item: Area | Zone | Obstacle) -> str:
    """Return an item as diagnostics name it: "area `meadow`"."""
    return f"{type(item).__name__.lower()} `{item.name}`"


def _check_shape(item: Area | Zone | Obstacle, context: Context) -> None:
    shape, what = shape_of(item, context.typing.folding), what_is(item)
    low, high = corners_of(item)
    if isinstance(item, Obstacle) and item.radius is not None:
        context.check_constant(item.radius, LENGTH)
        if isinstance(shape, Circle) and shape.radius <= 0:
            _report(what, "has no room", item.radius.span, context, _RADIUS)
    if isinstance(shape, Rectangle) and high is not None:
        at = Span(low.span.source, low.span.start, high.span.end)
        if shape.right < shape.left or shape.top < shape.bottom:
            order = Advice(
                "write the lower left corner first, then the upper right one", "sort corners"
            )
            _report(what, "ends before it begins", at, context, order)
        elif shape.right == shape.left or shape.top == shape.bottom:
            help_ = _as_wall(item, low, high) if isinstance(item, Obstacle) else None
            _report(what, "has no room", at, context, help_)
    _check_height(item.height, what_is(item), context)


def _as_wall(obstacle: Obstacle, low: Point, high: Point) -> str:
    """Return the help for an obstacle without width."""
    height = f" {obstacle.height.span.text}" if obstacle.height is not None else ""
    wall = f"wall : {low.span.text} -> {high.span.text}{height}"
    return edits("a thin obstacle is a `wall`", f"Write `{wall}`", (obstacle.span, wall))


def _check_height(height: Height | None, what: str, context: Context) -> None:
    if height is None:
        return
    for value in filter(None, (height.lower, height.upper)):
        context.check_constant(value, LENGTH)
    lowest, highest = heights_of(height, context.typing.folding)
    if lowest is not None and highest is not None and highest <= lowest:
        _report(what, "has no height", height.span, context, write("height 0 m .. 3 m"))
    elif lowest is not None and lowest < 0:
        _report(what, "begins below the ground", height.span, context, "the ground is at `0 m`")


def _check_wall(wall: Wall, context: Context) -> None:
    _check_height(wall.height, "this wall", context)
    if len(wall.points) < 2:
        help_ = Advice(
            "write where it ends: `wall : (0 m, 5 m) -> (8 m, 5 m)`", "append", " -> (8 m, 5 m)"
        )
        _report("this wall", "has only one point", wall.span, context, help_)
    places = [place_of(point, context.typing.folding) for point in wall.points]
    for point, before, place in zip(wall.points[1:], places, places[1:], strict=False):
        if place is not None and place == before:
            _report("this part of the wall", "has no length", point.span, context, None)


def _check_targets(item: Targets, context: Context) -> None:
    if item.count and integer(item.count) < 1:
        context.report.report(
            "impossible-setting", item.name.span, name=f"{item.name}[{item.count}]", least=1
        )
    elif item.count and integer(item.count) > _MOST_TARGETS:
        help_ = Advice(
            f"leave some out: there are {_MOST_TARGETS} at most",
            "write instead",
            f"[{item.count}]",
            f"[{_MOST_TARGETS}]",
        )
        _report(f"target `{item.name}`", "has too many of its kind", item.name.span, context, help_)
    elif item.count and item.places and integer(item.count) != len(item.places):
        count, places = integer(item.count), len(item.places)
        fault = f"has {count} of its kind, but {places} {'place' if places == 1 else 'places'}"
        help_ = Advice(
            f"leave `[{item.count}]` out: there is one at each place",
            "leave out",
            f"[{item.count}]",
        )
        _report(f"target `{item.name}`", fault, item.name.span, context, help_)


def _check_weather(item: Wind | Rain, context: Context) -> None:
    folding = context.typing.folding
    if isinstance(item, Wind):
        context.check_constant(item.speed, SPEED)
        context.check_constant(item.angle, ANGLE)
        speed = number_of(item.speed, folding)
        if speed is not None and speed < 0:
            forwards = (item.speed.span, item.speed.span.text.removeprefix("-").strip())
            turned = behind(item.angle.span, " + 180 deg")
            help_ = edits(
                "turn its direction by `180 deg` instead", "Turn the direction", forwards, turned
            )
            _report("this wind", "has a negative speed", item.speed.span, context, help_)
    for time in filter(None, (item.start, item.end)):
        context.check_constant(time, DURATION)
        value = number_of(time, folding)
        if value is not None and value < 0:
            _report("this time", "is before the start of the run", time.span, context, None)
    start, end = number_of(item.start, folding) or 0.0, number_of(item.end, folding)
    if item.end is not None and end is not None and 0 <= end <= start:
        what = f"this {type(item).__name__.lower()}"
        _report(what, "ends before it begins", item.end.span, context, None)


def _report(what: str, fault: str, at: Span, context: Context, help_: str | None) -> None:
    context.report.report("impossible-shape", at, what=what, fault=fault, help=help_)


def _check_inside(environment: Environment, context: Context) -> None:
    """Report what is outside the size of an environment, each item once."""
    size = size_of(environment)
    if size is None or not all(size):
        return
    for item in environment.items:
        found = next(_outside(item, size, context), None)
        if found is not None:
            what, at = found
            report_outside(what, at, environment, context)


def report_outside(what: str, at: Span, environment: Environment, context: Context) -> None:
    """Report what is outside the size of an environment."""
    size = next(item for item in environment.items if isinstance(item, Size))
    context.report.report(
        "outside-environment",
        at,
        what=what,
        related=(Label(size.span, "the environment ends there"),),
        help="its lower left corner is `(0 m, 0 m)`",
    )


def _outside(item: object, size: Sequence[float], context: Context) -> Iterator[tuple[str, Span]]:
    folding = context.typing.folding
    height: Height | None = None
    match item:
        case Area() | Zone() | Obstacle():
            what, height = what_is(item), item.height
            points = [point for point in corners_of(item) if point is not None]
        case Wall():
            what, height, points = "this wall", item.height, item.points
        case Targets():
            what, points = f"target `{item.name}`", item.places
        case _:
            return
    for point in points:
        place = place_of(point, folding)
        if place is not None and is_outside(place, size):
            yield what, point.span
    _, highest = heights_of(height, folding)
    if height is not None and highest is not None and len(size) > 2 and highest > size[2]:
        yield what, height.span


def is_outside(place: tuple[float, float], size: Sequence[float]) -> bool:
    """Return True for a place that is not in an environment of a size."""
    return not (0 <= place[0] <= size[0] and 0 <= place[1] <= size[1])
