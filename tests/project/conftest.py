"""Projects for tests: a folder with a project file, models and libraries."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import pytest

from swarmdsl.cli import run

MODEL = """package lamps
function blink : abstraction { action "cmd/blink" : lamp_msgs/Blink }
action lamp_msgs/Blink { }
statemachine Blinking {
  initial Blink
  state Blink {
    do blink
    on succeeded, aborted -> Off
  }
  final Off
}
member Blinker { behavior Blinking }
"""

# MODEL with an unreachable state.
ISLAND = MODEL.replace("  final Off", "  state Island { after 1 s -> Off }\n  final Off")


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
def project(tmp_path: Path, monkeypatch) -> Callable[[dict[str, str]], Path]:
    """Return a function that creates files in a new working directory."""

    def make(files: dict[str, str]) -> Path:
        root = tmp_path / "project"
        for name, text in files.items():
            path = root / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text, encoding="utf-8")
        monkeypatch.chdir(root)
        return root

    return make
