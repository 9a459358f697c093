"""`swarmc diff` on the command line, and with git."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path

import pytest
from markdown_it import MarkdownIt

from swarmdsl.cli import run

BEFORE = (
    "swarm event Go : std_msgs/Empty\n"
    "statemachine M { initial A; state A { on Go -> B } final B }\n"
)
AFTER = BEFORE.replace("Empty", "String")


@pytest.fixture
def repository(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A repository with a model in a folder, which has been changed since."""
    monkeypatch.setenv("GIT_CONFIG_GLOBAL", str(tmp_path / "none"))
    folder = tmp_path / "repository"
    model = folder / "models" / "a model.swarm"
    model.parent.mkdir(parents=True)
    model.write_text(BEFORE, encoding="utf-8")
    git(folder, "init", "--quiet", "--initial-branch", "main")
    git(folder, "add", ".")
    git(folder, "-c", "user.name=A", "-c", "user.email=a@example.org", "commit", "-qm", "A model")
    git(folder, "tag", "v1")
    model.write_text(AFTER, encoding="utf-8")
    monkeypatch.chdir(folder)
    return folder


def git(folder: Path, *words: str) -> None:
    subprocess.run(["git", *words], cwd=folder, check=True)


@pytest.fixture
def models(tmp_path: Path) -> tuple[str, str]:
    paths = tmp_path / "before.swarm", tmp_path / "after.swarm"
    for path, text in zip(paths, (BEFORE, AFTER), strict=True):
        path.write_text(text, encoding="utf-8")
    return str(paths[0]), str(paths[1])


def test_exit_codes(models: tuple[str, str], capsys: pytest.CaptureFixture[str]) -> None:
    before, after = models

    assert run(["diff", before, before]) == 0
    assert capsys.readouterr() == ("", "no differences\n")
    assert run(["diff", before, before, "--breaking"]) == 0
    assert capsys.readouterr() == ("", "nothing breaks\n")
    assert run(["diff", before, before, "--format", "json"]) == 0
    assert capsys.readouterr() == ("", "")
    assert run(["diff", before, after]) == 1
    assert "type is `std_msgs/String`, was `std_msgs/Empty` [EVENT_TYPE]" in capsys.readouterr().out
    assert run(["diff", before, f"{after}x"]) == 2
    assert "SW0001" in capsys.readouterr().err
    assert run(["diff"]) == run(["diff", before]) == 2
    assert "give two models" in capsys.readouterr().err


def test_a_revision_in_the_place_of_a_model(
    repository: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["diff", "v1", "models"]) == 2
    assert "write `swarmc diff --against v1 models`" in capsys.readouterr().err
    assert run(["diff", "v2", "models"]) == 2
    assert "no such file: `v2`" in capsys.readouterr().err


def test_a_new_transition_has_its_target(
    models: tuple[str, str], capsys: pytest.CaptureFixture[str]
) -> None:
    Path(models[1]).write_text(BEFORE.replace("on Go", "after 1 s -> B; on Go"), encoding="utf-8")
    for format_, line in (("text", "+ {} ("), ("markdown", "- {} added (")):
        assert run(["diff", *models, "--format", format_]) == 1
        line = line.format("transition `after 1 s -> B` of state `A`")
        assert line in capsys.readouterr().out


def test_what_breaks_can_be_allowed(
    models: tuple[str, str], capsys: pytest.CaptureFixture[str]
) -> None:
    assert run(["diff", *models, "--breaking"]) == 1
    assert capsys.readouterr().out.endswith("[EVENT_TYPE]\n")
    assert run(["diff", *models, "--breaking", "--allow", "event_type"]) == 0
    assert run(["diff", *models, "--breaking", "--allow", "EVENT_TYP"]) == 2
    assert "did you mean `EVENT_TYPE`?" in capsys.readouterr().err
    assert run(["diff", *models, "--allow", "EVENT_TYPE"]) == 2
    assert run(["diff", "--rules"]) == 0
    assert "EVENT_TYPE " in capsys.readouterr().out


def test_formats(models: tuple[str, str], capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["diff", *models, "--format", "markdown"]) == 1
    first, second = capsys.readouterr().out.splitlines()
    assert first == f"- **event `Go`** ({models[1]}:1)"
    assert second.startswith("  - type is `std_msgs/String`, was `std_msgs/Empty` [EVENT_TYPE] (")
    assert run(["diff", *models, "--format", "json"]) == 1
    assert json.loads(capsys.readouterr().out) == {
        "change": "changed",
        "declaration": "event Go",
        "kind": "event",
        "name": "Go",
        "of": None,
        "what": "type",
        "before": "std_msgs/Empty",
        "after": "std_msgs/String",
        "strength": None,
        "breaking": "EVENT_TYPE",
        "place_before": f"{models[0]}:1",
        "place_after": f"{models[1]}:1",
    }
    assert run(["diff", *models, "--format", "json", "--breaking"]) == 1
    assert json.loads(capsys.readouterr().out)["rule"] == "EVENT_TYPE"


@pytest.mark.usefixtures("repository")
@pytest.mark.parametrize(
    "words",
    [
        ["--against", "HEAD"],
        ["--against", "HEAD", "models"],
        ["--against", "v1", "models/a model.swarm"],
        ["--against", ".git#branch=main", "models"],
        ["--against", ".git#tag=v1,subdir=models", "."],
        ["--against", "main:models", "models"],
        ["HEAD:models", "models"],
    ],
    ids=" ".join,
)
def test_revisions(words: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["diff", *words, "--format", "json"]) == 1
    found = json.loads(capsys.readouterr().out)
    assert found["place_before"].partition(":")[2] == "models/a model.swarm:1"
    assert found["place_after"] == "models/a model.swarm:1"


def test_two_revisions(repository: Path) -> None:
    git(repository, "-c", "user.name=A", "-c", "user.email=a@example.org", "commit", "-qam", "B")

    assert run(["diff", "v1:models", "main:models"]) == 1
    assert run(["diff", "HEAD:models", "models"]) == 0


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--against", "nope", "models"], "cannot compare with `nope`: no such revision in git"),
        (["--against", "HEAD", "elsewhere"], "`HEAD:elsewhere`: it contains no model"),
        (["HEAD:/", "models"], "not a git repository"),
    ],
)
def test_revisions_that_are_not_there(
    words: list[str], said: str, repository: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (repository / "elsewhere").mkdir()

    assert run(["diff", *words]) == 2
    printed = capsys.readouterr().err
    assert "error[SW1401]" in printed
    assert said in printed


def test_a_model_with_errors_is_named_as_git_names_it(
    repository: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    model = repository / "models" / "a model.swarm"
    model.write_text(BEFORE.replace("on Go", "on Gone"), encoding="utf-8")
    git(repository, "-c", "user.name=A", "-c", "user.email=a@example.org", "commit", "-qam", "C")
    model.write_text(BEFORE, encoding="utf-8")

    assert run(["diff", "--against", "HEAD", "models"]) == 2
    assert "HEAD:models/a model.swarm:2:" in capsys.readouterr().err


def test_without_git(
    repository: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("PATH", str(repository))

    assert run(["diff", "--against", "HEAD", "models"]) == 2
    assert "git is not installed" in capsys.readouterr().err


def test_strings_in_markdown_are_text(
    models: tuple[str, str], capsys: pytest.CaptureFixture[str]
) -> None:
    hostile = "` ![x](http://x/y.png) <b> [x](y)"
    for path, text in zip(models, ("plain", hostile), strict=True):
        param = f'param p : string = "{text}"; initial'
        Path(path).write_text(BEFORE.replace("initial", param), encoding="utf-8")
    assert run(["diff", *models, "--format", "markdown"]) == 1
    tokens = MarkdownIt("commonmark").parse(capsys.readouterr().out)
    inner = [child for token in tokens for child in token.children or ()]
    assert "http://x/y.png" in "".join(token.content for token in inner)
    assert not {token.type for token in inner} & {"image", "link_open", "html_inline"}
