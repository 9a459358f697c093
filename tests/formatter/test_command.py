"""`swarmc fmt`: what is written and printed, and the exit code."""

from __future__ import annotations

import errno
import io
import os
import sys
from pathlib import Path

import pytest

from swarmdsl.cli import run

MESSY, NEAT = b"event A:B\nevent  CC:B", b"event A  : B\nevent CC : B\n"


@pytest.fixture
def folder(tmp_path, monkeypatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "messy.swarm").write_bytes(MESSY)
    (tmp_path / "neat.swarm").write_bytes(NEAT)
    return tmp_path


def test_files_are_rewritten_only_when_they_change(folder, capsys):
    neat = folder / "neat.swarm"
    os.utime(neat, (1, 1))
    assert run(["fmt"]) == 0
    assert (folder / "messy.swarm").read_bytes() == NEAT
    assert neat.stat().st_mtime == 1
    assert sorted(path.name for path in folder.iterdir()) == ["messy.swarm", "neat.swarm"]
    captured = capsys.readouterr()
    assert (captured.out, captured.err) == ("", "1 file formatted, 1 file unchanged\n")


def test_check_lists_what_would_change(folder, capsys):
    assert run(["fmt", "--check", "messy.swarm", "neat.swarm", "./messy.swarm"]) == 1
    captured = capsys.readouterr()
    assert captured.out == "messy.swarm\n"
    assert captured.err == "1 file would be formatted, 1 file unchanged\n"
    assert (folder / "messy.swarm").read_bytes() == MESSY
    assert run(["fmt", "--check", "neat.swarm"]) == 0


def test_diff(folder, capsys):
    assert run(["fmt", "--diff", "messy.swarm"]) == 1
    assert capsys.readouterr().out.splitlines() == [
        "--- messy.swarm",
        "+++ messy.swarm",
        "@@ -1,2 +1,2 @@",
        "-event A:B",
        "-event  CC:B",
        "\\ No newline at end of file",
        "+event A  : B",
        "+event CC : B",
    ]
    assert (folder / "messy.swarm").read_bytes() == MESSY


def test_a_file_with_errors_is_left_alone_and_others_are_not(folder, capsys):
    (folder / "bad.swarm").write_bytes(b"event  A :")
    assert run(["fmt", "--format", "concise"]) == 1
    assert (folder / "bad.swarm").read_bytes() == b"event  A :"
    assert (folder / "messy.swarm").read_bytes() == NEAT
    err = capsys.readouterr().err
    assert err.startswith("bad.swarm:1:")
    assert err.endswith("\n1 file formatted, 1 file unchanged, 1 file with errors\n")


@pytest.mark.parametrize(
    ("content", "expected"),
    [
        (b"\xef\xbb\xbfevent A:B", b"event A : B\n"),
        (b"event A:B\r\nevent B:B\n", b"event A : B\r\nevent B : B\r\n"),
        (b"event A:B\nevent B:B\r\n", b"event A : B\nevent B : B\n"),
        (b"", b""),
    ],
)
def test_line_ends_and_byte_order_marks(folder, content, expected):
    path = folder / "messy.swarm"
    path.write_bytes(content)
    assert run(["fmt", str(path)]) == 0
    assert path.read_bytes() == expected


@pytest.mark.skipif(os.name == "nt", reason="permissions and links of Unix")
def test_permissions_and_links_stay(folder):
    path = folder / "messy.swarm"
    path.chmod(0o640)
    link = folder / "link.swarm"
    link.symlink_to(path)
    assert run(["fmt", "link.swarm"]) == 0
    assert link.is_symlink()
    assert path.read_bytes() == NEAT
    assert path.stat().st_mode & 0o777 == 0o640


def feed(monkeypatch, content: bytes) -> None:
    monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(content)))


def test_standard_input(monkeypatch, capsysbinary):
    feed(monkeypatch, MESSY)
    assert run(["fmt", "-"]) == 0
    assert capsysbinary.readouterr() == (NEAT, b"")


def test_standard_input_with_errors(monkeypatch, capsys):
    feed(monkeypatch, b"event")
    assert run(["fmt", "-"]) == 1
    captured = capsys.readouterr()
    assert captured.out == ""
    assert "<stdin>:1:" in captured.err


def test_standard_input_stands_alone(folder):
    assert run(["fmt", "-", "neat.swarm"]) == 2


def test_a_missing_file(folder, capsys):
    assert run(["fmt", "nowhere.swarm"]) == 1
    assert "SW0001" in capsys.readouterr().err


def test_a_disk_that_is_full(folder, capsys, monkeypatch):
    def full(*_paths: object) -> None:
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(os, "replace", full)
    assert run(["fmt", "messy.swarm"]) == 1
    assert "error[SW0909]: cannot write" in capsys.readouterr().err
    assert (folder / "messy.swarm").read_bytes() == MESSY
    assert sorted(path.name for path in folder.iterdir()) == ["messy.swarm", "neat.swarm"]


def test_migration_divides_statements_on_one_line(folder, capsys):
    (folder / "old.swarm").write_text("event A : T event B : T\n", encoding="utf-8")

    assert run(["fmt", "old.swarm"]) == 1
    assert "SW0108" in capsys.readouterr().err
    assert run(["fmt", "--migrate", "old.swarm"]) == 0
    assert (folder / "old.swarm").read_text(encoding="utf-8") == "event A : T\nevent B : T\n"
