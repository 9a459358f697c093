"""One run shows every mistake, of every phase, in every file, each at its place."""

from __future__ import annotations

from pathlib import Path

from swarmdsl.driver import pipeline

MAIN = """\
package mission

import "behaviours.swarm"

event Start std_msgs/Empty

member Uav {
  behavior Serach
  param altitude : float64 = "high"
}

swarm Mission {
  uav : Uav[5..2]
}
"""
BEHAVIOURS = """\
package behaviours

event Stop : std_msgs/Empty

statemachine Search {
  initial Idle
  state Idle {
    on Stop ->
  }
  final Done
}

endless statemachine Watch {
  initial Idle
  state Idle {
    on Stop -> Done
  }
}
"""


def test_six_mistakes_in_two_files(tmp_path: Path) -> None:
    (tmp_path / "main.swarm").write_text(MAIN)
    (tmp_path / "behaviours.swarm").write_text(BEHAVIOURS)
    result = pipeline.check([tmp_path / "main.swarm"])
    found = [
        (
            Path(one.primary.span.source.name).name,
            *one.primary.span.source.line_column(one.primary.span.start),
            one.name,
            one.primary.span.text,
        )
        for one in result.report
        if one.primary
    ]

    assert found == [
        ("behaviours.swarm", 8, 13, "syntax-error", "->"),
        ("behaviours.swarm", 16, 16, "unresolved-name", "Done"),
        ("main.swarm", 5, 13, "syntax-error", "std_msgs"),
        ("main.swarm", 8, 12, "unresolved-name", "Serach"),
        ("main.swarm", 9, 30, "type-mismatch", '"high"'),
        ("main.swarm", 13, 13, "empty-multiplicity", "5..2"),
    ]
    assert result.system is None


def test_hints_end_where_nobody_reads_them(tmp_path: Path) -> None:
    names = [f"Ready{number:03}Up" for number in range(200)]
    events = "".join(f"event {name} : std_msgs/Empty\n" for name in names)
    triggers = "".join(f"on {name}s -> Done\n" for name in names)
    path = tmp_path / "main.swarm"
    path.write_text(
        f"{events}statemachine M {{ initial A\nstate A {{\n{triggers}}}\nfinal Done\n}}\n"
    )
    found = [one for one in pipeline.check([path]).report if one.name == "unresolved-name"]

    assert [one.message for one in found] == [f"no event called `{name}s`" for name in names]
    assert [one.help for one in found if one.help] == [
        f"did you mean `{name}`?" for name in names[:50]
    ]
