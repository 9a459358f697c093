"""`swarmc optimize --apply`: the edit of the text, and when there is none."""

from __future__ import annotations

from pathlib import Path

import pytest

from swarmdsl.cli import run

from .conftest import MODEL
from .test_optimize import write


def test_the_winner_is_written_into_the_model(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    optimize = "optimize Crew { robot.patience in 4 s .. 6 s step 1 s; count of robot in 1 .. 2 }"

    assert run([*write(tmp_path, optimize), "--jobs", "1", "--apply"]) == 0
    text = (tmp_path / "model.swarm").read_text(encoding="utf-8")
    assert "param patience : duration = 5 s" in text
    assert "robot : Robot[2..6];" in text
    assert "+swarm Crew { robot : Robot[2..6]; fitness Worth }" in capsys.readouterr().err

    # A number at the end of the multiplicity is the only one: what is left of a range is told.
    last = "optimize Crew { count of robot in 1 .. 3 }"
    three = MODEL.replace("Robot[1..6]", "Robot[1..3]")
    words = [*write(tmp_path, last, three), "--jobs", "1"]
    assert run([*words, "--apply"]) == 0
    assert "robot : Robot[3];" in (tmp_path / "model.swarm").read_text(encoding="utf-8")
    assert run(words) == 0
    said = capsys.readouterr()
    assert "warning[SW1811]: `count of robot` is searched in 3 .. 3, not in 1 .. 3" in said.err
    assert "Crew: 1 candidate," in said.out
    assert "today:  count of robot = 3\nthe winner is the model as it is\n" in said.out
    few = MODEL.replace("Robot[1..6]", "Robot[4..6]")
    assert run([*write(tmp_path, last, few), "--jobs", "1"]) == 1
    assert "error[SW1806]: swarm `Crew` has `Robot[4..6]`" in capsys.readouterr().err

    # Another swarm has the same members, so that the role gets the value.
    # A param without an effect stays as it is.
    shared = MODEL.replace(": duration = 8 s", ": duration = 8 s; param up : float64 in m = 2 m")
    shared += "swarm Others { robot : Robot }\n"
    up = optimize.replace("}", "; robot.up in 1 m .. 3 m step 1 m }")
    words = [*write(tmp_path, up, shared), "--swarm", "Crew", "--jobs", "1", "--apply"]
    assert run(words) == 0
    text = (tmp_path / "model.swarm").read_text(encoding="utf-8")
    assert "param patience : duration = 8 s" in text
    assert "robot : Robot[2..6] { patience = 5 s };" in text
    assert run(["check", "model.swarm"]) == 0
    # Now the role has one, which is replaced.
    given = text.replace("patience = 5 s", "patience = 6 s")
    (tmp_path / "model.swarm").write_text(given, encoding="utf-8")
    assert run([*words[:1], "model.swarm", *words[2:]]) == 0
    assert "{ patience = 5 s }" in (tmp_path / "model.swarm").read_text(encoding="utf-8")

    # Values keep their unit.
    only = "optimize Crew { robot.up in 3 m .. 5 m step 1 m }"
    assert run([*write(tmp_path, only, shared), "--swarm", "Crew", "--jobs", "1", "--apply"]) == 0
    assert "{ up = 3.0 m }" in (tmp_path / "model.swarm").read_text(encoding="utf-8")

    # A scenario with a value of its own would hide what is written, or no longer fit.
    words = [*write(tmp_path, "optimize Crew { count of robot in 2 .. 3 }"), "--jobs", "1"]
    with Path("scenario.toml").open("a", encoding="utf-8") as file:
        file.write("[count]\nrobot = 1\n")
    before = (tmp_path / "model.swarm").read_text(encoding="utf-8")
    assert run([*words, "--apply"]) == 1
    said = capsys.readouterr().err
    assert "error[SW1808]" in said
    assert "`scenario.toml` says `count.robot` itself" in said
    assert (tmp_path / "model.swarm").read_text(encoding="utf-8") == before

    # So would a value of its type, but not that of one robot, which runs of the search had too.
    words = [*write(tmp_path, optimize), "--jobs", "1", "--apply"]
    with Path("scenario.toml").open("a", encoding="utf-8") as file:
        file.write('[params]\n"robot[0]".patience = "9 s"\nRobot.patience = "9 s"\n')
    assert run(words) == 1
    said = capsys.readouterr().err
    assert "`scenario.toml` says `params.Robot.patience` itself" in said
    text = Path("scenario.toml").read_text(encoding="utf-8")
    Path("scenario.toml").write_text(text.replace('Robot.patience = "9 s"\n', ""), "utf-8")
    assert run(words) == 0
    capsys.readouterr()

    own = MODEL.replace("robot : Robot[1..6];", "robot : Robot[1..6]; robot[0] { patience = 9 s };")
    assert run([*write(tmp_path, optimize, own), "--jobs", "1", "--apply"]) == 1
    said = capsys.readouterr().err
    assert "error[SW1808]" in said
    assert "`robot[0]` has a value of its own for `patience`" in said
    assert (tmp_path / "model.swarm").read_text(encoding="utf-8") == own + optimize


def test_a_model_that_is_better_is_not_changed(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    optimize = "optimize Crew { robot.patience in 1 s .. 2 s step 1 s }"
    model = MODEL.replace("= 8 s", "= 5 s")

    assert run([*write(tmp_path, optimize, model), "--jobs", "1", "--apply"]) == 0
    said = capsys.readouterr()
    assert "with 95% confidence: today's model is better" in said.out
    assert "warning[SW1809]" in said.err
    assert (tmp_path / "model.swarm").read_text(encoding="utf-8") == model + optimize
