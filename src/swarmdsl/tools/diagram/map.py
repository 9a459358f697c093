"""Maps of environments as SVG: areas, zones, walls, obstacles, targets, and starts of robots."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from xml.sax.saxutils import escape, quoteattr

from swarmdsl.base.records import dataclass
from swarmdsl.base.source import Span
from swarmdsl.base.xml_writer import legal
from swarmdsl.codegen.swarm_printer.space import metres, text
from swarmdsl.ir import (
    Area,
    Box,
    Disc,
    Environment,
    Obstacle,
    Point,
    Shape,
    Swarm,
    System,
    Targets,
    Wall,
    Zone,
)
from swarmdsl.tools.diagram.svg import style

_LONGEST = 640.0
_MARGIN = 28.0
_CROSS, _DOT = 5.0, 4.0

Link = Callable[[Span | None], str | None]


@dataclass(frozen=True)
class Map:
    """Map of an environment with the robots of the swarms that are in it."""

    environment: Environment
    swarms: tuple[Swarm, ...]

    @property
    def name(self) -> str:
        """Name of the environment."""
        return self.environment.name

    @property
    def stem(self) -> str:
        """Name of a file with the map, without the suffix."""
        return f"{self.name}.map"

    def svg(self, link: Link | None = None) -> str:
        """Return the map as a file, or as a part of an HTML page if `link` is given."""
        return "\n".join([*_Writer(self, link).lines(), ""])


def maps(system: System) -> Iterator[Map]:
    """Yield the map of each environment that has a place for something."""
    for environment in system.environments:
        if _points(environment):
            swarms = (each for each in system.swarms if each.environment == environment.name)
            yield Map(environment, tuple(swarms))


def _points(environment: Environment) -> list[Point]:
    """Return the outermost points of all that has a place."""
    found = [point for wall in environment.walls for point in wall.points]
    found += [point for targets in environment.targets for point in targets.places]
    shapes: list[Shape] = [item.shape for item in environment.obstacles]
    shapes += [item.box for item in environment.areas]
    shapes += [item.box for item in environment.zones]
    for shape in shapes:
        match shape:
            case Box(low=low, high=high):
                found += [low, high]
            case Disc(centre=centre, radius=radius):
                found.append(Point(centre.x - radius, centre.y - radius))
                found.append(Point(centre.x + radius, centre.y + radius))
    return found


class _Writer:
    def __init__(self, drawn: Map, link: Link | None) -> None:
        self._map, self._link = drawn, link
        size, points = drawn.environment.size, _points(drawn.environment)
        self._left = 0.0 if size else min(point.x for point in points)
        self._bottom = 0.0 if size else min(point.y for point in points)
        self._right = size[0] if size else max(point.x for point in points)
        self._top = size[1] if size else max(point.y for point in points)
        wide, high = self._right - self._left, self._top - self._bottom
        self._scale = _LONGEST / (max(wide, high) or 1.0)
        self._width, self._height = wide * self._scale, high * self._scale

    def lines(self) -> Iterator[str]:
        environment = self._map.environment
        role = "img" if self._link is None else "group"
        width, height = self._width + 2 * _MARGIN, self._height + 2 * _MARGIN
        yield (
            f'<svg xmlns="http://www.w3.org/2000/svg" class="swarm-diagram" role="{role}" '
            f'width="{width:g}" height="{height:g}" '
            f'viewBox="{-_MARGIN:g} {-_MARGIN:g} {width:g} {height:g}">'
        )
        yield f"<title>environment {_escaped(environment.name)}</title>"
        if environment.doc:
            yield f"<desc>{_escaped(environment.doc)}</desc>"
        if self._link is None:
            yield f"<style>{style()}</style>"
        paper = f'x="{-_MARGIN:g}" y="{-_MARGIN:g}" width="{width:g}" height="{height:g}"'
        yield f'<rect class="paper" {paper}/>'
        yield f'<rect class="border" width="{self._width:.5g}" height="{self._height:.5g}"/>'
        yield from self._scale_texts()
        for area in environment.areas:
            shape = self._shape(area.box, 'class="nest" stroke-dasharray="6 4"')
            yield from self._item(area, shape, area.name, self._corner(area.box))
        for zone in environment.zones:
            shape = self._shape(zone.box, 'class="outline" stroke-dasharray="2 3"')
            crossed = f"no entry: {zone.name}"
            yield from self._item(zone, shape, crossed, self._corner(zone.box))
        for obstacle in environment.obstacles:
            shape = self._shape(obstacle.shape, 'class="box"')
            yield from self._item(obstacle, shape, obstacle.name, self._corner(obstacle.shape))
        for wall in environment.walls:
            corners = " ".join(f"{x:.5g},{y:.5g}" for x, y in map(self._at, wall.points))
            line = f'<polyline class="border" stroke-width="3" points="{corners}"/>'
            yield from self._item(wall, line)
        for targets in environment.targets:
            yield from self._targets(targets)
        for swarm in self._map.swarms:
            yield from self._starts(swarm)
        yield "</svg>"

    def _at(self, point: Point) -> tuple[float, float]:
        """Return the place of a point: y counts downwards in SVG."""
        return (point.x - self._left) * self._scale, (self._top - point.y) * self._scale

    def _shape(self, shape: Shape, attributes: str) -> str:
        match shape:
            case Box(low=low, high=high):
                (left, bottom), (right, top) = self._at(low), self._at(high)
                return (
                    f'<rect {attributes} x="{left:.5g}" y="{top:.5g}" '
                    f'width="{right - left:.5g}" height="{bottom - top:.5g}"/>'
                )
            case Disc(centre=centre, radius=radius):
                x, y = self._at(centre)
                place = f'cx="{x:.5g}" cy="{y:.5g}" r="{radius * self._scale:.5g}"'
                return f"<circle {attributes} {place}/>"

    def _corner(self, shape: Shape) -> tuple[float, float]:
        """Return the place of the name of a shape."""
        match shape:
            case Box(low=low, high=high):
                x, y = self._at(Point(low.x, high.y))
                return x + 4, y + 14
            case Disc(centre=centre, radius=radius):
                x, y = self._at(centre)
                return x + radius * self._scale + 4, y + 4

    def _item(
        self,
        item: Area | Zone | Wall | Obstacle | Targets,
        shape: str,
        name: str = "",
        at: tuple[float, float] = (0.0, 0.0),
    ) -> Iterator[str]:
        """Yield a shape with its name, and all that the model says about it as a title."""
        url = self._link(item.origin) if self._link is not None else None
        yield f"<a href={quoteattr(url)}>" if url is not None else "<g>"
        yield f"<title>{_escaped(text(item))}</title>"
        yield shape
        if name:
            yield _label(name, at)
        yield "</a>" if url is not None else "</g>"

    def _targets(self, targets: Targets) -> Iterator[str]:
        """Yield the targets at points; those at random have no place."""
        for number, place in enumerate(targets.places):
            x, y = self._at(place)
            x0, y0, side = x - _CROSS, y - _CROSS, 2 * _CROSS
            lines = f"M{x0:.5g} {y0:.5g}l{side:g} {side:g}m0 {-side:g}l{-side:g} {side:g}"
            cross = f'<path class="border" stroke-width="2" d="{lines}"/>'
            name = targets.kind if number == 0 else ""
            yield from self._item(targets, cross, name, (x + 8, y + 4))

    def _starts(self, swarm: Swarm) -> Iterator[str]:
        for role in swarm.roles:
            starts = [(role.name, role.start)]
            starts += [(f"{role.name}[{each.index}]", each.start) for each in role.robots]
            for name, start in starts:
                if isinstance(start, Point):
                    x, y = self._at(start)
                    yield f'<circle class="solid" cx="{x:.5g}" cy="{y:.5g}" r="{_DOT:g}"/>'
                    yield _label(name, (x + 8, y + 4))

    def _scale_texts(self) -> Iterator[str]:
        yield _label(f"({metres(self._left)}, {metres(self._bottom)})", (0.0, self._height + 16))
        corner = f"({metres(self._right)}, {metres(self._top)})"
        yield _label(corner, (self._width, -6.0), "end")


def _label(name: str, at: tuple[float, float], anchor: str = "start") -> str:
    x, y = at
    words = _escaped(name)
    return f'<text class="label" x="{x:.5g}" y="{y:.5g}" text-anchor="{anchor}">{words}</text>'


def _escaped(words: str) -> str:
    return escape(legal(words))
