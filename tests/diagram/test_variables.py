"""Variables and expressions in statecharts are those of the model."""

from __future__ import annotations

import re

import pytest

from swarmdsl.cli import run

MODEL = """package lab
event Go : std_msgs/Empty
struct Spot { x : float64 }
statemachine Inner {
  var left : int32 = 1
  initial X
  state X {
    var again : int32 = 2
    on Go / left = left - 1, again = again + left -> Y
  }
  final Y
}
endless statemachine M {
  param speed : float64 in m/s = 1 m/s
  var n : float64 in s = 0 s
  initial A
  state A { on Go / n = 60 m / speed + 1 s * self.index -> B }
  parallel state B {
    var all : int32 = 3
    region One {
      initial Work
      state Work {
        var tries : int32 = 0
        var spot  : Spot
        entry / tries = 7
        on Go [n > 2 s] / tries = tries + all -> Work
      }
    }
    region Two {
      var mine : int32 = 4
      initial Work
      state Work {
        var tries : int32 = 5
        on Go / tries = tries + mine, n = seconds(elapsed()) -> Work
      }
    }
    after 1 s -> C
  }
  state C = Inner { on done -> A }
}
"""


@pytest.fixture(scope="module")
def drawn(tmp_path_factory: pytest.TempPathFactory) -> str:
    """Statechart of `M` in Mermaid, without its escapes."""
    folder = tmp_path_factory.mktemp("drawn")
    (folder / "lab.swarm").write_text(MODEL, encoding="utf-8")
    words = ["diagram", str(folder / "lab.swarm"), "--name", "M", "--format", "mermaid"]
    assert run([*words, "-o", str(folder / "m.mmd")]) == 0
    text = (folder / "m.mmd").read_text(encoding="utf-8")
    return text.replace("#58;", ":").replace("#42;", "*").replace("#gt;", ">")


def test_variables_are_in_their_states(drawn: str) -> None:
    for state, *lines in (
        ("B", "var all : int32 = 3", "var Two.mine : int32 = 4"),
        ("C : Inner", "var left : int32 = 1"),
    ):
        assert f'state "{"<br/>".join([state, *lines])}" as ' in drawn
    for line in (
        "B_One_Work : var tries : int32 = 0",
        "B_One_Work : var spot : Spot",
        "B_Two_Work : var tries : int32 = 5",
        "C_X : var again : int32 = 2",
    ):
        assert f" {line}\n" in drawn
    assert len(re.findall(r"\bvar ", drawn)) == 8


def test_names_and_units_are_those_of_the_model(drawn: str) -> None:
    assert "Go / n = 60 m / speed + 1 s * self.index\n" in drawn
    assert "Go [n > 2.0 s] / tries = tries + all\n" in drawn
    assert "tries = tries + mine, n = seconds(elapsed(B.Two.Work))\n" in drawn
    assert "entry / tries = 7\n" in drawn
    assert "param speed : float64 in m/s = 1 m/s\n" in drawn
    assert "var n : float64 in s = 0.0 s\n" in drawn
    assert "left = left - 1, again = again + left\n" in drawn
    assert "_tries" not in drawn
