"""`swarmc doc` as a user runs it."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from swarmdsl.cli import run

from .conftest import SAR

MODEL = (
    "package work\nendless statemachine Work { initial Busy; state Busy { after 1 s -> Busy } }\n"
)


@pytest.fixture
def model(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    path = tmp_path / "model.swarm"
    path.write_text(MODEL)
    return path


@pytest.mark.parametrize(
    ("options", "written"),
    [
        ([], "work.html"),
        (["-o", "page.html"], "page.html"),
        (["-o", "site"], "site/work.html"),
        (["-o", "there"], "there/work.html"),
        (["-o", "new/page.htm"], "new/page.htm"),
    ],
)
def test_where_it_goes(
    options: list[str], written: str, model: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    Path("there").mkdir()
    assert run(["doc", model.name, *options]) == 0
    assert Path(written).read_text().startswith("<!DOCTYPE html>\n")
    assert capsys.readouterr().err == f"{written}\nno errors in 1 file\n"


def test_a_page_is_written_anew(model: Path) -> None:
    Path("work.html").touch()
    assert run(["doc", model.name]) == 0
    model.write_text(MODEL.replace("Busy", "Idle"))
    assert run(["doc", model.name]) == 0
    assert 'id="Work.Idle"' in Path("work.html").read_text()


@pytest.mark.parametrize("kind", ["of another program", "edited", "not UTF-8"])
def test_what_is_not_its_own_is_kept(
    kind: str, model: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["doc", model.name]) == 0
    page = Path("work.html")
    mine = {
        "of another program": b"<!DOCTYPE html>\n<title>Mine</title>\n",
        "edited": page.read_bytes().replace(b"<h1 ", b"<p>Mine</p><h1 "),
        "not UTF-8": b"\xff\xfe<!-- swarmc doc ",
    }[kind]
    page.write_bytes(mine)
    capsys.readouterr()
    assert run(["doc", model.name]) == 1
    told = capsys.readouterr().err
    assert "error[SW0908]: refusing to overwrite `work.html`: it was edited or not written" in told
    assert "move it away, or choose another file with `-o`" in told
    assert page.read_bytes() == mine


def test_a_link_stays_one(model: Path) -> None:
    Path("page.html").symlink_to("real.html")
    assert run(["doc", model.name, "-o", "page.html"]) == 0
    assert Path("page.html").is_symlink()
    assert Path("real.html").stat().st_size > 0


def test_what_cannot_be_written_is_said(model: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["doc", model.name, "-o", "model.swarm/page.html"]) == 1
    assert "error[SW0909]: cannot write `model.swarm/page.html`" in capsys.readouterr().err


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="pipes of POSIX")
def test_a_pipe_stays_one(model: Path, capsys: pytest.CaptureFixture[str]) -> None:
    os.mkfifo("pipe.html")
    assert run(["doc", model.name, "-o", "pipe.html"]) == 1
    assert "it is no regular file" in capsys.readouterr().err
    assert Path("pipe.html").is_fifo()


def test_nothing_is_written_of_a_model_with_errors(
    model: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    model.write_text(MODEL.replace("-> Busy", "-> Bsuy"))
    assert run(["doc", model.name]) == 1
    assert "no state called `Bsuy`" in capsys.readouterr().err
    assert [path.name for path in model.parent.iterdir()] == [model.name]
    assert run(["doc", model.name, "--format", "json"]) == 1
    assert '"code":"SW0202"' in capsys.readouterr().err.replace(" ", "")


def test_warnings_are_told(model: Path, capsys: pytest.CaptureFixture[str]) -> None:
    model.write_text(MODEL + "statemachine never { initial A; state A; final B }\n")
    assert run(["doc", model.name]) == 0
    told = capsys.readouterr().err
    assert "warning[SW0503]" in told
    assert "warnings in 1 file" in told


def test_nothing_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The project file says what the model is, and how it is called."""
    monkeypatch.chdir(tmp_path)
    Path("src").mkdir()
    Path("src/model.swarm").write_text(MODEL)
    Path("swarm.toml").write_text('[project]\nname = "mission"\nsources = ["src"]\n')
    assert run(["doc"]) == 0
    assert "<title>mission</title>" in Path("mission.html").read_text()


def test_pages_are_the_same_in_every_process(tmp_path: Path) -> None:
    texts = set()
    for seed in ("0", "1"):
        command = [sys.executable, "-m", "swarmdsl", "doc", str(SAR), "-o", f"{seed}.html"]
        environment = {**os.environ, "PYTHONHASHSEED": seed}
        subprocess.run(command, capture_output=True, check=True, cwd=tmp_path, env=environment)
        texts.add((tmp_path / f"{seed}.html").read_bytes())
    assert len(texts) == 1
