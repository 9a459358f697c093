"""`swarmc diagram` as a user runs it."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from swarmdsl.cli import run

from .conftest import MODEL


def test_one_goes_to_standard_output(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["diagram", str(MODEL), "--name", "Homing", "--format", "mermaid"]) == 0
    told = capsys.readouterr()
    assert told.out.startswith("---\ntitle: statemachine Homing\n---\nstateDiagram-v2\n")
    assert told.err == "no errors in 1 file\n" or "no errors in" in told.err


def test_several_go_to_a_folder(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    out = tmp_path / "new" / "pictures"
    assert run(["diagram", str(MODEL), "--format", "dot", "-o", str(out)]) == 0
    names = ["Homing.statechart", "Pack.composition", "Patrol.statechart", "Rover.internal"]
    assert sorted(path.name for path in out.iterdir()) == [f"{name}.dot" for name in names]
    assert f"{out.as_posix()}/Pack.composition.dot\n" in capsys.readouterr().err


def test_one_goes_to_a_file(tmp_path: Path) -> None:
    out = tmp_path / "rover.puml"
    options = ["--kind", "internal", "--format", "plantuml", "-o", str(out)]
    assert run(["diagram", str(MODEL), *options]) == 0
    assert out.read_text().startswith("@startuml\ntitle member Rover\n")


@pytest.mark.parametrize(
    ("options", "code", "said"),
    [
        ([], 1, "error[SW1302]: cannot write 4 diagrams to standard output"),
        (["--name", "Patrl"], 1, "did you mean `Patrol`?"),
        (["--kind", "swarm"], 2, "'swarm' is not one of"),
        (["-o", "all.svg"], 1, "error[SW1302]: cannot write 4 diagrams to file `all.svg`"),
        (["-o", "all.svg"], 1, "give a folder with `-o`, or select one: `--name Pack`"),
        (["-o", "one.PNG"], 2, "`.png` is not written; name a file that ends with `.svg` (with"),
        (["-o", "one.dot"], 2, "ends with `.svg`, or add `--format dot`"),
        (["-o", "rover.swarm/x/y"], 1, "error[SW0909]: cannot write"),
    ],
)
def test_what_cannot_be_done_is_said(
    options: list[str],
    code: int,
    said: str,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(MODEL.parent)
    assert run(["diagram", MODEL.name, *options]) == code
    told = capsys.readouterr()
    assert said in told.err
    assert told.out == ""
    assert not [*MODEL.parent.glob("all.*"), *MODEL.parent.glob("one.*")]


def test_a_timeline_is_no_other_picture(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "t.png"
    assert run(["simulate", str(MODEL), "--machine", "Patrol", "--timeline", str(path)]) == 2
    assert "`.png` is not written; name a file that ends with `.svg`" in capsys.readouterr().err
    assert not path.exists()


def test_nothing_to_draw(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "events.swarm"
    path.write_text("event E : std_msgs/Empty\n")
    assert run(["diagram", str(path), "--kind", "statechart"]) == 1
    assert "error[SW1301]: nothing to draw in statechart diagrams" in capsys.readouterr().err


def test_nothing_is_written_of_a_model_with_errors(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    path, out = tmp_path / "model.swarm", tmp_path / "out"
    path.write_text("statemachine A {\n  initial B\n  state B { on X -> C }\n}\n")
    assert run(["diagram", str(path), "-o", str(out)]) == 1
    assert not out.exists()
    assert "no state called `C`" in capsys.readouterr().err


def test_pictures_are_the_same_in_every_process() -> None:
    texts = set()
    for seed in ("0", "1", "2"):
        command = [sys.executable, "-m", "swarmdsl", "diagram", str(MODEL), "--name", "Patrol"]
        ran = subprocess.run(
            command, capture_output=True, check=True, env={**os.environ, "PYTHONHASHSEED": seed}
        )
        texts.add(ran.stdout)
    assert len(texts) == 1
    assert texts.pop()
