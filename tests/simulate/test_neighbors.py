"""Number of robots nearby: in runs, replays, proofs and targets."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from swarmdsl.cli import run

MODEL = """\
statemachine Gathering {{
  param reach : float64 in m = 5 m
  var neighbors : int32 = 0
  initial Move
  state Move {{
    {where}
  }}
  state Near {{
    after 1 s [neighbors > 0] -> End
  }}
  final End
}}

member Rover {{
  behavior Gathering
  body {{ radius = 0.3 m, speed = 1 m/s }}
}}

environment Field {{ size 100 m x 100 m x 10 m }}

swarm S {{
  rover : Rover[3]
  rover[0] at (10 m, 10 m) {{}}
  rover[1] at (14 m, 10 m) {{}}
  rover[2] at (10 m, 40 m) {{}}
  environment Field
}}
"""
NEAR = "after 1 s [neighbors within {} == {}] / neighbors = neighbors within reach -> Near"


@pytest.fixture
def model(tmp_path: Path) -> Path:
    path = tmp_path / "model.swarm"
    path.write_text(MODEL.format(where=NEAR.format("reach", 1)))
    return path


def ended(path: Path, capfd: pytest.CaptureFixture[str], *words: str) -> set[str]:
    """Return the robots that end in a run."""
    assert run(["simulate", str(path), "--trace", "json", "--until", "10 s", *words]) == 0
    lines = [json.loads(line) for line in capfd.readouterr().out.splitlines()]
    return {line["member"] for line in lines if line["configuration"] == ["End"]}


@pytest.mark.parametrize(
    ("distance", "number", "who"),
    [
        ("reach", 1, {"rover[0]", "rover[1]"}),
        ("3.9 m", 1, set()),
        ("4 m", 1, {"rover[0]", "rover[1]"}),
        ("400 cm", 1, {"rover[0]", "rover[1]"}),
        ("(reach + 25 m)", 2, {"rover[0]"}),
        ("(7 * reach)", 2, {"rover[0]", "rover[1]"}),
    ],
)
def test_a_guard_counts_the_others_within_a_distance(
    tmp_path, capfd, distance: str, number: int, who: set[str]
) -> None:
    pytest.importorskip("numpy")
    path = tmp_path / "model.swarm"
    path.write_text(MODEL.format(where=NEAR.format(distance, number)))

    assert ended(path, capfd) == who


def test_without_places_it_has_no_value(model, capfd) -> None:
    assert run(["simulate", str(model), "--world", "abstract", "--until", "10 s"]) == 0

    said = "".join(capfd.readouterr())
    assert "SW1007" in said
    assert "`neighbors within` has no value" in said


def test_a_replay_leaves_the_lines_out(model, capfd, tmp_path) -> None:
    pytest.importorskip("numpy")
    assert run(["simulate", str(model), "--trace", "json", "--until", "10 s"]) == 0
    trace = tmp_path / "trace.jsonl"
    trace.write_text(capfd.readouterr().out)

    assert run(["simulate", str(model), "--replay", str(trace)]) == 0
    said = "".join(capfd.readouterr())
    assert said.count("SW1020") == 3
    assert "0 lines of 3 members" in said


def test_a_proof_says_that_it_has_nobody_near(model, capfd) -> None:
    with model.open("a") as file:
        file.write("property Stays of S : each rover : never in Near\n")

    run(["verify", str(model)])

    out = "".join(capfd.readouterr())
    assert (
        "unknown  the run that was found may be impossible: robots are near each other in it" in out
    )


@pytest.mark.parametrize("target", ["ros2", "smach", "yasmin", "scxml"])
def test_targets_report_it(model, capfd, tmp_path, target: str) -> None:
    assert run(["build", str(model), "--target", target, "--out", str(tmp_path / "out")]) == 1

    said = "".join(capfd.readouterr())
    assert "SW0903" in said
    assert "cannot express the number of robots nearby" in said
    assert "model.swarm:6:" in said
