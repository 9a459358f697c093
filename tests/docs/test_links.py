"""Links lead somewhere."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from urllib.parse import unquote

import pytest

from .pages import PAGES, Page


@cache
def anchors(path: Path) -> set[str]:
    return Page(path).anchors


@pytest.mark.parametrize("page", PAGES, ids=str)
def test_links(page: Page) -> None:
    broken = []
    for link in page.links:
        if "://" in link:
            continue
        path, _, anchor = unquote(link).partition("#")
        target = (page.path.parent / path).resolve() if path else page.path
        if not target.exists():
            broken.append(f"{link}: no such file")
        elif anchor and anchor not in anchors(target):
            broken.append(f"{link}: no such heading")

    assert broken == []
