"""Animation of a run on its map, as SVG that plays by itself, without scripts.

Everything repeats with one period, that of the whole run, so that a player can set the time of the
picture: see `player.py`.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Sequence
from itertools import pairwise
from math import hypot
from typing import NamedTuple

from swarmdsl.execution.simulate.pictures.map_svg import (
    Ground,
    MapDrawing,
    Moment,
    Sighting,
    Track,
    number,
    plain_text,
)
from swarmdsl.execution.simulate.scenario.durations import SECOND, format_duration

_LONGEST = 60.0
"""Greatest number of seconds that it takes to play a run."""
_PACES = (1, 2, 5, 10, 20, 30, 60, 120, 300, 600, 1200, 3600)
_NEAR = 0.3
"""Distance in pixels by which a place may be off."""
_WINDOW = 40
"""Greatest number of places that one straight line stands for."""
_FLASH = 0.8
"""Seconds of the picture for which a sighting stands out."""
_MOST_LINKS = 2000
_STYLE = """
.flash { fill: none; stroke: #c0362c; stroke-width: 2 }
.past { fill: #4477aa }
.time { fill: none; stroke: #98a2b3 }
"""


class Film(NamedTuple):
    """A run with its times, in nanoseconds.

    `absences` are the times from which on robots of tracks are lost, and until when, if they come
    back; `targets` are tracks without a role, with the time at which somebody has found each;
    `links` connect two tracks by their numbers.
    """

    end: int
    tracks: Sequence[Track]
    absences: Sequence[Sequence[tuple[int, int | None]]] = ()
    targets: Sequence[tuple[Track, int | None]] = ()
    links: Sequence[tuple[int, int, int, int]] = ()
    sightings: Sequence[Sighting] = ()


class Timing(NamedTuple):
    """Time of a picture: its period, and the run's, both in seconds."""

    period: float
    run: float

    @property
    def pace(self) -> float:
        """Seconds of the run in a second of the picture."""
        return self.run / self.period


def timing_of(end: int) -> Timing:
    """Return how fast a run is played: in at most a minute, unless it is many hours long."""
    run = max(end / SECOND, 0.001)
    pace = next((each for each in _PACES if run / each <= _LONGEST), _PACES[-1])
    return Timing(run / pace, run)


def map_animation(title: str, ground: Ground, film: Film) -> str:
    """Draw the map of a run that repeats for ever, with trails that grow."""
    return _Animation(title, ground, film).draw()


class _Animation(MapDrawing):
    style = MapDrawing.style + _STYLE

    def __init__(self, title: str, ground: Ground, film: Film) -> None:
        super().__init__(title, ground, Moment(film.end, film.tracks))
        self.film = film
        self.timing = timing_of(film.end)
        self.every = f'dur="{self.timing.period:.6g}s" repeatCount="indefinite"'
        self.ways = [self.way(track) for track in film.tracks]

    def words(self) -> list[str]:
        said = [format_duration(self.film.end)]
        if self.timing.pace != 1:
            said.append(f"{self.timing.pace:g} times as fast")
        if self.film.targets:
            found = sum(time is not None for _, time in self.film.targets)
            said.append(f"{found} of {len(self.film.targets)} targets found")
        if len(self.film.links) > _MOST_LINKS:
            said.append(f"the first {_MOST_LINKS} radio links are drawn")
        return said

    def contents(self) -> None:
        for link in self.film.links[:_MOST_LINKS]:
            self.link(*link)
        for track, way in zip(self.film.tracks, self.ways, strict=True):
            self.growing(track, way)
        for track, found in self.film.targets:
            self.target(track, found)
        for seen in self.film.sightings:
            self.sighting(seen)
        absences = self.film.absences or [()] * len(self.film.tracks)
        for track, way, gaps in zip(self.film.tracks, self.ways, absences, strict=True):
            self.robot_on(track, way, gaps)

    def legend(self) -> None:
        super().legend()
        place = f'x="{number(self.left)}" y="{number(self.bottom + 8)}"'
        wide = f'width="{number(self.width)}" height="4"'
        self.parts.append(f'<rect class="time" {place} {wide}/>')
        grows = f'<animate attributeName="width" values="0;{number(self.width)}" {self.every}/>'
        self.parts.append(f'<rect class="past" {place} {wide}>{grows}</rect>')

    # ---- what is in the picture

    def way(self, track: Track) -> list[tuple[int, float, float]]:
        """Return the times and places of a robot in the picture between which it goes straight."""
        return _straightened([(t, self.x(x), self.y(y)) for t, (x, y, _) in track.places])

    def growing(self, track: Track, way: Sequence[tuple[int, float, float]]) -> None:
        """Draw a trail that ends where the robot is."""
        lengths = [0.0]
        for (_, x, y), (_, to_x, to_y) in pairwise(way):
            lengths.append(lengths[-1] + hypot(to_x - x, to_y - y))
        if not lengths[-1]:
            return
        left = [1 - length / lengths[-1] for length in lengths]
        samples = [(t, f"{each:.4f}") for (t, _, _), each in zip(way, left, strict=True)]
        points = " ".join(f"{number(x)},{number(y)}" for _, x, y in way)
        self.parts.append(
            f'<polyline class="trail" points="{points}" stroke="{self.colours[track.role]}" '
            f'pathLength="1" stroke-dasharray="1">{self.course("stroke-dashoffset", samples)}'
            "</polyline>"
        )

    def robot_on(
        self,
        track: Track,
        way: Sequence[tuple[int, float, float]],
        gaps: Sequence[tuple[int, int | None]],
    ) -> None:
        """Draw a robot on its way; a lost one is hollow."""
        if not way:
            return
        colour = self.colours[track.role]
        self.parts.append(f"<g {_moved(way[-1])}>{self.motion(way)}")
        self.parts.append(f"<title>{plain_text(track.name)}</title>")
        changes = [(0, True)]
        for start, end in gaps:
            changes += [(start, False), *([(end, True)] if end is not None else [])]
        there = self.shown(changes) if gaps else ""
        self.parts.append(f'<circle class="there" r="5" fill="{colour}">{there}</circle>')
        if gaps:
            lost = self.shown([(time, not shown) for time, shown in changes])
            self.parts.append(f'<circle class="lost" r="5" stroke="{colour}">{lost}</circle>')
        self.parts.append(f'<text class="robot" x="7" y="4">{plain_text(track.name)}</text></g>')

    def target(self, track: Track, found: int | None) -> None:
        """Draw a target, filled from when somebody has found it, and where it is taken to."""
        way = self.way(track)
        if not way:
            return
        said = "not found" if found is None else f"found at {format_duration(found)}"
        moving = self.motion(way) if len({place[1:] for place in way}) > 1 else ""
        shape = 'points="0,-5 5,0 0,5 -5,0"'
        seen = ""
        if found is not None:
            shown = self.shown([(0, False), (found, True)] if found else [(0, True)])
            seen = f'<polygon class="found" {shape}>{shown}</polygon>'
        self.parts.append(
            f"<g {_moved(way[-1])}>{moving}<title>{plain_text(track.name)}: {said}</title>"
            f'<polygon class="target" {shape}/>{seen}</g>'
        )

    def sighting(self, seen: Sighting) -> None:
        """Draw a cross from when a robot sees something, and a ring when it does."""
        x, y = self.x(seen.place[0]), self.y(seen.place[1])
        title = f"{seen.robot} sees {seen.what} at {format_duration(seen.time)}"
        stays = self.shown([(0, False), (seen.time, True)] if seen.time else [(0, True)])
        until = seen.time + round(_FLASH * self.timing.pace * SECOND)
        changes = [(seen.time, True), *([(until, False)] if until < self.film.end else [])]
        flash = self.shown([*([(0, False)] if seen.time else []), *changes])
        place = f'cx="{number(x)}" cy="{number(y)}" r="11"'
        ring = f'<circle class="flash" visibility="hidden" {place}>{flash}</circle>'
        self.parts.append(
            f'<path class="seen" d="{self.cross(x, y)}"><title>{plain_text(title)}</title>'
            f"{stays}</path>{ring}"
        )

    def link(self, one: int, other: int, start: int, end: int) -> None:
        """Draw a line between two robots while they reach each other."""
        ways = self.ways[one], self.ways[other]
        if not ways[0] or not ways[1]:
            return
        times = {start, end}
        for way in ways:
            times.update(t for t, _, _ in way if start < t < end)
        samples = []
        for time in sorted(times):
            (x, y), (to_x, to_y) = (_at(way, time) for way in ways)
            samples.append((time, f"M{number(x)},{number(y)}L{number(to_x)},{number(to_y)}"))
        changes = [*([(0, False)] if start else []), (start, True)]
        changes += [(end, False)] if end < self.film.end else []
        title = f"{self.film.tracks[one].name} and {self.film.tracks[other].name}"
        self.parts.append(
            f'<path class="link" d="{samples[-1][1]}"><title>{plain_text(title)}</title>'
            f"{self.course('d', samples)}{self.shown(changes)}</path>"
        )

    # ---- values over time

    def motion(self, way: Sequence[tuple[int, float, float]]) -> str:
        """Return how an element moves along a way."""
        values = [(t, f"{number(x)},{number(y)}") for t, x, y in way]
        tag = 'animateTransform attributeName="transform" type="translate"'
        return f"<{tag} {self.keys(values, whole=True)} {self.every}/>"

    def course(self, attribute: str, values: Sequence[tuple[int, str]]) -> str:
        """Return how an attribute goes from each value to the next one."""
        keys = self.keys(values, whole=True)
        return f'<animate attributeName="{attribute}" {keys} {self.every}/>'

    def shown(self, changes: Sequence[tuple[int, bool]]) -> str:
        """Return from when on an element is shown or hidden; the first change is at 0."""
        values = [(time, "visible" if shown else "hidden") for time, shown in changes]
        keys = self.keys(values, whole=False)
        how = 'attributeName="visibility" calcMode="discrete"'
        return f"<animate {how} {keys} {self.every}/>"

    def keys(self, values: Sequence[tuple[int, str]], *, whole: bool) -> str:
        """Return values with their shares of the period; those of a `whole` one end at its end."""
        kept = list(values)
        if kept[0][0] > 0:
            kept.insert(0, (0, kept[0][1]))
        if whole and kept[-1][0] < self.film.end:
            kept.append((self.film.end, kept[-1][1]))
        shares = [min(time / max(self.film.end, 1), 1.0) for time, _ in kept]
        if whole:
            shares[-1] = 1.0
            if len(kept) == 1:
                kept, shares = kept * 2, [0.0, 1.0]
        times = ";".join(f"{share:.6f}".rstrip("0").rstrip(".") for share in shares)
        return f'values="{";".join(value for _, value in kept)}" keyTimes="{times}"'


def _moved(place: tuple[int, float, float]) -> str:
    return f'transform="translate({number(place[1])},{number(place[2])})"'


def _straightened(way: Sequence[tuple[int, float, float]]) -> list[tuple[int, float, float]]:
    """Return a way without places that are between two others, at the right time."""
    kept = list(way[:1])
    first, last = 0, 1
    while last < len(way):
        following = last + 1
        if (
            following >= len(way)
            or following - first > _WINDOW
            or not _passes(way[first : following + 1])
        ):
            kept.append(way[last])
            first = last
        last = following
    return kept


def _passes(way: Sequence[tuple[int, float, float]]) -> bool:
    """Return True if all places are near a straight way from the first to the last."""
    (start, x, y), (end, to_x, to_y) = way[0], way[-1]
    for time, at_x, at_y in way[1:-1]:
        share = (time - start) / (end - start)
        if abs(x + share * (to_x - x) - at_x) > _NEAR or abs(y + share * (to_y - y) - at_y) > _NEAR:
            return False
    return True


def _at(way: Sequence[tuple[int, float, float]], time: int) -> tuple[float, float]:
    """Return the place on a way at a time."""
    after = bisect_left(way, time, key=lambda each: each[0])
    if after == 0 or after == len(way):
        return way[min(after, len(way) - 1)][1:]
    (start, x, y), (end, to_x, to_y) = way[after - 1], way[after]
    share = (time - start) / (end - start)
    return x + share * (to_x - x), y + share * (to_y - y)
