"""Fixes that move statements take their comments along, whatever the layout is."""

from pathlib import Path

import pytest

from swarmdsl.driver.fixes import fixes_of
from swarmdsl.driver.fixes.trial import texts_with
from swarmdsl.driver.workspace import Workspace

HEAD = "event Stop : std_msgs/Empty\nstatemachine M {\n  var n : int32 = 0\n"
CHOICE = "  initial C\n"
STATES = "  state A { on Stop -> Z }\n  final Z\n}\n"
PARALLEL = """\
  initial P
  parallel state P {
    region R { initial A; state A { on Stop -> Z } }
    region S {
      initial B
      state B {
        // stops
        on Stop -> Y  // there
      }
    }
  }
  final Y
  final Z
}
"""


def fixed(tmp_path: Path, text: str, code: str) -> str:
    """Return a text after the fix of the diagnostic with a code."""
    path = tmp_path / "m.swarm"
    path.write_text(text, encoding="utf-8")
    workspace = Workspace([path])
    [found] = [each for each in workspace.report if each.code == code]
    [fix] = fixes_of(found, workspace)
    return texts_with([fix])[path]


@pytest.mark.parametrize(
    ("choice", "expected"),
    [
        ("choice C { else -> Z; [n > 3] -> A }", "choice C { [n > 3] -> A; else -> Z }"),
        (
            "choice C {\n    // all\n    else -> Z // x\n    [n > 3] -> A // y\n  }",
            "choice C {\n    // all\n    [n > 3] -> A // y\n    else -> Z // x\n  }",
        ),
        (
            "choice C {\n    /// All.\n    else -> Z;\n    [n > 3] -> A\n  }",
            "choice C {\n    [n > 3] -> A\n    /// All.\n    else -> Z\n  }",
        ),
    ],
)
def test_else_comes_last(tmp_path: Path, choice: str, expected: str) -> None:
    text = HEAD + CHOICE + "  " + choice + "\n" + STATES
    assert fixed(tmp_path, text, "SW0504") == text.replace(choice, expected)


def test_transition_moves_to_the_parallel_state(tmp_path: Path) -> None:
    made = fixed(tmp_path, HEAD + PARALLEL, "SW0522")
    assert "    }\n    on Stop -> Y  // there\n  }\n  final Y\n" in made
    assert "      state B {\n        // stops\n      }\n" in made
