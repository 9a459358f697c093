"""Running `swarmc`, in this process and in its own."""

import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import pytest

from swarmdsl.cli import run

GOOD = """package lamps
function blink : abstraction { action "cmd/blink" : lamp_msgs/Blink }
statemachine Blinking {
  initial Blink
  state Blink {
    do blink
    on succeeded -> Off
    on aborted   -> Off
  }
  final Off
}
member Blinker { behavior Blinking }
"""

BAD = GOOD.replace("on aborted   -> Off", "on aborted   -> Of").replace(
    "behavior Blinking", "behavior Blinkng"
)


@dataclass
class Ran:
    code: int
    out: str
    err: str


@pytest.fixture
def swarmc(capsys) -> Callable[..., Ran]:
    """Run a command line in this process."""

    def swarmc(*arguments: object) -> Ran:
        code = run([str(argument) for argument in arguments])
        captured = capsys.readouterr()
        return Ran(code, captured.out, captured.err)

    return swarmc


@pytest.fixture
def spawn() -> Callable[..., subprocess.Popen[bytes]]:
    """Start a command line in a process of its own."""

    def spawn(*arguments: object, **options) -> "subprocess.Popen[bytes]":
        command = [sys.executable, "-m", "swarmdsl", *map(str, arguments)]
        pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE, **options}
        return subprocess.Popen(command, **pipes)

    return spawn


@pytest.fixture
def good(tmp_path: Path) -> Path:
    path = tmp_path / "lamps.swarm"
    path.write_text(GOOD, encoding="utf-8")
    return path


@pytest.fixture
def bad(tmp_path: Path) -> Path:
    path = tmp_path / "bad.swarm"
    path.write_text(BAD, encoding="utf-8")
    return path
