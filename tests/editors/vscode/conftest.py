"""One Visual Studio Code for all tests, with the extension as its users get it."""

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
NOTE = "```swarm\nstate Idle {\n}\n```\n\nstate Idle\n"
EXAMPLE = ROOT / "examples" / "search_and_rescue"


# Not for longer: while a browser is driven, no test with asyncio runs.
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
    (folder / "NOTES.md").write_text(NOTE, encoding="utf-8")
    with opened(HOST, chromium, packages[0], folder, scratch / "home") as window:
        window.open("behaviours.swarm")
        window.server(__version__)
        yield window


@pytest.fixture
def window(whole):
    """The window, with nothing open and the files as in the example."""
    whole.leave()
    for path in EXAMPLE.iterdir():
        copy = whole.folder / path.name
        # A file that is written again is read again, perhaps while it is edited.
        if path.read_bytes() != copy.read_bytes():
            shutil.copy(path, copy)
    return whole
