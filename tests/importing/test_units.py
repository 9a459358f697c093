"""Units come back to expressions of a document, which has plain numbers."""

from __future__ import annotations

from pathlib import Path

from swarmdsl.cli import run

MODEL = """package p

swarm event Go : std_msgs/Int32

struct Item {
  far  : float64 in m
  kind : int32
}

endless statemachine M {
  param way : float64 in m = 15 m
  var items : Item[<=3]
  var ways  : float64 in m[<=3]
  var n     : int32

  initial A

  state A {
    on Go [any(o in items where o.far > 1 m) and ways[0] < 2 m]
      / append 3 m to ways, ways[0] = 4 m, n = floor(way / 1 m)
    on Go [contains(ways, 3 m) or min(x in ways) > 5 m and n > 1]
      / append Item(far = 2 m, kind = int(way / 1 m)) to items
  }
}

member R { behavior M }
"""


def test_units_in_queries_arrays_messages_and_rounded_numbers(tmp_path: Path) -> None:
    model, again = tmp_path / "model.swarm", tmp_path / "again.swarm"
    text = MODEL.replace("float64 in m[<=3]", "float64[<=3] in m")
    model.write_text(text, encoding="utf-8")
    arguments = ["--target", "scxml", "--option", "scxml.profile=portable"]
    assert run(["build", str(model), *arguments, "-o", str(tmp_path)]) == 0
    document = next(tmp_path.rglob("M.scxml"))

    assert run(["import", "scxml", str(document), "-o", str(again)]) == 0

    lines = [line.strip() for line in again.read_text(encoding="utf-8").splitlines()]
    wanted = [line.strip() for line in text.splitlines() if line.strip().startswith(("on", "/"))]
    assert [line for line in wanted if line not in lines] == []
