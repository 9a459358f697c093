"""Target `gazebo`: the worlds keep the rules of SDF, and their geometry is that of the model."""

from __future__ import annotations

import math
import random
import re
from pathlib import Path
from typing import Any

import pytest
from lxml import etree

from swarmdsl.codegen.api import Support
from swarmdsl.codegen.emit import Request
from swarmdsl.codegen.registry import load
from swarmdsl.driver import pipeline

from .rules import faults

FIELD = Path(__file__).parent / "field.swarm"
GOLDEN = Path(__file__).parent / "golden"


def build(path: Path, out: Path, **options: str) -> pipeline.Result:
    return pipeline.build([path], [Request("gazebo", options)], out)


def made_of(text: str, folder: Path, **options: str) -> tuple[dict[str, Any], list[Any]]:
    """Return the root of each world of a model by its path, and the diagnostics."""
    path = folder / "model.swarm"
    path.write_text(f"package p\n{text}\n", encoding="utf-8")
    # Names are as hostile as they are.
    report = [
        each for each in build(path, folder / "out", **options).report if each.code != "SW0206"
    ]
    files = sorted((folder / "out" / "gazebo").glob("*.sdf"))
    return {file.name: etree.parse(file).getroot() for file in files}, report


def numbers(element: Any, path: str) -> list[float]:
    return [float(word) for word in element.findtext(path).split()]


def solids(root: Any, name: str, tag: str = "collision") -> list[tuple[list[float], Any]]:
    """Return pose and geometry of each collision or visual of a model."""
    found = root.findall(f"world/model[@name='{name}']/link/{tag}")
    return [(numbers(each, "pose"), each.find("geometry")[0]) for each in found]


def extent(solid: tuple[list[float], Any]) -> list[float]:
    """Return the bounds of a solid along the axes: x, y and z, low and high."""
    (x, y, z, roll, pitch, yaw), shape = solid
    assert (roll, pitch) == (0, 0)
    if shape.tag == "cylinder":
        radius, length = numbers(shape, "radius")[0], numbers(shape, "length")[0]
        half = (radius, radius, length / 2)
    else:
        assert yaw == 0
        half = tuple(side / 2 for side in numbers(shape, "size"))  # type: ignore[assignment]
    middles = zip((x, y, z), half, strict=True)
    return [side for middle, half in middles for side in (middle - half, middle + half)]


def ends(solid: tuple[list[float], Any]) -> list[tuple[float, float]]:
    """Return the middles of the short sides of a part of a wall."""
    (x, y, _, _, _, yaw), box = solid
    half = numbers(box, "size")[0] / 2
    return [(x + side * math.cos(yaw), y + side * math.sin(yaw)) for side in (-half, half)]


def is_at(points: list[tuple[float, float]], expected: list[tuple[float, float]]) -> bool:
    return all(math.dist(one, other) < 1e-4 for one, other in zip(points, expected, strict=True))


def test_the_world_is_as_before(tmp_path: Path, bless: bool) -> None:
    build(FIELD, tmp_path)
    text = (tmp_path / "gazebo" / "Field.sdf").read_text("utf-8")
    if bless:
        (GOLDEN / "Field.sdf").write_text(text, encoding="utf-8")

    assert text == (GOLDEN / "Field.sdf").read_text("utf-8")


@pytest.mark.parametrize("version", ["1.9", "1.6"])
def test_the_world_keeps_the_rules(version: str, tmp_path: Path) -> None:
    build(FIELD, tmp_path, sdf=version)
    root = etree.parse(tmp_path / "gazebo" / "Field.sdf").getroot()

    assert list(faults(root)) == []
    assert root.get("version") == version
    assert root.find("world").get("name") == "Field"


def test_the_rules_find_faults() -> None:
    wrong = """<sdf version="1.9"><world name="__w__"><model name="a"><pose>1 2</pose>
    <link name="l"><collision name="c"/></link></model><model name="a"/><robot/></world></sdf>"""

    assert list(faults(etree.fromstring(wrong))) == [
        "sdf: the name '__w__' is reserved",
        "world: has a robot",
        "world: 2 are called a",
        "pose: has 2 numbers",
        "collision: has 0 geometry",
        "robot: there is no such element",
    ]


def test_geometry(tmp_path: Path) -> None:
    build(FIELD, tmp_path, thickness="0.5", height="7")
    root = etree.parse(tmp_path / "gazebo" / "Field.sdf").getroot()

    ((pose, plane),) = solids(root, "ground_plane")
    assert (pose[:3], numbers(plane, "size")) == ([15, 10, 0], [30, 20])
    first, second = solids(root, "wall_1")
    assert ends(first) == [(0, 15), (10, 15)]
    assert is_at(ends(second), [(10, 15), (14, 18)])
    for part in (first, second):
        assert numbers(part[1], "size")[1:] == [0.5, 3]
        assert part[0][2] == 1.5
    # What has no height has that of the environment, not of the option.
    assert numbers(solids(root, "wall_2")[0][1], "size")[2] == 25
    assert extent(solids(root, "obstacle_silo")[0]) == [12, 18, 7, 13, 0, 10]
    assert extent(solids(root, "obstacle_barn")[0]) == [1, 5, 1, 3.5, 0, 25]
    assert extent(solids(root, "obstacle_roof")[0]) == [6, 8, 1, 3, 2, 2.5]
    assert extent(solids(root, "zone_village", "visual")[0]) == [20, 25, 4, 9, 2, 20]
    assert extent(solids(root, "zone_woods", "visual")[0]) == [26, 28, 4, 9, 0, 25]
    assert extent(solids(root, "area_air", "visual")[0]) == [10, 20, 0, 8, 5, 10]
    assert extent(solids(root, "area_meadow", "visual")[0])[:5] == [0, 10, 0, 15, 0]
    places = [solids(root, f"target_exit_{n}", "visual")[0][0][:2] for n in range(2)]
    assert places == [[8, 4], [0, 2]]
    assert numbers(root, "world/wind/linear_velocity") == [-1, 0, 0]


def test_what_robots_go_through_has_no_collision(tmp_path: Path) -> None:
    build(FIELD, tmp_path)
    root = etree.parse(tmp_path / "gazebo" / "Field.sdf").getroot()
    solid = [
        each.get("name") for each in root.iter("model") if each.find("link/collision") is not None
    ]

    assert solid == [
        "ground_plane",
        *("wall_1", "wall_2"),
        *("obstacle_silo", "obstacle_barn", "obstacle_roof"),
    ]
    for model in root.iter("model"):
        assert model.findtext("static") == "true"
        assert model.find("link/visual") is not None
        marked = model.get("name").startswith(("area_", "zone_"))
        assert (model.find("link/visual/transparency") is not None) == marked


def test_what_a_world_cannot_hold(tmp_path: Path) -> None:
    found = build(FIELD, tmp_path).report

    assert [(each.code, each.message.partition("represent ")[2]) for each in found] == [
        ("SW0916", "3 targets `person` at random"),
        ("SW0916", "a target `sheep` at random"),
        ("SW0916", "the times of a wind"),
        ("SW0916", "rain"),
    ]
    lines = FIELD.read_text("utf-8").splitlines()
    places = [lines[each.primary.span.line - 1].split()[:2] for each in found if each.primary]
    assert places == [["target", "person[3]"], ["target", "sheep"], ["wind", "3"], ["rain", "from"]]


def test_random_environments(tmp_path: Path) -> None:
    for seed in range(20):
        draw = random.Random(seed)
        width, depth = draw.randint(5, 200), draw.randint(5, 200)

        def point(
            draw: random.Random = draw, w: int = width, d: int = depth
        ) -> tuple[float, float]:
            return round(draw.uniform(0, w), 3), round(draw.uniform(0, d), 3)

        walls = [[point() for _ in range(draw.randint(2, 5))] for _ in range(draw.randint(1, 4))]
        boxes = [sorted((point(), point())) for _ in range(3)]
        boxes = [[(x, min(y, v)), (u, max(y, v))] for (x, y), (u, v) in boxes]
        items = [
            f"wall : {' -> '.join(f'({x} m, {y} m)' for x, y in wall)} height {number + 1} m"
            for number, wall in enumerate(walls)
        ]
        items += [
            f"obstacle b{number} : ({x} m, {y} m) .. ({u} m, {v} m) height 2 m"
            for number, ((x, y), (u, v)) in enumerate(boxes)
        ]
        folder = tmp_path / str(seed)
        folder.mkdir()
        body = "\n".join(items)
        text = f"environment E {{\nsize {width} m x {depth} m\n{body}\n}}"
        made, report = made_of(text, folder)
        root = made["E.sdf"]

        assert report == []
        assert list(faults(root)) == []
        for number, wall in enumerate(walls):
            parts = solids(root, f"wall_{number + 1}")
            for part, start, end in zip(parts, wall[:-1], wall[1:], strict=True):
                assert is_at(ends(part), [start, end])
                assert numbers(part[1], "size")[1:] == [0.1, number + 1]
        for number, ((x, y), (u, v)) in enumerate(boxes):
            (solid,) = solids(root, f"obstacle_b{number}")
            assert extent(solid) == pytest.approx([x, u, y, v, 0, 2], abs=1e-5)


def test_hostile_names(tmp_path: Path) -> None:
    text = """environment E {
  area world : (0 m, 0 m) .. (1 m, 1 m)
  zone __zone__ : (2 m, 0 m) .. (3 m, 1 m)
  obstacle sun : (4 m, 0 m) .. (5 m, 1 m)
  obstacle ground_plane : (6 m, 0 m) .. (7 m, 1 m)
  target a_1 at (0 m, 0 m)
  target a at (1 m, 0 m), (2 m, 0 m)
  target a at (3 m, 0 m)
}
environment Null {}
/// Ends -- with --
environment a__ {
  size 1 m x 1 m
  /// ]]> <x> & -->
  wall : (0 m, 0 m) -> (1 m, 1 m)
}"""
    made, report = made_of(text, tmp_path)

    assert report == []
    assert sorted(made) == ["E.sdf", "Null.sdf", "a__.sdf"]
    for name, root in made.items():
        assert list(faults(root)) == [], name
    targets = [each.get("name") for each in made["E.sdf"].iter("model")][-4:]
    assert targets == ["target_a_1_0", "target_a_0", "target_a_1", "target_a_2"]


@pytest.mark.parametrize("name", ["__e__", "world", "____"])
def test_a_reserved_name_is_rejected(name: str, tmp_path: Path) -> None:
    made, report = made_of(f"environment {name} {{ size 1 m x 1 m }}", tmp_path)

    assert made == {}
    assert [(each.code, each.primary.span.text) for each in report] == [("SW0905", name)]


def test_the_file_of_a_world_is_left_alone(tmp_path: Path) -> None:
    own = tmp_path / "out" / "gazebo" / "E.sdf"
    own.parent.mkdir(parents=True)
    own.write_text("<sdf/>", encoding="utf-8")
    _, report = made_of('environment E { world "E.sdf"; size 1 m x 1 m }', tmp_path)

    assert [each.code for each in report] == ["SW0908"]
    assert own.read_text("utf-8") == "<sdf/>"


def test_without_an_environment(tmp_path: Path) -> None:
    made, report = made_of("member M {}", tmp_path)

    assert (made, [each.code for each in report]) == ({}, ["SW0910"])


@pytest.mark.parametrize("value", ["0", "-1", "1e3", "x", "", " 1", "0.0", "nan", "\u0661"])
@pytest.mark.parametrize("option", ["thickness", "height"])
def test_options_are_lengths(option: str, value: str, tmp_path: Path) -> None:
    made, report = made_of("environment E {}", tmp_path, **{option: value})

    assert made == {}
    assert [each.code for each in report] == ["SW0904"]


def test_the_table_is_true(tmp_path: Path) -> None:
    build(FIELD, tmp_path)
    text = (tmp_path / "gazebo" / "Field.sdf").read_text("utf-8")
    for row in load("gazebo").mapping:  # type: ignore[union-attr]
        if row.support is not Support.REJECTED:
            quoted = re.findall(r"`([^`]+)`", row.means)
            assert [each for each in quoted if each != "height" and each not in text] == []
