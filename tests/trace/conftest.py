"""A model that is built, and what `swarmc trace` says of logs about it."""

from __future__ import annotations

import re
import shutil
from collections.abc import Callable
from io import BytesIO
from pathlib import Path

import pytest

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.cli import run as swarmc
from swarmdsl.tools.trace.command import run

MODEL = Path(__file__).parents[1] / "skeleton" / "model.swarm"
NOTE = re.compile(r"(?:\[\S+\] )*(?: *--> | *\d* \| |  = note: | +\|$)")

Build = Callable[..., Path]
Trace = Callable[..., str]


@pytest.fixture
def build(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Build:
    """Build the model of skeletons in a folder of its own, which becomes the current one."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.delenv("FORCE_COLOR", raising=False)

    def build(target: str = "skeleton", *options: str, model: Path = MODEL) -> Path:
        shutil.copy(model, tmp_path / model.name)
        words = [word for option in options for word in ("--option", f"{target}.{option}")]
        assert swarmc(["build", model.name, "--target", target, "-o", "src", *words]) == 0
        return tmp_path / "src" / target

    return build


@pytest.fixture
def trace() -> Trace:
    """Trace a log without diagnostics; return the output."""

    def trace(log: str | bytes, *outs: Path) -> str:
        data = log if isinstance(log, bytes) else log.encode()
        stdout, report = BytesIO(), Diagnostics()
        run((), outs, BytesIO(data), stdout, report, colour=False)
        assert [found.message for found in report] == []
        return stdout.getvalue().decode()

    return trace


def line_of(path: Path, text: str) -> int:
    """The number of the one line that has a text."""
    lines = path.read_text(encoding="utf-8").splitlines()
    [found] = [number for number, line in enumerate(lines, 1) if text in line]
    return found
