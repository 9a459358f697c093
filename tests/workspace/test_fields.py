"""Fields as symbols: where they are used, what is shown of them, and their new names."""

from __future__ import annotations

from pathlib import Path

import pytest

from swarmdsl.driver.workspace import Workspace
from swarmdsl.driver.workspace.references import occurrence_at, occurrences_of
from swarmdsl.driver.workspace.renaming import RefusedError, rename, replaced
from swarmdsl.ide.server.hover import hover

MODEL = """\
package rescue

import ros "marine_msgs"

/// A person.
struct Person {
  /// The name on the vest.
  label : string
  place : geometry_msgs/Point
}

message Sighting {
  person : Person
  sure   : bool
}

action Dive {
  goal   { depth : float64 }
  result { depth : float64, bottom : marine_msgs/Sounding }
}

function dive : abstraction {
  action "cmd/dive" : rescue/Dive
  out "sonar" : marine_msgs/Sounding
}

swarm event Seen : Sighting

endless statemachine Diver {
  var reached : float64 = 0.0
  var last : Person
  var ground : marine_msgs/Sounding

  initial Look

  state Look {
    on Seen [event.sure and event.person.label != ""] / last = event.person -> Down
  }

  state Down {
    do dive(depth = 3.0) gives (depth => reached, bottom => ground)
    on succeeded [ground.metres > reached]
      / send Seen(person = Person(label = last.label, place = last.place), sure = true) -> Look
    on succeeded, aborted -> Look
  }
}

member Robot {
  behavior Diver
}

swarm Divers {
  robot : Robot[2]
}
"""


@pytest.fixture
def workspace(tmp_path: Path) -> Workspace:
    package = tmp_path / "marine_msgs" / "msg"
    package.mkdir(parents=True)
    (package / "Sounding.msg").write_text("# How deep it is.\nfloat64 metres\n", encoding="utf-8")
    path = tmp_path / "rescue.swarm"
    path.write_text(MODEL, encoding="utf-8")
    found = Workspace([path])
    assert [each.message for each in found.report] == []
    return found


def offset(text: str) -> int:
    assert MODEL.count(text) == 1, text
    return MODEL.index(text) + 1


def uses(workspace: Workspace, text: str) -> list[str]:
    """The places of the field at a text, with what is around them."""
    file = workspace.project.files[0]
    found = occurrence_at(workspace, file, offset(text))
    assert found is not None, text
    spans = {each.span for each in occurrences_of(found.node, workspace)}
    return [
        span.source.text[max(0, span.start - 6) : span.end].split("\n")[-1].strip()
        for span in sorted(spans, key=lambda each: (each.source.name, each.start))
    ]


@pytest.mark.parametrize(
    ("at", "places"),
    [
        ("label :", ["label", "erson.label", "rson(label", "last.label"]),
        ("sure and", ["sure", "event.sure", "ce), sure"]),
        ("depth : float64 }", ["al   { depth", "dive(depth"]),
        ("depth =>", ["sult { depth", "ves (depth"]),
        ("bottom =>", ["64, bottom", "ched, bottom"]),
    ],
)
def test_references(workspace: Workspace, at: str, places: list[str]) -> None:
    found = uses(workspace, at)
    assert len(found) == len(places)
    assert all(each.endswith(place.split()[-1]) for each, place in zip(found, places, strict=True))


def test_a_field_of_ros_leads_to_its_file(workspace: Workspace) -> None:
    file = workspace.project.files[0]
    found = occurrence_at(workspace, file, offset("metres >"))
    assert found is not None
    span = found.node.name.span.absolute  # type: ignore[attr-defined]
    assert (Path(span.source.name).name, span.line) == ("Sounding.msg", 2)
    with pytest.raises(RefusedError, match="declared in an interface of ROS"):
        rename(workspace, file, offset("metres >"), "m")
    with pytest.raises(RefusedError, match="with `place` there would be an error"):
        rename(workspace, file, offset("label !="), "place")


def test_rename(workspace: Workspace, tmp_path: Path) -> None:
    file = workspace.project.files[0]
    spans = rename(workspace, file, offset("label !="), "vest")
    assert len(spans) == 4
    with workspace.overriding(replaced(spans, "vest")):
        assert [each.message for each in workspace.report] == []


@pytest.mark.parametrize(
    ("at", "shown"),
    [
        ("label !=", ["label : string", "field", "The name on the vest.", "Of `Person`."]),
        ("depth =>", ["Of the result of `Dive`."]),
        ("metres >", ["float64 metres"]),
        (
            "dive(depth",
            [
                "Calls action `cmd/dive` : `rescue/Dive`.",
                "Goal: `depth : float64`.",
                "Result: `depth : float64`, `bottom : marine_msgs/Sounding`.",
                "Topics: `out sonar : marine_msgs/Sounding`.",
            ],
        ),
    ],
)
def test_hover(workspace: Workspace, at: str, shown: list[str]) -> None:
    found = hover(workspace, workspace.project.files[0], offset(at))
    assert found is not None
    for each in shown:
        assert each in found[1]
