"""Map of a run: everything is at its place, and says what it is."""

import xml.etree.ElementTree as ET

import pytest

from swarmdsl.execution.simulate.pictures.map_svg import (
    Ground,
    Mark,
    Moment,
    Sighting,
    Track,
    map_svg,
)
from swarmdsl.ir.space import Box, Disc, Point

SECOND = 10**9
SVG = "{http://www.w3.org/2000/svg}"
GROUND = Ground(
    Point(0, 0),
    Point(100, 50),
    areas=[("meadow", Box(Point(10, 10), Point(60, 40)))],
    zones=[("village", Box(Point(70, 20), Point(90, 40)))],
    walls=[[Point(0, 30), Point(40, 30)]],
    obstacles=[("silo <1>", Disc(Point(30, 20), 3)), ("", Box(Point(5, 5), Point(9, 9)))],
)


def _drawn(moment, ground=GROUND):
    return ET.fromstring(map_svg("Search & rescue", ground, moment))


def _all(root, tag, style):
    return [each for each in root.iter(f"{SVG}{tag}") if each.get("class") == style]


def _place(root, x, y):
    """Return where a point of the ground is in the picture."""
    (ground,) = _all(root, "rect", "ground")
    left, top, wide, high = (float(ground.get(key)) for key in ("x", "y", "width", "height"))
    return left + wide * x / 100, top + high * (1 - y / 50)


def test_shapes_are_to_scale_with_north_up():
    root = _drawn(Moment(0, []))
    (meadow,) = _all(root, "rect", "area")
    x, y = _place(root, 10, 40)
    assert float(meadow.get("x")) == pytest.approx(x, abs=0.01)
    assert float(meadow.get("y")) == pytest.approx(y, abs=0.01)
    (silo,) = _all(root, "circle", "obstacle")
    x, y = _place(root, 30, 20)
    assert (float(silo.get("cx")), float(silo.get("cy"))) == pytest.approx((x, y), abs=0.01)
    far, _ = _place(root, 33, 20)
    assert float(silo.get("r")) == pytest.approx(far - x, abs=0.02)
    assert silo.find(f"{SVG}title").text == "silo <1>"
    (wall,) = _all(root, "polyline", "wall")
    ends = [tuple(map(float, pair.split(","))) for pair in wall.get("points").split()]
    assert ends[1] == pytest.approx(_place(root, 40, 30), abs=0.01)
    assert len(_all(root, "rect", "zone")) == len(_all(root, "rect", "obstacle")) == 1


def test_trails_lead_to_the_robots():
    places = [(second * SECOND, (10.0 + second, 25.0, 3.0)) for second in range(20)]
    lost = [(0, (5.0, 5.0, 0.0))]
    moment = Moment(
        19 * SECOND,
        [Track("uav[0]", "uav", places), Track("rover[0]", "rover", lost, lost=True)],
        links=[((29.0, 25.0, 3.0), (5.0, 5.0, 0.0))],
    )
    root = _drawn(moment)
    (trail,) = _all(root, "polyline", "trail")
    ends = [tuple(map(float, pair.split(","))) for pair in trail.get("points").split()]
    assert ends[0] == pytest.approx(_place(root, 10, 25), abs=0.01)
    assert ends[-1] == pytest.approx(_place(root, 29, 25), abs=0.01)
    (robot,) = _all(root, "circle", "there")
    assert robot.find(f"{SVG}title").text == "uav[0]: (29 m, 25 m), 3 m above ground"
    (gone,) = _all(root, "circle", "lost")
    assert gone.find(f"{SVG}title").text.endswith(", lost")
    (link,) = _all(root, "line", "link")
    assert float(link.get("x2")) == pytest.approx(_place(root, 5, 5)[0], abs=0.01)
    words = [text.text for text in root.iter(f"{SVG}text")]
    assert {"uav (1)", "rover (1)", "after 19 s"} <= set(words)
    assert robot.get("fill") == trail.get("stroke") != gone.get("stroke")


def test_targets_show_whether_they_were_found_and_from_where():
    moment = Moment(
        SECOND,
        [],
        [Mark("person[0]", (20, 20, 0), True), Mark("person[1]", (80, 10, 0), False)],
        sightings=[Sighting(SECOND, "uav[0]", "person[0]", (22, 20, 5))],
    )
    root = _drawn(moment)
    (found,), (missed,) = _all(root, "polygon", "found"), _all(root, "polygon", "target")
    assert found.find(f"{SVG}title").text == "person[0]: found"
    assert missed.find(f"{SVG}title").text == "person[1]: not found"
    (seen,) = _all(root, "path", "seen")
    assert seen.find(f"{SVG}title").text == "uav[0] sees person[0] at 1 s"
    assert "1 of 2 targets found" in "".join(root.itertext())


def test_a_long_trail_that_stands_still_takes_no_room():
    still = [(second * SECOND, (50.0, 25.0, 0.0)) for second in range(10_000)]
    wriggle = [(second * SECOND, (50.0 + second % 2 / 1000, 25.0, 0.0)) for second in range(10_000)]
    moment = Moment(0, [Track("a[0]", "a", still), Track("a[1]", "a", wriggle)])
    assert len(map_svg("", GROUND, moment)) < 6000
