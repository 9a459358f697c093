"""Checks of the places where robots start."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from math import hypot, pi

from swarmdsl.analysis.checks.context import Context
from swarmdsl.analysis.checks.geometry import is_outside, report_outside, what_is
from swarmdsl.analysis.resolve.inheritance import all_items
from swarmdsl.analysis.resolve.multiplicity import greatest
from swarmdsl.analysis.space_shapes import (
    Place,
    Rectangle,
    Shape,
    distance_from_line,
    heights_of,
    number_of,
    place_of,
    shape_of,
    size_of,
)
from swarmdsl.analysis.types.constant_folding import Folding
from swarmdsl.analysis.types.space_types import LENGTH
from swarmdsl.base.diagnostics.collector import Label
from swarmdsl.base.numerals import integer
from swarmdsl.base.records import dataclass
from swarmdsl.base.source import Span
from swarmdsl.syntax.ast import (
    Environment,
    EnvironmentUse,
    Equipment,
    Member,
    Obstacle,
    RobotValues,
    Role,
    Swarm,
    Wall,
    Zone,
)

_DENSEST = pi / 12**0.5
"""Share of the plane that equal circles can cover (Thue)."""


@dataclass(frozen=True)
class _Start:
    """Place of a robot with its body, at a span."""

    name: str
    place: Place
    radius: float
    span: Span


def check_starts(swarm: Swarm, context: Context) -> None:
    """Check that robots can be where they start."""
    use = next((item for item in swarm.items if isinstance(item, EnvironmentUse)), None)
    environment = use.environment.target if use is not None else None
    if environment is not None and environment in context.incomplete:
        environment = None
    own = {
        (item.role.name, integer(item.index))
        for item in swarm.items
        if isinstance(item, RobotValues) and item.start is not None
    }
    points = []
    for item in swarm.items:
        if not isinstance(item, (Role, RobotValues)) or item.start is None:
            continue
        role = item if isinstance(item, Role) else item.role.target
        radius = _radius(role.member.target if role is not None else None, context.typing.folding)
        others = sum(1 for name, _ in own if role is not None and name == role.name)
        count = _least(role) - others if isinstance(item, Role) else 1
        if item.start.point is not None:
            found = _at_point(item, radius, count, environment, context)
            points += [found] if found is not None else []
        elif item.start.area is not None and item.start.area.target is not None:
            box = shape_of(item.start.area.target, context.typing.folding)
            if isinstance(box, Rectangle):
                _check_area(item, box, radius, count, environment, context)
    _check_apart(points, context)


def _least(role: Role | None) -> int:
    """Return the number of robots that a role has at least, or exactly."""
    if role is None or role.multiplicity is None:
        return 1
    lower = role.multiplicity.lower
    return integer(lower) if lower != "*" else 0


def _radius(member: Member | None, folding: Folding) -> float:
    """Return the radius of the body of a member; 0 if it is not known."""
    for item in all_items(member, Equipment) if member is not None else ():
        for value in item.values if item.kind == "body" else ():
            if value.name == "radius":
                return max(number_of(value.value, folding) or 0.0, 0.0)
    return 0.0


def _name(item: Role | RobotValues) -> str:
    return f"`{item.name}`" if isinstance(item, Role) else f"`{item.role.name}[{item.index}]`"


def _at_point(
    item: Role | RobotValues,
    radius: float,
    count: int,
    environment: Environment | None,
    context: Context,
) -> _Start | None:
    """Check a start at a point; return it if one robot can be there."""
    point = item.start.point if item.start is not None else None
    assert point is not None
    context.check_constant(point.x, LENGTH)
    context.check_constant(point.y, LENGTH)
    many = greatest(item) != 1 if isinstance(item, Role) else False
    if many and count > 1:
        name = item.name if isinstance(item, Role) else ""
        context.report.report(
            "blocked-start",
            point.span,
            robots=_name(item),
            reason="only one robot can be at a point",
            help=f"start them in an area, or each one by itself: `{name}[0] at (1 m, 2 m)`",
        )
        return None
    place = place_of(point, context.typing.folding)
    if place is None:
        return None
    if environment is not None:
        size = size_of(environment)
        if size is not None and is_outside(place, size):
            report_outside(f"the start of {_name(item)}", point.span, environment, context)
            return None
        for what, distance, at in _solids(environment, place, context.typing.folding):
            if distance < radius or distance == 0:
                near = "there" if distance == 0 else "too near"
                context.report.report(
                    "blocked-start",
                    point.span,
                    robots=_name(item),
                    reason=f"{what} is {near}",
                    related=(Label(at, "this is in the way"),),
                )
                return None
    return _Start(_name(item), place, radius, point.span)


def _solids(
    environment: Environment, place: Place, folding: Folding
) -> Iterator[tuple[str, float, Span]]:
    """Yield what is in the way on the ground, with its distance from a place."""
    for what, shape, span in _shapes(environment, folding):
        yield what, shape.distance(place), span
    for item in environment.items:
        if isinstance(item, Wall):
            corners = [place_of(point, folding) for point in item.points]
            for start, end in pairwise(corners):
                if start is not None and end is not None:
                    yield "a wall", distance_from_line(start, end, place), item.span


def _shapes(environment: Environment, folding: Folding) -> Iterator[tuple[str, Shape, Span]]:
    """Yield the obstacles and zones that stand on the ground."""
    for item in environment.items:
        if isinstance(item, (Obstacle, Zone)):
            shape = shape_of(item, folding)
            if shape is not None and heights_of(item.height, folding)[0] == 0.0:
                yield what_is(item), shape, item.name.span


def _check_area(
    item: Role | RobotValues,
    box: Rectangle,
    radius: float,
    count: int,
    environment: Environment | None,
    context: Context,
) -> None:
    area = item.start.area if item.start is not None else None
    assert area is not None
    assert area.target is not None
    for what, shape, span in _shapes(environment, context.typing.folding) if environment else ():
        if shape.covers(box):
            context.report.report(
                "blocked-start",
                area.span,
                robots=_name(item),
                reason=f"area `{area.name}` is inside {what}",
                related=(Label(span, "this is in the way"),),
            )
            return
    width, depth = box.right - box.left, box.top - box.bottom
    if width <= 0 or depth <= 0 or count < 1 or radius == 0:
        return
    # The bodies may reach over the border, the centres may not.
    room = (width + 2 * radius) * (depth + 2 * radius)
    if count * pi * radius**2 > room * _DENSEST:
        robots = f"{count} robots" if count > 1 else "one robot"
        context.report.report(
            "blocked-start",
            area.span,
            robots=_name(item),
            reason=f"area `{area.name}` is too small for {robots} of radius {radius:g} m",
            related=(Label(area.target.name.span, "this area"),),
            help="make the area larger, or start some robots elsewhere",
        )


def _check_apart(starts: list[_Start], context: Context) -> None:
    """Report the later of two robots that would start in the same place."""
    for number, one in enumerate(starts):
        for other in starts[:number]:
            distance = hypot(one.place[0] - other.place[0], one.place[1] - other.place[1])
            if distance == 0 or distance < one.radius + other.radius:
                context.report.report(
                    "blocked-start",
                    one.span,
                    robots=one.name,
                    reason=f"{other.name} is there",
                    related=(Label(other.span, "it starts here"),),
                )
                break
