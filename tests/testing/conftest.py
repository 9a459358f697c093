"""Running tests of a small model."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import pytest

from swarmdsl.cli import run

MODEL = """package lamps

message Press { times : int32 }
action Blink { result { count : int32 } }
action Ring { result { } }

swarm event Start : std_msgs/Empty
swarm event Ping  : std_msgs/Empty
event Button : Press on "button"
event Told   : Press on "told"

function blink : abstraction { action "cmd/blink" : Blink }
function ring : abstraction { action "cmd/ring" : Ring }

statemachine Blinking {
  var count : int32
  initial Off

  state Off {
    on Start -> On
  }
  parallel state On {
    region Lamp {
      initial Bright
      state Bright {
        var shown : int32 = 1
        exit / shown = shown + 1
        do blink gives (count => count)
        on succeeded [count > 2] -> Dark
        on succeeded -> Bright
        on aborted   -> Broken
      }
      state Dark {
        var shown : int32 = 4
        var off   : bool = true
        entry / shown = shown + 1, send Ping(), send Told(times = count)
        after 5 s [off] -> Bright
      }
      state Broken {
        on Button [event.times == 3] -> Bright
      }
    }
    region Sound {
      initial Quiet
      state Quiet {
        on Ping -> Loud
      }
      state Loud {
        do ring
        on succeeded -> Quiet
        on aborted   -> Quiet
      }
    }
    on Start -> Gone
  }
  final Gone
}
endless statemachine Watching {
  initial Off
  state Off {
    on Ping -> Awake
  }
  state Awake {
    after 1 min -> Off
  }
}

sensor Eye { behavior Watching }
member Lamp {
  behavior Blinking
  eye : Eye
}
swarm Lamps {
  lamp : Lamp[3]
  spare : Lamp[0..2]
}
"""


@dataclass
class Ran:
    """Result of a command."""

    code: int
    out: str
    err: str


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with the model, in which commands are run."""
    (tmp_path / "lamps.swarm").write_text(MODEL, encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def swarmc(folder: Path, capsys: pytest.CaptureFixture[str]) -> Callable[..., Ran]:
    """Run a command line there."""

    def swarmc(*arguments: object) -> Ran:
        code = run([str(argument) for argument in arguments])
        captured = capsys.readouterr()
        return Ran(code, captured.out, captured.err)

    return swarmc


@pytest.fixture
def ran(folder: Path, swarmc: Callable[..., Ran]) -> Callable[..., Ran]:
    """Run a test file with this text."""

    def ran(text: str, *arguments: object) -> Ran:
        (folder / "it.swarmtest.toml").write_text(text, encoding="utf-8")
        return swarmc("test", "it.swarmtest.toml", *arguments)

    return ran
