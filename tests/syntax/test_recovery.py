"""Diagnostics of broken text in one table: `recovery.txt`."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from swarmdsl.driver import pipeline

TABLE = Path(__file__).parent / "recovery.txt"
INTRODUCTION, *BLOCKS = re.split(r"^== ", TABLE.read_text(encoding="utf-8"), flags=re.MULTILINE)
TEXTS = {
    block.partition("\n")[0]: re.sub(r"^>.*\n", "", block.partition("\n")[2], flags=re.MULTILINE)
    for block in BLOCKS
}


def said(text: str, folder: Path) -> list[str]:
    """One line a diagnostic: place, code, message and help."""
    path = folder / "model.swarm"
    path.write_text(text.rstrip() + "\n", encoding="utf-8")
    lines = []
    for found in pipeline.check([path]).report:
        assert found.primary is not None
        line, column = found.primary.span.source.line_column(found.primary.span.start)
        advice = f" ({found.help})" if found.help else ""
        lines.append(f"> {line}:{column} {found.code} {found.message}{advice}")
    return lines


@pytest.fixture
def table(tmp_path: Path) -> str:
    blocks = [
        f"== {title}\n{text.rstrip()}\n" + "".join(f"{line}\n" for line in said(text, tmp_path))
        for title, text in TEXTS.items()
    ]
    # The path of the folder is the only thing in it that is not the same everywhere.
    return INTRODUCTION + "\n".join(blocks).replace(f"{tmp_path}/", "")


def test_recovery(table: str, bless: bool) -> None:
    if bless:
        TABLE.write_text(table, encoding="utf-8")

    assert table == TABLE.read_text(encoding="utf-8")


@pytest.mark.parametrize("title", TEXTS)
def test_every_text_is_wrong(title: str, tmp_path: Path) -> None:
    assert said(TEXTS[title], tmp_path)
