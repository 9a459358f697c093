"""A project of a stranger makes no command write elsewhere, unless the command line says so."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from swarmdsl.cli import run

MODEL = """package p
event E : std_msgs/Empty
endless statemachine M { initial A; state A { on E -> A } }
member Bot { behavior M }
swarm Team { bot : Bot }
"""
UGLY = b"""package q
event   F : std_msgs/Empty
sensor Ear { out heard : std_msgs/Empty }
"""

Project = Callable[[str], Path]


@pytest.fixture
def project(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Project:
    """A project with a project file, the current folder; beside it another folder."""
    folder = tmp_path / "project"

    def make(toml: str) -> Path:
        folder.mkdir()
        (tmp_path / "elsewhere").mkdir()
        (folder / "model.swarm").write_text(MODEL, encoding="utf-8")
        if toml:
            (folder / "swarm.toml").write_text(toml, encoding="utf-8")
        monkeypatch.chdir(folder)
        return folder

    return make


def elsewhere(folder: Path) -> dict[str, bytes]:
    """All files beside the project."""
    return {
        path.relative_to(folder.parent).as_posix(): path.read_bytes()
        for path in folder.parent.rglob("*")
        if path.is_file() and not path.is_relative_to(folder)
    }


@pytest.mark.parametrize(
    "out", ["../elsewhere", "{tmp}/elsewhere/new", "link", "link/in/it", "out"]
)
@pytest.mark.parametrize("words", [["build"], ["build", "--clean"], ["build", "--dry-run"]])
def test_an_output_folder_elsewhere(
    out: str, words: list[str], project: Project, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    given = out.replace("{tmp}", str(tmp_path))
    # The last is the default: a link makes it lead elsewhere.
    folder = project("" if out == "out" else f'[build]\nout = "{given}"\n')
    for link in ("link", "out"):
        (folder / link).symlink_to(tmp_path / "elsewhere")

    assert run([*words, "--format", "concise"]) == 1
    said = capsys.readouterr()
    assert "SW0017" in said.out + said.err
    if out != "out":
        assert "swarm.toml:2:7: " in said.out + said.err
    assert elsewhere(folder) == {}

    # Who asks for it gets it, and a folder of the project is no question.
    assert run(["build", "-o", given, "--target", "scxml"]) == 0
    assert run(["build", "-o", "here", "--target", "scxml"]) == 0
    assert elsewhere(folder) != {}


def test_watching(
    project: Project, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = project('[build]\nout = "../elsewhere"\n')

    def stop(seconds: float) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("swarmdsl.cli.watch.sleep", stop)
    assert run(["build", "--watch", "--format", "concise"]) == 0
    said = capsys.readouterr()
    assert "SW0017" in said.out + said.err
    assert elsewhere(folder) == {}


@pytest.mark.parametrize(
    ("toml", "linked"),
    [('[project]\nsources = ["model.swarm", "../elsewhere"]\n', False), ("", True)],
    ids=["sources", "link"],
)
def test_models_elsewhere(
    toml: str, linked: bool, project: Project, capsys: pytest.CaptureFixture[str]
) -> None:
    folder = project(toml)
    other = folder.parent / "elsewhere" / "other.swarm"
    other.write_bytes(UGLY)
    if linked:
        (folder / "other.swarm").symlink_to(other)
    name = "other.swarm" if linked else "../elsewhere/other.swarm"

    add = ["add", "component", "Eye", "--out", "seen:std_msgs/Empty"]
    # It would be best there, beside another one.
    for words in (["rename", "F", "Found"], add, *([["fmt"]] if linked else [])):
        assert run([*words, "--format", "concise"]) == 1, words
        assert "SW0017" in capsys.readouterr().err
    assert elsewhere(folder) == {"elsewhere/other.swarm": UGLY}

    assert run([*add, "--file", name]) == 0
    assert run(["rename", "F", "Found", "model.swarm", name]) == 0
    assert run(["fmt", name]) == 0
    (changed,) = elsewhere(folder).values()
    assert changed.startswith(b"package q\n\nevent Found : std_msgs/Empty\n")
    assert b"sensor Eye" in changed


def test_an_import_elsewhere(project: Project, capsys: pytest.CaptureFixture[str]) -> None:
    """Files that a model imports are changed in the project only."""
    folder = project("[project]\n")
    other = folder.parent / "elsewhere" / "other.swarm"
    other.write_bytes(UGLY)
    text = MODEL.replace("event E", 'import "../elsewhere/other.swarm"\nevent E').replace(
        "on E", "on F"
    )
    (folder / "model.swarm").write_text(text, encoding="utf-8")

    assert run(["rename", "F", "Found", "--format", "concise"]) == 1
    assert "SW0017" in capsys.readouterr().err
    assert elsewhere(folder) == {"elsewhere/other.swarm": UGLY}
    assert (folder / "model.swarm").read_text(encoding="utf-8") == text
