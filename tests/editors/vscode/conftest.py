"""Fixtures: one VS Code with the packaged extension for all tests."""

from __future__ import annotations

import importlib.util
import shutil
from collections.abc import Iterator
from pathlib import Path

import pytest

from swarmdsl import __version__

from . import environment

ROOT = Path(__file__).resolve().parents[3]
HOST = ROOT / ".vscode-host"
NOTES = "NOTES.md"
NOTE = "```swarm\nstate Idle {\n}\n```\n\nstate Idle\n"
EXAMPLE = ROOT / "examples" / "search_and_rescue"


# Not for the session: while Playwright runs, no asyncio test can run.
@pytest.fixture(scope="module")
def whole(packages: tuple[Path, Path], tmp_path_factory: pytest.TempPathFactory) -> Iterator:
    chromium = shutil.which("chromium")
    missing = [
        name
        for name, there in {
            "VS Code": environment.ready(HOST),
            "playwright": importlib.util.find_spec("playwright"),
            "chromium": chromium,
        }.items()
        if not there
    ]
    if missing or chromium is None:
        pytest.skip(f"no {' and '.join(missing)}: `make vscode`, apt-get install chromium")
    from .window import opened

    scratch = tmp_path_factory.mktemp("vscode")
    folder = shutil.copytree(EXAMPLE, scratch / EXAMPLE.name)
    (folder / NOTES).write_text(NOTE, encoding="utf-8")
    with opened(HOST, chromium, packages[0], folder, scratch / "home") as window:
        window.open("behaviours.swarm")
        window.server(__version__)
        yield window


@pytest.fixture
def window(whole):
    """Return the window, with no open files and the example restored."""
    whole.leave()
    given = {path.name for path in EXAMPLE.iterdir()} | {NOTES}
    for path in whole.folder.glob("*.*"):
        if path.name not in given and path.is_file():
            path.unlink()  # a model that a test has made is part of the project
    for path in EXAMPLE.iterdir():
        copy = whole.folder / path.name
        # A rewritten file is read again, perhaps during an edit.
        if path.read_bytes() != copy.read_bytes():
            shutil.copy(path, copy)
    return whole
