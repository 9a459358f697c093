"""Maps of environments: places in the picture are those of the model."""

from __future__ import annotations

from pathlib import Path
from xml.etree import ElementTree

import pytest

from swarmdsl.cli import run
from swarmdsl.driver import pipeline
from swarmdsl.tools.diagram.map import maps

MODEL = """\
package farm

event Go : std_msgs/Empty

environment Field {
  size 100 m x 50 m
  /// Mown & dry.
  area meadow : (0 m, 10 m) .. (60 m, 50 m)
  zone village : (70 m, 0 m) .. (80 m, 10 m)
  wall : (0 m, 5 m) -> (50 m, 5 m)
  obstacle silo : (30 m, 30 m) radius 5 m
  target exit at (8 m, 4 m), (90 m, 40 m)
}

environment Empty { size 10 m x 10 m }

statemachine Work { initial Busy; state Busy { on Go -> Done }; final Done }

member Rover { behavior Work }

swarm Robots {
  environment Field
  rover : Rover[2] in meadow
  rover[1] at (100 m, 50 m)
}
"""
SVG = "{http://www.w3.org/2000/svg}"


@pytest.fixture
def model(tmp_path: Path) -> Path:
    path = tmp_path / "farm.swarm"
    path.write_text(MODEL, encoding="utf-8")
    return path


def drawn(model: Path) -> ElementTree.Element:
    system = pipeline.check([model]).system
    assert system is not None
    (only,) = maps(system)  # nothing has a place in the other environment
    return ElementTree.fromstring(only.svg())


def titled(root: ElementTree.Element, title: str) -> ElementTree.Element:
    """Return the group with a title that begins so."""
    groups = (group for group in root.iter(f"{SVG}g") if group[0].text is not None)
    (found,) = (group for group in groups if (group[0].text or "").startswith(title))
    return found


def test_the_longer_side_has_640_units_and_y_counts_downwards(model: Path) -> None:
    root = drawn(model)

    area = titled(root, "area meadow")[1]
    assert [area.get(name) for name in ("x", "y", "width", "height")] == ["0", "0", "384", "256"]
    silo = titled(root, "obstacle silo")[1]
    assert [silo.get(name) for name in ("cx", "cy", "r")] == ["192", "128", "32"]
    wall = titled(root, "wall")[1]
    assert wall.get("points") == "0,288 320,288"


def test_targets_and_robots_at_points_are_drawn(model: Path) -> None:
    root = drawn(model)

    crosses = [each.get("d") for each in root.iter(f"{SVG}path")]
    assert [each[:12] for each in crosses if each] == ["M46.2 289.4l", "M571 59l10 1"]
    dots = [each for each in root.iter(f"{SVG}circle") if each.get("class") == "solid"]
    assert [(each.get("cx"), each.get("cy")) for each in dots] == [("640", "0")]
    names = {each.text for each in root.iter(f"{SVG}text")}
    assert {"meadow", "no entry: village", "silo", "exit", "rover[1]", "(0 m, 0 m)"} <= names


def test_a_map_is_written_by_the_command(
    model: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    out = tmp_path / "field.svg"
    assert run(["diagram", str(model), "--kind", "map", "-o", str(out)]) == 0
    assert ElementTree.parse(out).getroot().tag == f"{SVG}svg"
    folder = tmp_path / "all"
    assert run(["diagram", str(model), "-o", str(folder)]) == 0
    assert "Field.map.svg" in {path.name for path in folder.iterdir()}
    capsys.readouterr()
    assert run(["diagram", str(model), "--kind", "map", "--format", "dot"]) == 1
    assert "maps are drawn as SVG only" in capsys.readouterr().err


def test_a_page_has_the_map_with_links(model: Path, tmp_path: Path) -> None:
    page = tmp_path / "page.html"
    assert run(["doc", str(model), "-o", str(page)]) == 0
    text = page.read_text(encoding="utf-8")
    assert "Map of Field" in text
    assert '<a href="#Field.meadow">' in text
