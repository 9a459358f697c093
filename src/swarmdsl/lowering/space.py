"""Lower the space of a swarm: geometry, weather, starts, equipment, sight, function models."""

from __future__ import annotations

from collections.abc import Iterable

from swarmdsl import ir
from swarmdsl.analysis.resolve.inheritance import all_items
from swarmdsl.analysis.types.space_types import argument_type, setting_type
from swarmdsl.ir.function_models import MODELS
from swarmdsl.ir.space import Values
from swarmdsl.ir.space_settings import SPACE_SETTINGS
from swarmdsl.lowering.context import Context
from swarmdsl.lowering.docs import lower_docs
from swarmdsl.lowering.expressions import lower_expression
from swarmdsl.syntax.ast import (
    Area,
    Component,
    Environment,
    Equipment,
    Expression,
    Function,
    Height,
    Member,
    ModelUse,
    Obstacle,
    PartValue,
    Point,
    Rain,
    Sight,
    Start,
    Targets,
    Wall,
    Wind,
    Zone,
    nodes_of,
)


def lower_geometry(environment: Environment, context: Context) -> ir.Environment:
    """Return an environment of this name with only its geometry and weather."""
    space = _Space(context)
    areas, zones, walls = [], [], []
    obstacles, targets, winds, rains = [], [], [], []
    for item in environment.items:
        match item:
            case Area():
                box = space.box(item.box.low, item.box.high, item.height)
                areas.append(ir.Area(str(item.name), box, item.doc, item.name.span))
            case Zone():
                box = space.box(item.box.low, item.box.high, item.height)
                zones.append(ir.Zone(str(item.name), box, item.doc, item.name.span))
            case Wall():
                points = tuple(map(space.point, item.points))
                walls.append(ir.Wall(points, space.top(item.height), item.doc, item.span))
            case Obstacle():
                shape = space.shape(item)
                obstacles.append(ir.Obstacle(str(item.name), shape, item.doc, item.name.span))
            case Targets():
                targets.append(space.targets(item))
            case Wind():
                speed, angle = space.number(item.speed), space.number(item.angle)
                times = space.times(item)
                winds.append(ir.Wind(speed, angle, *times, item.doc, item.span))
            case Rain():
                rains.append(ir.Rain(*space.times(item), item.doc, item.span))
    return ir.Environment(
        name=context.names[environment],
        world=None,
        size=None,
        areas=tuple(areas),
        zones=tuple(zones),
        walls=tuple(walls),
        obstacles=tuple(obstacles),
        targets=tuple(targets),
        winds=tuple(winds),
        rains=tuple(rains),
    )


class _Space:
    """Constant values and shapes; the checks have seen that they are constant."""

    def __init__(self, context: Context) -> None:
        self._folding = context.typing.folding

    def number(self, given: Expression) -> float:
        assert given.tree is not None
        value = self._folding.value(given.tree)
        assert isinstance(value, (int, float))
        return float(value)

    def point(self, given: Point) -> ir.Point:
        return ir.Point(self.number(given.x), self.number(given.y))

    def box(self, low: Point, high: Point, height: Height | None) -> ir.Box:
        lowest = 0.0
        if height is not None and height.upper is not None:
            lowest = self.number(height.lower)
        return ir.Box(self.point(low), self.point(high), lowest, self.top(height))

    def top(self, height: Height | None) -> float | None:
        if height is None:
            return None
        return self.number(height.lower if height.upper is None else height.upper)

    def shape(self, item: Obstacle) -> ir.Box | ir.Disc:
        if item.opposite is not None:
            return self.box(item.corner, item.opposite, item.height)
        assert item.radius is not None
        return ir.Disc(self.point(item.corner), self.number(item.radius), self.top(item.height))

    def targets(self, item: Targets) -> ir.Targets:
        places = tuple(map(self.point, item.places))
        return ir.Targets(
            str(item.name),
            int(item.count) if item.count else max(len(places), 1),
            places,
            item.area.name if item.area is not None else None,
            item.doc,
            item.name.span,
        )

    def times(self, item: Wind | Rain) -> tuple[int, int | None]:
        start = round(self.number(item.start)) if item.start is not None else 0
        return start, round(self.number(item.end)) if item.end is not None else None


def lower_start(start: Start | None, context: Context) -> str | ir.Point | None:
    """Return the point or the name of the area where robots start."""
    if start is None:
        return None
    if start.point is not None:
        return _Space(context).point(start.point)
    return start.area.name if start.area is not None else None


def lower_equipment(member: Member, kind: str, context: Context) -> tuple[Values, ir.Docs]:
    """Return what a member is in space, of one kind, and the comments of its values."""
    for item in all_items(member, Equipment):
        if item.kind == kind:
            docs = tuple((f"{kind}.{name}", doc) for name, doc in lower_docs(item.values))
            own = ((kind, item.doc),) if item.doc else ()
            return _settings(kind, item.values, context), (*own, *docs)
    return (), ()


def lower_sights(component: Component, context: Context) -> tuple[ir.Sight, ...]:
    """Return what a component finds in space."""
    return tuple(
        ir.Sight(
            item.target.name,
            _settings("senses", item.values, context),
            item.doc,
            lower_docs(item.values),
            item.span,
        )
        for item in all_items(component, Sight)
    )


def _settings(kind: str, values: Iterable[PartValue], context: Context) -> Values:
    """Return settings in units of ROS."""
    known = SPACE_SETTINGS[kind]
    return tuple(
        (
            str(each.name),
            lower_expression(each.value, context, setting_type(known[str(each.name)].unit)),
        )
        for each in values
    )


def lower_model(function: Function, context: Context) -> ir.ModelUse | None:
    """Return the model of a function."""
    for use in nodes_of(function, ModelUse):
        model = MODELS.get(str(use.name))
        kinds = {each.name: each.kind for each in model.arguments} if model is not None else {}
        arguments = tuple(
            (
                str(each.name),
                lower_expression(each.value, context, argument_type(kinds.get(str(each.name), ""))),
            )
            for each in use.arguments
        )
        return ir.ModelUse(str(use.name), arguments, use.doc, use.span)
    return None
