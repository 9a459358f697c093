"""Target `nav2_map`: each cell of a map is occupied if something reaches into it."""

from __future__ import annotations

import math
import random
import re
from collections.abc import Callable
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest
import yaml

from swarmdsl.codegen.api import Support
from swarmdsl.codegen.emit import Request
from swarmdsl.codegen.registry import load
from swarmdsl.driver import pipeline

FIELD = Path(__file__).parent / "field.swarm"
GOLDEN = Path(__file__).parent / "golden"

Cells = list[list[bool]]
# x0, y0, x1, y1
Cell = tuple[float, float, float, float]
# How far a cell is from a shape, and up to which distance it is occupied.
Shape = tuple[Callable[[Cell], float], float]


def build(path: Path, out: Path, **options: str) -> pipeline.Result:
    return pipeline.build([path], [Request("nav2_map", options)], out)


def made_of(text: str, folder: Path, **options: str) -> list[Any]:
    path = folder / "model.swarm"
    path.write_text(f"package p\n{text}\n", encoding="utf-8")
    # Names are as hostile as they are.
    return [each for each in build(path, folder / "out", **options).report if each.code != "SW0206"]


def read(folder: Path, name: str) -> tuple[dict[str, Any], Cells]:
    """Return the description of a map, and its occupied cells in rows from the bottom."""
    folder = folder / "nav2_map"
    about = yaml.safe_load((folder / f"{name}.yaml").read_text("utf-8"))
    text = (folder / about["image"]).read_text("ascii")
    assert all(len(line) <= 70 for line in text.splitlines())
    kind, width, height, white, *values = text.split()
    assert (kind, white) == ("P2", "255")
    assert len(values) == int(width) * int(height)
    cells = []
    for value in map(int, values):
        # As the map servers compute it.
        share = value / 255 if about["negate"] else (255 - value) / 255
        assert share > about["occupied_thresh"] or share < about["free_thresh"]
        cells.append(share > about["occupied_thresh"])
    rows = [cells[at : at + int(width)] for at in range(0, len(cells), int(width))]
    return about, rows[::-1]


def drawn(cells: Cells) -> list[str]:
    return ["".join(".#"[cell] for cell in row) for row in reversed(cells)]


def from_point(x: float, y: float, cell: Cell) -> float:
    x0, y0, x1, y1 = cell
    return math.hypot(max(x0 - x, 0, x - x1), max(y0 - y, 0, y - y1))


def from_line(start: tuple[float, float], end: tuple[float, float], cell: Cell) -> float:
    """Return the distance of a cell from a line between two points."""
    x0, y0, x1, y1 = cell
    (ax, ay), (bx, by) = start, end
    dx, dy = bx - ax, by - ay
    first, last = 0.0, 1.0
    for at, step, low, high in ((ax, dx, x0, x1), (ay, dy, y0, y1)):
        if step == 0:
            if not low <= at <= high:
                last = -1.0
        else:
            near, far = sorted(((low - at) / step, (high - at) / step))
            first, last = max(first, near), min(last, far)
    if first <= last:
        return 0.0
    found = [from_point(ax, ay, cell), from_point(bx, by, cell)]
    for x, y in ((x0, y0), (x0, y1), (x1, y0), (x1, y1)):
        along = max(0.0, min(1.0, ((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy)))
        found.append(math.hypot(ax + along * dx - x, ay + along * dy - y))
    return min(found)


def from_box(low: tuple[float, float], high: tuple[float, float], cell: Cell) -> float:
    """Return the distance of a cell from a box, below 0 if it reaches into it."""
    x0, y0, x1, y1 = cell
    return max(low[0] - x1, x0 - high[0], low[1] - y1, y0 - high[1])


def test_files_are_as_before(tmp_path: Path, bless: bool) -> None:
    build(FIELD, tmp_path, resolution="0.5")
    files = {path.name: path.read_text("utf-8") for path in tmp_path.glob("nav2_map/*")}
    if bless:
        for name, text in files.items():
            (GOLDEN / name).write_text(text, encoding="utf-8")

    assert files == {path.name: path.read_text("utf-8") for path in GOLDEN.iterdir()}


def test_a_small_map(tmp_path: Path) -> None:
    text = """environment E {
  size 10 m x 6 m
  wall : (0.5 m, 0.5 m) -> (3.5 m, 3.5 m)
  obstacle box : (6 m, 1 m) .. (8 m, 2.5 m)
  obstacle disc : (7 m, 5 m) radius 1 m
  zone z : (9.2 m, 0 m) .. (10 m, 1 m)
}"""
    assert made_of(text, tmp_path, resolution="1") == []
    about, cells = read(tmp_path / "out", "E")

    assert drawn(cells) == [
        "......##..",
        "......##..",
        "..##......",
        ".###..##..",
        "###...##..",
        "##.......#",
    ]
    assert about == {
        "image": "E.pgm",
        "mode": "trinary",
        "resolution": 1.0,
        "origin": [0.0, 0.0, 0.0],
        "negate": 0,
        "occupied_thresh": 0.65,
        "free_thresh": 0.196,
    }


def test_cells_are_those_that_something_reaches_into(tmp_path: Path) -> None:
    seen = 0
    for seed in range(25):
        draw = random.Random(seed)
        width, depth = draw.randint(3, 12), draw.randint(3, 12)
        thickness = draw.choice([0.05, 0.3, 1.5])
        resolution = draw.choice([0.25, 0.3, 0.5, 1])

        def point(
            draw: random.Random = draw, w: int = width, d: int = depth
        ) -> tuple[float, float]:
            return round(draw.uniform(0, w), 2), round(draw.uniform(0, d), 2)

        items, shapes = [], []
        for _ in range(draw.randint(0, 2)):
            points = [point() for _ in range(draw.randint(2, 4))]
            items.append("wall : " + " -> ".join(f"({x} m, {y} m)" for x, y in points))
            for start, end in pairwise(points):
                shapes.append((lambda cell, a=start, b=end: from_line(a, b, cell), thickness / 2))
        for number in range(draw.randint(0, 2)):
            (x, y), (u, v) = point(), point()
            low, high = (min(x, u), min(y, v)), (max(x, u) + 0.01, max(y, v) + 0.01)
            high = (min(high[0], width), min(high[1], depth))
            kind = draw.choice(["zone", "obstacle"])
            items.append(
                f"{kind} b{number} : ({low[0]} m, {low[1]} m) .. ({high[0]} m, {high[1]} m)"
            )
            shapes.append((lambda cell, a=low, b=high: from_box(a, b, cell), 0.0))
        radius = round(draw.uniform(0.1, 1.4), 2)
        x, y = draw.uniform(1.4, width - 1.4), draw.uniform(1.4, depth - 1.4)
        x, y = round(x, 2), round(y, 2)
        items.append(f"obstacle d : ({x} m, {y} m) radius {radius} m")
        shapes.append((lambda cell, x=x, y=y: from_point(x, y, cell), radius))
        folder = tmp_path / str(seed)
        folder.mkdir()
        body = "\n".join(items)
        report = made_of(
            f"environment E {{\nsize {width} m x {depth} m\n{body}\n}}",
            folder,
            resolution=str(resolution),
            thickness=str(thickness),
        )
        assert report == []
        _, cells = read(folder / "out", "E")

        assert len(cells) == math.ceil(depth / resolution - 1e-9)
        assert len(cells[0]) == math.ceil(width / resolution - 1e-9)
        seen += _compare(cells, resolution, shapes)
    assert seen > 1000


def _compare(cells: Cells, resolution: float, shapes: list[Shape]) -> int:
    """Hold each cell against the shapes; return the number of occupied ones."""
    for row, line in enumerate(cells):
        for column, occupied in enumerate(line):
            x, y = column * resolution, row * resolution
            cell = (x, y, x + resolution, y + resolution)
            margins = [distance(cell) - most for distance, most in shapes]
            # Cells that a shape only touches may be either.
            if min(margins) < -1e-4:
                assert occupied, (row, column)
            elif min(margins) > 1e-4:
                assert not occupied, (row, column)
    return sum(map(sum, cells))


def test_a_wall_has_no_gap(tmp_path: Path) -> None:
    """A robot that goes from free cell to free cell, diagonals included, stays on its side."""
    text = "environment E { size 9 m x 9 m; wall : (0 m, 1 m) -> (4 m, 3 m) -> (9 m, 8.3 m) }"
    assert made_of(text, tmp_path, resolution="0.3", thickness="0.01") == []
    _, cells = read(tmp_path / "out", "E")
    last = len(cells) - 1
    reached, edge = {(0, last)}, [(0, last)]
    while edge:
        row, column = edge.pop()
        for near in ((row + i, column + j) for i in (-1, 0, 1) for j in (-1, 0, 1)):
            inside = 0 <= near[0] <= last and 0 <= near[1] <= last
            if inside and near not in reached and not cells[near[0]][near[1]]:
                reached.add(near)
                edge.append(near)

    assert not cells[0][last]
    assert not cells[last][0]
    assert (last, 0) not in reached


def test_without_a_size_the_map_is_as_large_as_its_content(tmp_path: Path) -> None:
    text = """environment E {
  obstacle a : (-3 m, 2 m) radius 1 m
  obstacle b : (0.00001 m, 5 m) .. (2 m, 6 m)
}"""
    assert made_of(text, tmp_path, resolution="0.5") == []
    about, cells = read(tmp_path / "out", "E")

    assert about["origin"] == [-4.0, 1.0, 0.0]
    assert (len(cells), len(cells[0])) == (10, 12)
    assert cells[9][11]
    assert not cells[9][0]


def test_zones_and_what_is_above(tmp_path: Path) -> None:
    text = """environment E {
  size 3 m x 1 m
  zone z : (0 m, 0 m) .. (1 m, 1 m) height 2 m .. 3 m
  obstacle o : (2 m, 0 m) .. (3 m, 1 m) height 1 m .. 3 m
}"""
    for expected, options in (
        ("#.#", {}),
        ("..#", {"zones": "false"}),
        ("#.#", {"below": "2.5"}),
        ("..#", {"below": "2"}),
        ("...", {"below": "0.5"}),
    ):
        assert made_of(text, tmp_path, resolution="1", **options) == []
        assert drawn(read(tmp_path / "out", "E")[1]) == [expected], options


def test_what_a_map_cannot_hold(tmp_path: Path) -> None:
    found = build(FIELD, tmp_path, resolution="1").report

    assert [(each.code, each.message.partition("represent ")[2]) for each in found] == [
        ("SW0916", "areas `meadow` and `air`"),
        ("SW0916", "targets `person`, `sheep` and `exit`"),
        ("SW0916", "wind"),
        ("SW0916", "rain"),
    ]
    assert all(each.primary for each in found)


def test_an_environment_without_anything(tmp_path: Path) -> None:
    (found,) = made_of("environment E {} environment F { size 1 m x 1 m }", tmp_path)

    assert (found.code, found.primary.span.text) == ("SW0916", "E")
    assert "size" in found.help
    assert read(tmp_path / "out", "F")[1]


@pytest.mark.parametrize(
    ("size", "way"),
    [
        ("251 m x 250 m", "resolution=0.1"),
        ("1 km x 1 km", "resolution=0.2"),
        ("1000000 km x 1000000 km", "smaller"),
    ],
)
def test_a_map_that_is_too_large(size: str, way: str, tmp_path: Path) -> None:
    (found,) = made_of(f"environment E {{ size {size} }}", tmp_path)

    assert (found.code, found.primary.span.text) == ("SW0903", "E")
    assert way in found.help
    if "=" in way:
        resolution = way.partition("=")[2]
        assert made_of(f"environment E {{ size {size} }}", tmp_path, resolution=resolution) == []


@pytest.mark.parametrize("name", ["null", "yes", "__e__", "y", "world"])
def test_hostile_names(name: str, tmp_path: Path) -> None:
    text = f"environment {name} {{ size 2 m x 1 m; obstacle o : (1 m, 0 m) .. (2 m, 1 m) }}"

    assert made_of(text, tmp_path, resolution="1") == []
    assert drawn(read(tmp_path / "out", name)[1]) == [".#"]


@pytest.mark.parametrize("value", ["0", "-1", "1e3", "x", " 1", "0.0", "nan", "0,5"])
@pytest.mark.parametrize("option", ["resolution", "thickness", "below"])
def test_options_are_lengths(option: str, value: str, tmp_path: Path) -> None:
    found = made_of("environment E { size 1 m x 1 m }", tmp_path, **{option: value})

    assert [each.code for each in found] == ["SW0904"]
    assert not (tmp_path / "out").exists()


def test_the_table_is_true(tmp_path: Path) -> None:
    build(FIELD, tmp_path, resolution="1")
    text = (tmp_path / "nav2_map" / "Field.yaml").read_text("utf-8")
    options = {"thickness", "zones", "below"}
    for row in load("nav2_map").mapping:  # type: ignore[union-attr]
        if row.support is not Support.REJECTED:
            quoted = set(re.findall(r"`([^`]+)`", row.means))
            assert [each for each in quoted - options if each not in text] == []
