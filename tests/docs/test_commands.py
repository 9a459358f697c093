"""Every command in the documentation runs and prints what is shown.

In a `console` block a line with `$` is a command and the lines below it are its output, in
which `...` stands for anything. A command fails only where `echo $?` shows that it does. In
a `sh` block each line is a command.
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import pytest

from .pages import ROOT, Block, Page, blocks

SESSIONS = list(dict.fromkeys(block.page for block in blocks("console", "sh")))

# What is run, and what only a person should run: it installs, or takes long.
_RUN = ("swarmc", "textx", "pygmentize", "echo", "ls", "find", "cat", "sed")
_NOT_RUN = (
    ". .venv",
    "pip install",
    "make ",
    # What needs ROS 2 is run by tests/ros2.
    "colcon build",
    ". install/",
    "ros2 launch",
)


@dataclass
class Command:
    """A command as it is typed and what is shown below it; None where nothing is promised."""

    text: str
    shown: str | None


def commands(block: Block) -> list[Command]:
    if block.language == "sh":
        lines = [line.split(" #")[0].strip() for line in block.text.splitlines()]
        return [Command(line, None) for line in lines if line]
    found: list[Command] = []
    for line in block.text.splitlines(keepends=True):
        if line.startswith("$ "):
            found.append(Command(line[2:].strip(), ""))
        else:
            assert found, f"{block}: a console block begins with a command"
            assert found[-1].shown is not None
            found[-1].shown += line
    return found


def run(text: str, folder: Path, before: int) -> tuple[str, int]:
    """Run a command in a shell, `$?` being the exit code of the one before."""
    path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
    done = subprocess.run(
        ["bash", "-c", f"(exit {before}); {text}"],
        cwd=folder,
        # As on a terminal: the streams in the order in which they are written.
        env={**os.environ, "PATH": path, "PYTHONUNBUFFERED": "1", "NO_COLOR": "1"},
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        timeout=60,
    )
    return done.stdout, done.returncode


def matches(printed: str, shown: str) -> bool:
    """Whether it is what is shown, `...` standing for anything."""
    parts = (re.escape(part) for part in _normal(shown).split("..."))
    return re.fullmatch(".*".join(parts), _normal(printed), re.DOTALL) is not None


def _normal(text: str) -> str:
    return "\n".join(line.rstrip() for line in text.strip().splitlines())


@pytest.mark.parametrize("page", SESSIONS, ids=str)
def test_commands(page: Page, tmp_path: Path) -> None:
    """Follow a page from top to bottom in a folder that has the examples."""
    shutil.copytree(ROOT / "examples", tmp_path / "examples")
    for block in page.blocks:
        if "file" in block.attributes:
            (tmp_path / block.attributes["file"]).write_text(block.text, encoding="utf-8")
        if block.language in ("console", "sh"):
            follow(block, tmp_path)


def follow(block: Block, folder: Path) -> None:
    code = 0
    for command in commands(block):
        if command.text.startswith(_NOT_RUN):
            assert not command.shown, f"what `{command.text}` prints is not checked"
            continue
        assert command.text.split()[0] in _RUN, f"`{command.text}` is neither run nor excepted"
        if not command.text.startswith("echo "):
            assert code == 0, f"{block}: the exit code {code} is not shown"

        printed, code = run(command.text, folder, code)

        if command.shown is not None:
            assert matches(printed, command.shown), f"{block}\n$ {command.text}\n{printed}"
    assert code == 0, f"{block}: the exit code {code} is not shown"


def test_there_are_commands() -> None:
    """None of the tests above would fail if nothing were found."""
    assert sum(len(commands(block)) for block in blocks("console", "sh")) > 10


@pytest.mark.parametrize(
    ("printed", "shown", "same"),
    [
        ("a\nb\n", "a\nb", True),
        ("a\nb\nc\n", "a\n...\nc\n", True),
        ("a\nc\n", "a\nb\n", False),
        ("a\nb\n", "a\n", False),
    ],
)
def test_matches(printed: str, shown: str, same: bool) -> None:
    assert matches(printed, shown) == same
