"""Tests of quick fixes: each is applied and checked by the compiler."""

from pathlib import Path

import pytest

from swarmdsl.driver.fixes import fixes_of
from swarmdsl.driver.fixes.trial import texts_with
from swarmdsl.driver.workspace import Workspace

MODEL = """\
/// Robots that count.
package counting

import cpswarm.interfaces.*

/// Count once.
function count : abstraction { action "count" : counting/Count }
action Count {
  goal { depth : uint8, place : geometry_msgs/Point }
  result { count : uint16 }
}
function stop : abstraction { service "stop" : std_srvs/SetBool }
statemachine Counting {
  /// How deep.
  param depth : uint8 = 3

  // Where it begins.
  initial Idle
  state Idle { on MissionStart -> Count }
  state Count {
    do count(depth = depth, place = place) gives (count => found)
    on succeeded [not weary] / sum = found -> Count
    on succeeded, aborted -> Stop
    after limit -> Stop
  }
  state Stop {
    do stop(data = true) gives (message => reason)
    on Stopped -> Done
    on succeeded [reason != "" and sum > 3 and budget < 5 s] -> Done
    on succeeded, aborted -> Idle
  }
  final Done
}
member Counter { behavior Counting; eye : Camera }
fitness Found { maximize found }
swarm Counters { counter : Counter[2]; other : Looker; environment Field; fitness Found }
"""


def mended(path: Path) -> list[str]:
    """Apply the best fixes, one at a time; return their titles."""
    titles: list[str] = []
    workspace = Workspace([path])
    while True:
        fixes = [fixes_of(each, workspace) for each in workspace.report if each.name != "unused"]
        best = [found[0] for found in fixes if found]
        if not best:
            assert not workspace.report.has_errors
            return titles
        titles.append(best[0].title)
        for place, text in texts_with(best[:1]).items():
            place.write_text(text, encoding="utf-8")
            workspace.update({place: None})
        assert len(titles) < 50


def test_declaration_is_added(tmp_path):
    path = tmp_path / "counting.swarm"
    path.write_text(MODEL, encoding="utf-8")
    assert set(mended(path)) == {
        "Add `import cpswarm.events.MissionStart`",
        "Add `import cpswarm.hardware.Camera`",
        "Declare `event Stopped : std_msgs/Empty`",
        "Declare `environment Field { size 50 m x 50 m }`",
        "Declare `member Looker { }`",
        "Declare `var found : uint16 = 0`",
        "Declare `var limit : duration`",
        "Declare `var place : geometry_msgs/Point`",
        'Declare `var reason : string = ""`',
        "Declare `var budget : duration`",
        "Declare `var sum : uint16 = 0`",
        "Declare `var weary : bool = false`",
        "Declare `in found : float64`",
    }
    text = path.read_text(encoding="utf-8")
    assert "\n  param depth : uint8 = 3\n  var " in text
    assert "\n\n  // Where it begins.\n" in text


@pytest.mark.parametrize("head", ["", "package p\n"])
def test_declaration_is_added_on_one_line(tmp_path, head):
    path = tmp_path / "m.swarm"
    machine = "endless statemachine M { initial A; state A { on Go / n = true -> A } }"
    path.write_text(f"{head}{machine}\nmember R {{ behavior M }}\nswarm S {{ r : R }}\n")
    assert mended(path) == ["Declare `event Go : std_msgs/Empty`", "Declare `var n : bool = false`"]


@pytest.mark.parametrize(
    ("before", "after"),
    [
        (
            "/* statemachine M { old */\nendless statemachine M {\n",
            "/* statemachine M { old */\nendless statemachine M {\n  var n : bool = false\n",
        ),
        (
            "endless statemachine M {\n  var a : uint8 =\n 3 // three\n",
            "endless statemachine M {\n  var a : uint8 =\n 3 // three\n  var n : bool = false\n",
        ),
        (
            "endless statemachine M /* x { */ {\n",
            "endless statemachine M /* x { */ {\n  var n : bool = false\n",
        ),
    ],
)
def test_fix_ignores_comments_and_strings(tmp_path, before, after):
    path = tmp_path / "m.swarm"
    rest = """initial A; state A { on Go / n = true -> A } }
event Go : std_msgs/Empty
member R { behavior M }
swarm S { r : R }
"""
    path.write_text(before + rest)
    assert mended(path) == ["Declare `var n : bool = false`"]
    assert path.read_text() == after + rest


def test_separators_are_inserted(tmp_path):
    path = tmp_path / "m.swarm"
    path.write_text(
        "enum Level { LOW HIGH }\n"
        "event Go : std_msgs/Empty /* a */ event Stop : std_msgs/Empty\n"
        "statemachine M { initial A state A { on Go -> B on Stop -> B } final B }\n"
        "member R { behavior M }\nswarm S { r : R }\n"
    )
    assert mended(path) == ["Insert `,`", "Insert `;`", "Insert `;`", "Insert `;`"]
    assert path.read_text().startswith(
        "enum Level { LOW, HIGH }\n"
        "event Go : std_msgs/Empty /* a */; event Stop : std_msgs/Empty\n"
        "statemachine M { initial A; state A { on Go -> B; on Stop -> B } final B }\n"
    )
