"""Map of a run: the environment, the trails of robots, their radio links, and what they found."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import NamedTuple
from xml.sax.saxutils import escape

from swarmdsl.base.xml_writer import legal
from swarmdsl.execution.simulate.scenario.durations import format_duration
from swarmdsl.ir.space import Box, Disc, Point

Place = tuple[float, float, float]
"""Coordinates in metres."""

_WIDEST = 880.0
_HIGHEST = 640.0
_MARGIN = 44.0
_TOP = 62.0
_ROW = 17.0
_LETTER = 6.4
_BARS = (0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000, 10000)
"""Lengths of the scale, in metres."""
# Colour scheme "bright", distinguishable by colour-blind people: Paul Tol, Colour Schemes,
# SRON/EPS/TN/09-002, issue 3.2.
_COLOURS = ("#4477aa", "#ee6677", "#228833", "#ccbb44", "#66ccee", "#aa3377", "#bbbbbb")
_STYLE = """
text { font: 11px "DejaVu Sans", Verdana, "Helvetica Neue", Arial, sans-serif; fill: #1f2430 }
.title { font-size: 17px; font-weight: bold }
.note { fill: #667085 }
.robot { font-size: 10px; paint-order: stroke; stroke: #ffffff; stroke-width: 3px }
.paper, .ground { fill: #ffffff }
.ground { stroke: #98a2b3 }
.area { fill: #eef4ea; stroke: #b6c7a8 }
.zone { fill: url(#forbidden); stroke: #c0362c }
.wall { stroke: #1f2430; stroke-width: 3; fill: none; stroke-linecap: square }
.obstacle { fill: #98a2b3; stroke: #667085 }
.link { stroke: #667085; stroke-width: 1; stroke-dasharray: 2 4 }
.trail { fill: none; stroke-width: 1.4; stroke-opacity: 0.55; stroke-linejoin: round }
.target { fill: none; stroke: #c0362c; stroke-width: 1.6 }
.found { fill: #c0362c; stroke: #c0362c; stroke-width: 1.6 }
.seen { stroke: #c0362c; stroke-width: 1.2 }
.lost { fill: none; stroke-width: 2 }
.scale { stroke: #1f2430; stroke-width: 2 }
@media (prefers-color-scheme: dark) {
text { fill: #e3e8ee }
.note { fill: #9aa5b4 }
.robot { stroke: #16191d }
.paper, .ground { fill: #16191d }
.area { fill: #1f2a1c; stroke: #4b5f3e }
.wall, .scale { stroke: #e3e8ee }
.obstacle { fill: #4b5563 }
.link { stroke: #9aa5b4 }
}
"""
DEFINITIONS = """<defs>
<pattern id="forbidden" width="8" height="8" patternUnits="userSpaceOnUse"
 patternTransform="rotate(45)">
<rect width="8" height="8" fill="#c0362c" opacity="0.08"/>
<rect width="2" height="8" fill="#c0362c" opacity="0.35"/>
</pattern>
</defs>"""


class Ground(NamedTuple):
    """Geometry of an environment: low and high corner, and named or nameless shapes."""

    low: Point
    high: Point
    areas: Sequence[tuple[str, Box]] = ()
    zones: Sequence[tuple[str, Box]] = ()
    walls: Sequence[Sequence[Point]] = ()
    obstacles: Sequence[tuple[str, Box | Disc]] = ()


class Track(NamedTuple):
    """Trail of a robot, each place with its time in nanoseconds; `lost` if it ended early."""

    name: str
    role: str
    places: Sequence[tuple[int, Place]]
    lost: bool = False


class Mark(NamedTuple):
    """Target at the end of a run, and whether somebody has found it."""

    name: str
    place: Place
    found: bool


class Sighting(NamedTuple):
    """Place from which a robot saw something, with its time in nanoseconds."""

    time: int
    robot: str
    what: str
    place: Place


class Moment(NamedTuple):
    """State of a run at a time in nanoseconds."""

    time: int
    tracks: Sequence[Track]
    targets: Sequence[Mark] = ()
    links: Sequence[tuple[Place, Place]] = ()
    sightings: Sequence[Sighting] = ()


def map_svg(title: str, ground: Ground, moment: Moment) -> str:
    """Draw the map of a run at a moment, with the trails that lead to it."""
    return MapDrawing(title, ground, moment).draw()


class MapDrawing:
    """Drawing of the map of a run at a moment."""

    style = _STYLE

    def __init__(self, title: str, ground: Ground, moment: Moment) -> None:
        self.title = title
        self.ground = ground
        self.moment = moment
        wide = max(ground.high.x - ground.low.x, 1e-3)
        deep = max(ground.high.y - ground.low.y, 1e-3)
        self.scale = min(_WIDEST / wide, _HIGHEST / deep)
        self.width, self.height = wide * self.scale, deep * self.scale
        self.roles = dict.fromkeys(track.role for track in moment.tracks)
        self.colours = {
            role: _COLOURS[place % len(_COLOURS)] for place, role in enumerate(self.roles)
        }
        self.parts: list[str] = []

    def x(self, x: float) -> float:
        """Return where a place is in the picture, from the left."""
        return _MARGIN + (x - self.ground.low.x) * self.scale

    def y(self, y: float) -> float:
        """Return where a place is in the picture, from the top."""
        return _TOP + self.height - (y - self.ground.low.y) * self.scale

    def draw(self) -> str:
        """Return the picture."""
        wide = self.width + 2 * _MARGIN
        high = _TOP + self.height + 30 + _ROW * (len(self.roles) + 1)
        size = f'width="{number(wide)}" height="{number(high)}"'
        size += f' viewBox="0 0 {number(wide)} {number(high)}"'
        self.parts = [
            f'<svg xmlns="http://www.w3.org/2000/svg" {size}>',
            f"<style>{self.style}</style>",
            DEFINITIONS,
            '<rect class="paper" width="100%" height="100%"/>',
        ]
        self.text(16, 26, self.title, "title")
        self.text(16, 44, ", ".join(self.words()), "note")
        self.shapes()
        self.contents()
        self.legend()
        return "\n".join([*self.parts, "</svg>", ""])

    @property
    def left(self) -> float:
        """Left end of the ground."""
        return _MARGIN

    @property
    def bottom(self) -> float:
        """Lower end of the ground."""
        return _TOP + self.height

    def contents(self) -> None:
        """Draw what is on the ground."""
        for one, other in self.moment.links:
            self.line("link", one[0], one[1], other[0], other[1])
        for track in self.moment.tracks:
            self.trail(track)
        self.marks()
        for track in self.moment.tracks:
            self.robot(track)

    def words(self) -> list[str]:
        """Return what is said below the title."""
        words = [f"after {format_duration(self.moment.time)}"]
        if self.moment.targets:
            found = sum(each.found for each in self.moment.targets)
            words.append(f"{found} of {len(self.moment.targets)} targets found")
        return words

    def shapes(self) -> None:
        """Draw the environment."""
        low, high = self.ground.low, self.ground.high
        self.box("ground", Box(low, high))
        for style, named in (("area", self.ground.areas), ("zone", self.ground.zones)):
            for name, box in named:
                self.box(style, box, f"{style} {name}")
                self.text(self.x(box.low.x) + 4, self.y(box.high.y) + 12, name, "note")
        for name, shape in self.ground.obstacles:
            if isinstance(shape, Box):
                self.box("obstacle", shape, name or "obstacle")
            else:
                self.circle("obstacle", shape.centre, shape.radius * self.scale, name or "obstacle")
        for wall in self.ground.walls:
            self.polyline("wall", [(point.x, point.y) for point in wall])

    def trail(self, track: Track) -> None:
        """Draw the way of a robot."""
        ways = [(x, y) for _, (x, y, _) in track.places]
        if len(set(ways)) > 1:
            self.polyline("trail", _thinned(ways, 0.5 / self.scale), self.colours[track.role])

    def marks(self) -> None:
        """Draw the targets, and from where they have been seen."""
        for mark in self.moment.targets:
            x, y, size = self.x(mark.place[0]), self.y(mark.place[1]), 5.0
            corners = ((x, y - size), (x + size, y), (x, y + size), (x - size, y))
            points = " ".join(f"{number(left)},{number(top)}" for left, top in corners)
            style, said = ("found", "found") if mark.found else ("target", "not found")
            self.parts.append(
                f'<polygon class="{style}" points="{points}">'
                f"<title>{plain_text(mark.name)}: {said}</title></polygon>"
            )
        for seen in self.moment.sightings:
            title = f"{seen.robot} sees {seen.what} at {format_duration(seen.time)}"
            cross = self.cross(self.x(seen.place[0]), self.y(seen.place[1]))
            self.parts.append(
                f'<path class="seen" d="{cross}"><title>{plain_text(title)}</title></path>'
            )

    def cross(self, x: float, y: float) -> str:
        """Return the path of a cross around a place in the picture."""
        side = 7.0
        start = f"M{number(x - side / 2)},{number(y - side / 2)}"
        return f"{start} l{side:g},{side:g} m0,-{side:g} l-{side:g},{side:g}"

    def robot(self, track: Track) -> None:
        """Draw a robot where it is."""
        if not track.places:
            return
        x, y, z = track.places[-1][1]
        colour, point = self.colours[track.role], Point(x, y)
        title = f"{track.name}: ({number(x)} m, {number(y)} m), {number(z)} m above ground"
        if track.lost:
            self.circle("lost", point, 5, f"{title}, lost", f'stroke="{colour}"')
        else:
            self.circle("there", point, 5, title, f'fill="{colour}"')
        self.text(self.x(x) + 7, self.y(y) + 4, track.name, "robot")

    def legend(self) -> None:
        """Draw the scale and the colours of roles."""
        top = _TOP + self.height + 22
        length = max((bar for bar in _BARS if bar * self.scale <= self.width / 4), default=_BARS[0])
        end = _MARGIN + length * self.scale
        ends = f'x1="{number(_MARGIN)}" y1="{number(top)}" x2="{number(end)}" y2="{number(top)}"'
        self.parts.append(f'<line class="scale" {ends}/>')
        self.text(end + 8, top + 4, f"{length:g} m", "note")
        for role in self.roles:
            top += _ROW
            fill = f'fill="{self.colours[role]}"'
            self.parts.append(
                f'<circle cx="{number(_MARGIN + 5)}" cy="{number(top)}" r="5" {fill}/>'
            )
            count = sum(track.role == role for track in self.moment.tracks)
            self.text(_MARGIN + 16, top + 4, f"{role} ({count})", "note")

    # ---- shapes

    def text(self, x: float, y: float, text: str, style: str) -> None:
        """Add a line of text."""
        self.parts.append(
            f'<text class="{style}" x="{number(x)}" y="{number(y)}">{plain_text(text)}</text>'
        )

    def line(self, style: str, x: float, y: float, to_x: float, to_y: float) -> None:
        """Add a line between two places."""
        first = f'x1="{number(self.x(x))}" y1="{number(self.y(y))}"'
        last = f'x2="{number(self.x(to_x))}" y2="{number(self.y(to_y))}"'
        self.parts.append(f'<line class="{style}" {first} {last}/>')

    def box(self, style: str, box: Box, title: str = "") -> None:
        """Add a rectangle."""
        place = f'x="{number(self.x(box.low.x))}" y="{number(self.y(box.high.y))}"'
        wide, high = (box.high.x - box.low.x) * self.scale, (box.high.y - box.low.y) * self.scale
        self.parts.append(
            f'<rect class="{style}" {place} width="{number(wide)}" height="{number(high)}">'
            f"<title>{plain_text(title)}</title></rect>"
        )

    def circle(self, style: str, at: Point, radius: float, title: str, colour: str = "") -> None:
        """Add a circle."""
        self.parts.append(
            f'<circle class="{style}" cx="{number(self.x(at.x))}" cy="{number(self.y(at.y))}" '
            f'r="{number(radius)}" {colour}><title>{plain_text(title)}</title></circle>'
        )

    def polyline(self, style: str, ways: Iterable[tuple[float, float]], colour: str = "") -> None:
        """Add a line through several places."""
        points = " ".join(f"{number(self.x(x))},{number(self.y(y))}" for x, y in ways)
        stroke = f' stroke="{colour}"' if colour else ""
        self.parts.append(f'<polyline class="{style}" points="{points}"{stroke}/>')


def _thinned(ways: Sequence[tuple[float, float]], least: float) -> list[tuple[float, float]]:
    """Return a trail without places that are nearer than `least` to the one before."""
    kept = [ways[0]]
    for x, y in ways[1:]:
        if abs(x - kept[-1][0]) > least or abs(y - kept[-1][1]) > least:
            kept.append((x, y))
    if kept[-1] != ways[-1]:
        kept.append(ways[-1])
    return kept


def plain_text(text: str) -> str:
    """Escape a string as text of XML."""
    return escape(legal(text))


def number(value: float) -> str:
    """Format a number with at most two decimals."""
    return f"{value:.2f}".rstrip("0").rstrip(".")
