"""World of an environment as SDF.

Names of models have a prefix by what they are, so that no two are the same and none is reserved.
"""

from __future__ import annotations

import math
from collections import Counter

from swarmdsl.codegen import dataclass
from swarmdsl.codegen.xml import Element
from swarmdsl.ir import Area, Box, Disc, Environment, Point, Shape, Wall, Wind, Zone

from ..environments.bounds import Bounds, bounds_of
from .options import Options

Colour = tuple[float, float, float]

_GROUND: Colour = (0.8, 0.8, 0.8)
_AREA: Colour = (0.2, 0.6, 0.2)
_ZONE: Colour = (0.9, 0.2, 0.2)
_WALL: Colour = (0.6, 0.55, 0.5)
_OBSTACLE: Colour = (0.45, 0.45, 0.5)
_TARGET: Colour = (0.95, 0.7, 0.1)

_TRANSLUCENT = 0.7
# An area without a height lies on the ground.
_SHEET = 0.02
_TARGET_RADIUS, _TARGET_HEIGHT = 0.2, 0.4
# The ground of an environment that has neither a size nor anything in it.
_UNBOUNDED = Bounds(-50.0, -50.0, 50.0, 50.0)


@dataclass(frozen=True)
class _Solid:
    """Box or cylinder: its size, middle in metres, and angle about z."""

    geometry: Element
    middle: tuple[float, float, float]
    yaw: float = 0.0


def lasting(wind: Wind) -> bool:
    """Return True if a wind blows for the whole run."""
    return wind.start == 0 and wind.end is None


def is_furnished(environment: Environment) -> bool:
    """Return True if there is anything in an environment that a world shows."""
    shown = (environment.areas, environment.zones, environment.walls, environment.obstacles)
    return any((*shown, environment.targets, environment.winds))


class World:
    """World of an environment; what has no height gets that of the environment, else of options."""

    def __init__(self, environment: Environment, options: Options = Options()) -> None:  # noqa: B008
        self._environment, self._thickness = environment, float(options.thickness)
        size = environment.size
        has_height = size is not None and len(size) > 2
        self._height = size[2] if size is not None and has_height else float(options.height)

    def sdf(self, version: str, name: str) -> Element:
        """Return the root of the file, with a world of this name."""
        environment = self._environment
        root = Element("sdf", {"version": version})
        world = root.add("world", {"name": name})
        world.comment(environment.doc)
        self._wind(world)
        _sun(world)
        self._ground(world)
        for area in environment.areas:
            top = area.box.lowest + _SHEET if area.box.highest is None else area.box.highest
            _marked(world, f"area_{area.name}", area, _solid(area.box, top), _AREA)
        for zone in environment.zones:
            solid = _solid(zone.box, self._top(zone.box.highest, zone.box.lowest))
            _marked(world, f"zone_{zone.name}", zone, solid, _ZONE)
        for number, wall in enumerate(environment.walls, start=1):
            link = _model(world, f"wall_{number}", wall.doc)
            for part, solid in enumerate(self._parts(wall), start=1):
                _body(link, f"{part}", solid, _WALL)
        for obstacle in environment.obstacles:
            link = _model(world, f"obstacle_{obstacle.name}", obstacle.doc)
            shape = obstacle.shape
            highest = shape.highest if isinstance(shape, Box) else shape.height
            lowest = shape.lowest if isinstance(shape, Box) else 0.0
            _body(link, "1", _solid(shape, self._top(highest, lowest)), _OBSTACLE)
        self._targets(world)
        return root

    def _top(self, highest: float | None, lowest: float = 0.0) -> float:
        """Return a height; what begins above the height of the environment goes on as far."""
        if highest is not None:
            return highest
        return self._height if lowest < self._height else lowest + self._height

    def _wind(self, world: Element) -> None:
        """Write the sum of the winds that never change."""
        winds = [wind for wind in self._environment.winds if lasting(wind)]
        if winds:
            x = sum(wind.speed * math.cos(wind.angle) for wind in winds)
            y = sum(wind.speed * math.sin(wind.angle) for wind in winds)
            world.add("wind").add("linear_velocity", text=_numbers(x, y, 0.0))

    def _ground(self, world: Element) -> None:
        bounds = bounds_of(self._environment) or _UNBOUNDED
        link = _model(world, "ground_plane", "")
        plane = Element("plane")
        plane.add("normal", text="0 0 1")
        # A plane without a length is no plane.
        plane.add("size", text=_numbers(bounds.width or 1.0, bounds.depth or 1.0))
        middle = ((bounds.left + bounds.right) / 2, (bounds.bottom + bounds.top) / 2, 0.0)
        _body(link, "1", _Solid(plane, middle), _GROUND)

    def _parts(self, wall: Wall) -> list[_Solid]:
        """Return a box for each part of a wall, as long as the part."""
        top = self._top(wall.height)
        return [
            self._part(start, end, top)
            for start, end in zip(wall.points, wall.points[1:], strict=False)
            if start != end
        ]

    def _part(self, start: Point, end: Point, top: float) -> _Solid:
        length = math.hypot(end.x - start.x, end.y - start.y)
        middle = ((start.x + end.x) / 2, (start.y + end.y) / 2, top / 2)
        yaw = math.atan2(end.y - start.y, end.x - start.x)
        return _Solid(_box(length, self._thickness, top), middle, yaw)

    def _targets(self, world: Element) -> None:
        """Write the targets at points; those of a kind are numbered on."""
        placed: Counter[str] = Counter()
        for targets in self._environment.targets:
            for at in targets.places:
                name = f"target_{targets.kind}_{placed[targets.kind]}"
                placed[targets.kind] += 1
                solid = _solid(Disc(at, _TARGET_RADIUS), _TARGET_HEIGHT)
                _visual(_model(world, name, targets.doc), "1", solid, _TARGET)


def _sun(world: Element) -> None:
    sun = world.add("light", {"name": "sun", "type": "directional"})
    sun.add("pose", text="0 0 100 0 0 0")
    sun.add("cast_shadows", text="true")
    sun.add("diffuse", text="0.8 0.8 0.8 1")
    sun.add("specular", text="0.2 0.2 0.2 1")
    sun.add("direction", text="-0.5 0.1 -0.9")


def _solid(shape: Shape, top: float) -> _Solid:
    """Return a shape from where it begins up to a height."""
    match shape:
        case Box(low=low, high=high, lowest=lowest):
            middle = ((low.x + high.x) / 2, (low.y + high.y) / 2, (lowest + top) / 2)
            return _Solid(_box(high.x - low.x, high.y - low.y, top - lowest), middle)
        case Disc(centre=at, radius=radius):
            cylinder = Element("cylinder")
            cylinder.add("radius", text=_numbers(radius))
            cylinder.add("length", text=_numbers(top))
            return _Solid(cylinder, (at.x, at.y, top / 2))


def _box(length: float, width: float, height: float) -> Element:
    box = Element("box")
    box.add("size", text=_numbers(length, width, height))
    return box


def _model(world: Element, name: str, doc: str) -> Element:
    """Return the link of a new model that does not move."""
    model = world.add("model", {"name": name})
    model.comment(doc)
    model.add("static", text="true")
    return model.add("link", {"name": "link"})


def _marked(world: Element, name: str, item: Area | Zone, solid: _Solid, colour: Colour) -> None:
    """Write what robots can see, but go through."""
    visual = _visual(_model(world, name, item.doc), "1", solid, colour)
    visual.add("transparency", text=_numbers(_TRANSLUCENT))
    visual.add("cast_shadows", text="false")


def _body(link: Element, number: str, solid: _Solid, colour: Colour) -> None:
    _placed(link, "collision", number, solid)
    _visual(link, number, solid, colour)


def _visual(link: Element, number: str, solid: _Solid, colour: Colour) -> Element:
    visual = _placed(link, "visual", number, solid)
    material = visual.add("material")
    for light in ("ambient", "diffuse"):
        material.add(light, text=_numbers(*colour, 1.0))
    return visual


def _placed(link: Element, tag: str, number: str, solid: _Solid) -> Element:
    element = link.add(tag, {"name": f"{tag}_{number}"})
    element.add("pose", text=_numbers(*solid.middle, 0.0, 0.0, solid.yaw))
    element.add("geometry").inside.append(solid.geometry)
    return element


def _numbers(*values: float) -> str:
    """Return numbers to a millionth: the last digits of sines differ between computers."""
    return " ".join(f"{round(value, 6) + 0.0:.12g}" for value in values)
