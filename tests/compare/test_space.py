"""Differences of environments, bodies, sights, starts and models of functions."""

from __future__ import annotations

from pathlib import Path

from swarmdsl.driver import pipeline
from swarmdsl.tools.compare.comparison import compare

OLD = """\
package farm
environment Field {
  area meadow : (0 m, 0 m) .. (60 m, 100 m)
  wall : (0 m, 50 m) -> (40 m, 50 m)
  target person[3] at random in meadow
  rain from 1 min until 2 min
}
sensor Eye { senses person { range = 20 m } }
action Go { goal { height : float64 in m } }
function go : swarm { action "go" : Go
  model random_walk(height = height)
}
member Car {
  body { speed = 1 m/s }
  eye : Eye
}
swarm S {
  environment Field
  car : Car in meadow
}
"""
NEW = (
    OLD.replace("meadow", "pasture")
    .replace("(40 m, 50 m)", "(30 m, 50 m)")
    .replace("person", "walker")
    .replace("20 m }", "30 m }")
    .replace("random_walk", "coverage")
    .replace("1 m/s", "2 m/s")
    .replace("until 2 min", "until 3 min")
)


def system(text: str, path: Path):
    path.write_text(text, encoding="utf-8")
    found = pipeline.check([path]).system
    assert found is not None
    return found


def test_changes_of_the_space_are_told(tmp_path: Path) -> None:
    changes, _ = compare(system(OLD, tmp_path / "a.swarm"), system(NEW, tmp_path / "b.swarm"))

    told = {(each.kind, each.description) for each in changes}
    for kind, word in (
        ("wall", "line"),
        ("rain", "time"),
        ("function", "model"),
        ("member", "body"),
        ("role", "start"),
    ):
        assert [text for found, text in told if found == kind and word in text], (kind, told)
