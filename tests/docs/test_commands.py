"""Every command in the documentation runs and prints what is shown."""

from __future__ import annotations

import re
import shutil
from pathlib import Path

import pytest

from .pages import ROOT, Page, blocks
from .walk import Walk, commands, matches

# The tutorial is walked by a test of its own.
SESSIONS = [
    page
    for page in dict.fromkeys(block.page for block in blocks("console", "sh"))
    if str(page) != "docs/tutorial.md"
]


@pytest.mark.parametrize("page", SESSIONS, ids=str)
def test_commands(page: Page, tmp_path: Path) -> None:
    """Follow a page from top to bottom in a folder that has the examples."""
    shutil.copytree(ROOT / "examples", tmp_path / "examples")
    walk = Walk(tmp_path)
    blocks = [block for block in page.blocks if "needs" not in block.attributes]
    assert blocks
    for block in blocks:
        walk.follow(block)


def test_the_readme_after_the_demo(tmp_path: Path) -> None:
    """Files of `make demo` are not in the way of the commands of the README."""
    shutil.copytree(ROOT / "examples", tmp_path / "examples")
    walk = Walk(tmp_path)
    made = (ROOT / "Makefile").read_text(encoding="utf-8").replace("\\\n", " ")
    (recipe,) = re.findall(r"^demo:.*\n((?:\t.*\n)+)", made, re.MULTILINE)
    demo = [line.strip() for line in recipe.splitlines() if not line.strip().startswith("@")]
    assert any("swarmc build" in line for line in demo)
    for line in demo:
        printed, code = walk.run(line.replace("$(BIN)/", ""))
        assert code == 0, printed
    before = {path: path.read_bytes() for path in tmp_path.rglob("*") if path.is_file()}

    for block in Page(ROOT / "README.md").blocks:
        walk.follow(block)
    assert {path: path.read_bytes() for path in before if path.is_file()} == before


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
