"""Hostile repositories: git runs nothing of theirs, and nothing is written elsewhere."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from swarmdsl.cli import run
from swarmdsl.tools.compare import revisions

MODEL = "package p\nevent E : std_msgs/Empty\n"
MERGED = ("base.swarm", "ours.swarm", "theirs.swarm")

Git = Callable[..., bytes]


@pytest.fixture
def git(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Git:
    monkeypatch.setenv("GIT_CONFIG_GLOBAL", str(tmp_path / "none"))
    folder = tmp_path / "repository"
    folder.mkdir()

    def call(*words: str, given: bytes = b"", check: bool = True) -> bytes:
        done = subprocess.run(
            ["git", "-C", folder, *words], input=given, capture_output=True, check=check
        )
        return done.stdout

    call("init", "--quiet", "--initial-branch", "main")
    call("config", "user.name", "A")
    call("config", "user.email", "a@example.org")
    return call


@pytest.fixture
def hostile(git: Git, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> tuple[Path, Path]:
    """A repository with a program for each occasion, and the file that any of them makes.

    It is a partial clone that lacks the content of its model.
    """
    folder, marker = tmp_path / "repository", tmp_path / "marker"
    program = tmp_path / "program"
    program.write_text(f'#!/bin/sh\necho "$0 $*" >> "{marker}"\nexit 1\n')
    program.chmod(0o755)
    (folder / "model.swarm").write_text(MODEL, encoding="utf-8")
    for name in MERGED:
        # With a syntax error, so that they are merged by lines.
        (folder / name).write_text(f"{MODEL}event {name.partition('.')[0]} :\n", encoding="utf-8")
    kinds = "diff=odd merge=odd filter=odd"
    (folder / ".gitattributes").write_text(f"*.swarm {kinds}\n")
    git("add", ".")
    git("commit", "--quiet", "--message", "A model")
    hooks = folder / "hooks"
    hooks.mkdir()
    for name in ("post-checkout", "post-index-change", "pre-commit", "reference-transaction"):
        (hooks / name).symlink_to(program)
        (folder / ".git" / "hooks" / name).unlink(missing_ok=True)
        (folder / ".git" / "hooks" / name).symlink_to(program)
    for name, value in {
        "core.fsmonitor": program,
        "core.hooksPath": hooks,
        "core.pager": program,
        "core.editor": program,
        "core.sshCommand": program,
        "core.gitProxy": program,
        "core.askPass": program,
        "core.alternateRefsCommand": program,
        "credential.helper": program,
        "gpg.program": program,
        "diff.external": program,
        "diff.odd.textconv": program,
        "diff.odd.command": program,
        "merge.odd.driver": program,
        "filter.odd.clean": program,
        "filter.odd.smudge": program,
        "filter.odd.process": program,
        "filter.odd.required": "true",
        "protocol.allow": "always",
        "protocol.ext.allow": "always",
        "remote.origin.url": f"ext::{program}",
        "remote.origin.uploadpack": program,
        "remote.origin.promisor": "true",
        "remote.other.url": folder,
        "remote.other.uploadpack": program,
        "remote.other.promisor": "true",
        "core.repositoryFormatVersion": "1",
        "extensions.partialClone": "origin",
    }.items():
        git("config", name, str(value))
    lacking = git("rev-parse", "HEAD:model.swarm").decode().strip()
    (folder / ".git" / "objects" / lacking[:2] / lacking[2:]).unlink()
    marker.unlink(missing_ok=True)
    monkeypatch.chdir(folder)
    return folder, marker


def test_git_itself_runs_the_programs(hostile: tuple[Path, Path], git: Git) -> None:
    """The repository is as hostile as the other tests need it."""
    _, marker = hostile
    for words in (
        ("status",),
        ("diff",),
        ("cat-file", "-p", "HEAD:model.swarm"),
        ("merge-file", "-p", *MERGED[1:], MERGED[0]),
    ):
        git(*words, check=False)
    told = marker.read_text()
    assert told.count("\n") >= 3
    marker.unlink()
    git("cat-file", "-p", "HEAD:model.swarm", check=False)
    assert marker.exists()


def test_diff_runs_nothing(
    hostile: tuple[Path, Path], git: Git, capsys: pytest.CaptureFixture[str]
) -> None:
    folder, marker = hostile
    assert run(["diff", "model.swarm", "--against", "HEAD", "--format", "text"]) == 2
    assert "the repository lacks content of it: fetch it with git first" in capsys.readouterr().err
    # With its content, the revision is compared.
    env = {**os.environ, "GIT_CONFIG_COUNT": "1", "GIT_CONFIG_KEY_0": "filter.odd.required"}
    subprocess.run(
        ["git", "hash-object", "-w", "--no-filters", "model.swarm"],
        cwd=folder, env={**env, "GIT_CONFIG_VALUE_0": "false"}, check=True, capture_output=True,
    )  # fmt: skip
    marker.unlink(missing_ok=True)
    for words in (["model.swarm", "--against", "HEAD"], ["HEAD", "model.swarm"], ["HEAD:.", "."]):
        run(["diff", *words])
        assert "SW1401" not in capsys.readouterr().err
    assert not marker.exists()


def test_merge_runs_nothing(hostile: tuple[Path, Path], capsys: pytest.CaptureFixture[str]) -> None:
    _, marker = hostile
    assert run(["merge", *MERGED]) == 1
    assert "<<<<<<< ours" in capsys.readouterr().out
    assert not marker.exists()


def test_a_revision_is_no_option(git: Git, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    folder = tmp_path / "repository"
    (folder / "model.swarm").write_text(MODEL, encoding="utf-8")
    git("add", ".")
    git("commit", "--quiet", "--message", "A model")
    monkeypatch.chdir(folder)
    assert run(["diff", "model.swarm", "--against=--all"]) == 2


@pytest.mark.parametrize(
    ("entries", "name"),
    [
        ([b"100644 ../outside.swarm"], "../outside.swarm"),
        ([b"100644 /{folder}/outside.swarm"], "/"),
        ([b"100644 model.swarm/inner.swarm"], "exists"),
    ],
    ids=["upwards", "absolute", "file-and-folder"],
)
def test_names_that_lead_elsewhere(
    entries: list[bytes],
    name: str,
    git: Git,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    folder = tmp_path / "repository"
    (folder / "model.swarm").write_text(MODEL, encoding="utf-8")
    blob = git("hash-object", "-w", "model.swarm").decode().strip()
    listed = [b"100644 model.swarm", *entries]
    raw = b"".join(
        each.replace(b"{folder}", bytes(tmp_path).lstrip(b"/")) + b"\0" + bytes.fromhex(blob)
        for each in listed
    )
    words = ("hash-object", "-t", "tree", "-w", "--stdin", "--literally")
    tree = git(*words, given=raw).decode().strip()
    commit = git("commit-tree", tree, "-m", "A model").decode().strip()
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    monkeypatch.setattr("tempfile.tempdir", None)
    monkeypatch.chdir(folder)

    assert run(["diff", ".", "--against", commit]) == 2
    told = capsys.readouterr().err
    assert "SW1401" in told
    assert name in told
    assert not list(tmp_path.glob("outside*"))
    assert not Path("/outside.swarm").exists()


def test_doctor_runs_no_module_of_the_folder(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    for name in ("json", "importlib", "importlib/util", "rospy"):
        path = tmp_path / f"{name}.py"
        path.parent.mkdir(exist_ok=True)
        path.write_text(f"open({str(tmp_path / 'marker')!r}, 'w')\n")
    monkeypatch.chdir(tmp_path)
    ran = subprocess.run([sys.executable, "-c", "import json"], capture_output=True, check=False)
    assert (tmp_path / "marker").exists(), ran
    (tmp_path / "marker").unlink()

    run(["doctor"])
    assert str(tmp_path) not in capfd.readouterr().out
    assert not (tmp_path / "marker").exists()


def test_a_revision_that_is_too_large(
    git: Git, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Git gives its content in one piece."""
    monkeypatch.setattr(revisions, "MOST_TOGETHER", 2**20)
    folder = tmp_path / "repository"
    (folder / "model.swarm").write_text(" " * (2**20 + 1))
    git("add", ".")
    git("commit", "--quiet", "-m", "large")
    assert run(["diff", "--against", "HEAD", str(folder)]) == 2
    assert "its repository has more than 1 MB of models" in capsys.readouterr().err


def test_a_link_to_itself(git: Git, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    folder = tmp_path / "repository"
    (folder / "model.swarm").write_text(MODEL)
    git("add", ".")
    git("commit", "--quiet", "-m", "model")
    loop = folder / "loop.swarm"
    loop.symlink_to(loop)
    assert run(["diff", "--against", "HEAD", str(loop)]) == 2
    assert "error[SW1401]" in capsys.readouterr().err
