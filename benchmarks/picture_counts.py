"""Count what makes a laid-out diagram hard to read.

The counts need only rectangles and lines at right angles, so that they are the same for pictures
of swarmdsl and of other programs.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import combinations, pairwise

from swarmdsl.tools.diagram.layout import Picture

Point = tuple[float, float]
Area = tuple[float, float, float, float]
"""Left, top, right and bottom."""

JOG = 14
"""Length below which a part of a line between two bends looks like a mistake."""
NEAR = 3
"""Distance at which a line and a rule look like one."""
HEADS = 10
"""Distance at which two arrow heads look like one."""


@dataclass
class Drawing:
    """Lines with their labels, and the rules in boxes as (left, right, y).

    `has_head` is False for lines without an arrow head at their end.
    """

    width: float
    height: float
    rules: list[tuple[float, float, float]] = field(default_factory=list)
    lines: list[Sequence[Point]] = field(default_factory=list)
    has_head: list[bool] = field(default_factory=list)
    labels: list[Area | None] = field(default_factory=list)


@dataclass(frozen=True)
class Counts:
    """Measures of a drawing; lengths are in pixels, the distance is a mean."""

    width: int
    height: int
    crossings: int
    bends: int
    jogs: int
    on_rules: int
    head_to_head: int
    labels: int
    label_distance: float
    length: int


def drawing_of(picture: Picture) -> Drawing:
    """Return what is counted of a picture of swarmdsl."""
    found = Drawing(picture.width, picture.height)
    for box in picture.boxes:
        heights = list(box.block.rules) if box.node.kind != "frame" else []
        if box.node.nodes and box.node.kind not in ("frame", "region"):
            heights.append(box.block.height)
        found.rules += ((box.x, box.x + box.width, box.y + height) for height in heights)
    for line in picture.lines:
        found.lines.append(line.points)
        found.has_head.append(line.edge.kind not in ("composition", "association"))
        label = line.label
        x, y = line.label_x, line.label_y
        found.labels.append((x, y, x + label.width, y + label.height) if label else None)
    return found


def counts(drawing: Drawing) -> Counts:
    """Count everything in a drawing."""
    distances = [
        _distance(line[0], label)
        for line, label in zip(drawing.lines, drawing.labels, strict=True)
        if label is not None
    ]
    return Counts(
        round(drawing.width),
        round(drawing.height),
        len(crossings(drawing)),
        sum(max(0, len(line) - 2) for line in drawing.lines),
        len(jogs(drawing)),
        len(on_rules(drawing)),
        len(head_to_head(drawing)),
        len(distances),
        sum(distances) / max(len(distances), 1),
        round(sum(_length(one, other) for line in drawing.lines for one, other in pairwise(line))),
    )


def crossings(drawing: Drawing) -> list[tuple[int, int]]:
    """Return the pairs of lines that cross, as often as they do."""
    flat, upright = [], []
    for number, line in enumerate(drawing.lines):
        for one, other in pairwise(line):
            if abs(one[1] - other[1]) < abs(one[0] - other[0]):
                flat.append((one[1], *sorted((one[0], other[0])), number))
            else:
                upright.append((one[0], *sorted((one[1], other[1])), number))
    flat.sort()
    return [
        (number, by)
        for y, left, right, number in flat
        for x, top, bottom, by in upright
        if number != by and left < x < right and top < y < bottom
    ]


def jogs(drawing: Drawing) -> list[int]:
    """Return the lines with a short part between two bends, once for each."""
    return [
        number
        for number, line in enumerate(drawing.lines)
        for one, other in list(pairwise(line))[1:-1]
        if _length(one, other) < JOG
    ]


def on_rules(drawing: Drawing) -> list[int]:
    """Return the lines of which a part continues a rule or lies on it."""
    return [
        number
        for number, line in enumerate(drawing.lines)
        for one, other in pairwise(line)
        if abs(one[1] - other[1]) < abs(one[0] - other[0])
        for left, right, y in drawing.rules
        if abs(one[1] - y) < NEAR
        and min(one[0], other[0]) <= right
        and max(one[0], other[0]) >= left
    ]


def head_to_head(drawing: Drawing) -> list[tuple[int, int]]:
    """Return the pairs of lines whose arrow heads point at each other."""
    tips = [
        (number, line[-1], _direction(line[-2], line[-1]))
        for number, line in enumerate(drawing.lines)
        if drawing.has_head[number]
    ]
    return [
        (number, by)
        for (number, tip, way), (by, other, back) in combinations(tips, 2)
        if way == (-back[0], -back[1])
        and abs(tip[0] - other[0]) < HEADS
        and abs(tip[1] - other[1]) < HEADS
    ]


def _length(one: Point, other: Point) -> float:
    return abs(one[0] - other[0]) + abs(one[1] - other[1])


def _direction(one: Point, other: Point) -> tuple[int, int]:
    dx, dy = other[0] - one[0], other[1] - one[1]
    if abs(dx) > abs(dy):
        return (1 if dx > 0 else -1), 0
    return 0, (1 if dy > 0 else -1)


def _distance(point: Point, area: Area) -> float:
    """Distance from a point to an area, horizontally plus vertically."""
    left, top, right, bottom = area
    return max(left - point[0], 0, point[0] - right) + max(top - point[1], 0, point[1] - bottom)
