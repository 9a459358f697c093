"""Follows a page as a reader does: runs its commands, writes its files, makes its changes.

In a `console` block a line with `$` is a command and the lines below it are its output, in
which `...` stands for anything. A command fails only where `echo $?` shows that it does. In
a `sh` block each line is a command.
"""

from __future__ import annotations

import os
import re
import subprocess
import sys
from dataclasses import dataclass, field
from pathlib import Path

import tomli

from .pages import Block

# What is run, and what only a person should run: it installs, or takes long.
_RUN = (
    "swarmc",
    "textx",
    "pygmentize",
    "echo",
    "ls",
    "find",
    "cat",
    "cp",
    "sed",
    "rm",
    "cd",
    "pip",
    "pytest",
    "python",
)
_NOT_RUN = (
    "python3 -m venv",
    ". ~/swarm/",
    ". .venv",
    "pip install path/",
    "make ",
    # What needs ROS 2 is run by tests/ros2.
    "colcon build",
    ". install/",
    "ros2 launch",
    "network=$(ros2 pkg prefix ",
    "export ",
    # tests/editors compiles it.
    "cc ",
)


@dataclass
class Command:
    """A command as it is typed and what is shown below it; None where nothing is promised."""

    text: str
    shown: str | None


@dataclass
class Walk:
    """A reader in a folder, on the way through a page."""

    folder: Path
    installed: list[Path] = field(default_factory=list)

    def follow(self, block: Block) -> None:
        """Do what a block says."""
        if "file" in block.attributes:
            self._write(block)
        elif block.language in ("console", "sh"):
            self._run_all(block)

    def _write(self, block: Block) -> None:
        name = block.attributes["file"]
        path = self.folder / name.removeprefix("+")
        path.parent.mkdir(parents=True, exist_ok=True)
        if block.language == "diff":
            text = path.read_text(encoding="utf-8")
            before, after = sides(block.text)
            assert text.count(before) == 1, f"{block}: not once in {name}:\n{before}"
            path.write_text(text.replace(before, after), encoding="utf-8")
        else:
            with path.open("a" if name.startswith("+") else "w", encoding="utf-8") as stream:
                stream.write(block.text)

    def _run_all(self, block: Block) -> None:
        code = 0
        for command in commands(block):
            if command.text.startswith(_NOT_RUN):
                assert not command.shown, f"what `{command.text}` prints is not checked"
                continue
            assert command.text.split()[0] in _RUN, f"`{command.text}` is neither run nor excepted"
            if not command.text.startswith("echo "):
                assert code == 0, f"{block}: the exit code {code} is not shown"

            printed, code = self.run(command.text, code)

            if command.shown is not None:
                assert matches(printed, command.shown), f"{block}\n$ {command.text}\n{printed}"
        assert code == 0, f"{block}: the exit code {code} is not shown"

    def _install(self, package: Path) -> str:
        """Do for a package what pip does, for this reader alone and without an index."""
        about = tomli.loads((package / "pyproject.toml").read_text(encoding="utf-8"))["project"]
        info = package / f"{about['name'].replace('-', '_')}-{about['version']}.dist-info"
        info.mkdir()
        (info / "METADATA").write_text(
            f"Metadata-Version: 2.1\nName: {about['name']}\nVersion: {about['version']}\n"
        )
        with (info / "entry_points.txt").open("w", encoding="utf-8") as stream:
            for group, points in about["entry-points"].items():
                stream.write(f"[{group}]\n")
                stream.writelines(f"{name} = {place}\n" for name, place in points.items())
        self.installed.append(package)
        return ""

    def run(self, text: str, before: int = 0) -> tuple[str, int]:
        """Run a command in a shell, `$?` being the exit code of the one before."""
        if text.startswith("cd "):
            self.folder = (self.folder / text.removeprefix("cd ")).resolve(strict=True)
            return "", 0
        if text.startswith("pip install -e "):
            return self._install(self.folder / text.removeprefix("pip install -e ")), 0
        path = f"{Path(sys.executable).parent}{os.pathsep}{os.environ['PATH']}"
        done = subprocess.run(
            ["bash", "-c", f"(exit {before}); {text}"],
            cwd=self.folder,
            # As on a terminal: the streams in the order in which they are written.
            env={
                **os.environ,
                "PATH": path,
                "PYTHONPATH": os.pathsep.join(map(str, self.installed)),
                "PYTHONUNBUFFERED": "1",
                "NO_COLOR": "1",
            },
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            timeout=60,
        )
        return done.stdout, done.returncode


def commands(block: Block) -> list[Command]:
    """The commands of a block."""
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


def sides(diff: str) -> tuple[str, str]:
    """The text before a change and after it, of lines that begin with ` `, `-` or `+`."""
    lines = diff.splitlines(keepends=True)
    assert {line[0] for line in lines} <= set(" -+"), diff
    before = "".join(line[1:] for line in lines if line[0] in " -")
    return before, "".join(line[1:] for line in lines if line[0] in " +")


def matches(printed: str, shown: str) -> bool:
    """Return True if the output matches the one shown; `...` matches anything."""
    parts = (re.escape(part) for part in _normal(shown).split("..."))
    return re.fullmatch(".*".join(parts), _normal(printed), re.DOTALL) is not None


def _normal(text: str) -> str:
    return "\n".join(line.rstrip() for line in text.strip().splitlines())
