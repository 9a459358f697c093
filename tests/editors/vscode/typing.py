"""Users who type at human pace and choose from the lists that appear."""

from __future__ import annotations

import re
from itertools import zip_longest

from playwright.sync_api import Locator, expect

from ...server.flows import flows
from ...server.patrol import Piece, lines
from .window import Window

# Milliseconds between two keys of a good typist.
_PACE = 90
# Milliseconds to wait for a list that opens by itself.
_SOON = 10_000
# Lists that may stay closed in a busy window, out of twenty: it is typing when the answer arrives.
_MISSED = 2


def fill(window: Window) -> None:
    """Type each flow on its line of the open file, from the first line on."""
    line, missed = 1, 0
    for flow in flows():
        while line < flow.line:
            line += 1
            _move_down(window, line)
        window.press("End")
        window.page.keyboard.type(flow.typed, delay=_PACE)
        missed += not _choose(window, flow.wanted)
        expect(window.line(flow.chosen)).not_to_have_count(0)
        if flow.then:
            window.page.keyboard.insert_text(flow.then)
        window.press("Escape")
    assert missed <= _MISSED


def _move_down(window: Window, line: int) -> None:
    """Move the cursor down to a line; a list that opens late takes the key, and is closed."""
    moved = window.status("status.editor.selection").filter(has_text=f"Ln {line},")
    window.press("ArrowDown")
    if not _is_there(moved):
        window.press("Escape")
        window.press("ArrowDown")
    expect(moved).to_be_visible()


def write_patrol(window: Window) -> None:
    """Write the model of the README in an empty file, with the first items of the lists."""
    texts = lines()
    for line, following in zip_longest(texts, texts[1:]):
        if _ends_block(line):  # the editor has closed it
            window.press("ArrowDown")
            window.press("End")
        else:
            for piece in line:
                window.page.keyboard.type(piece.typed, delay=_PACE)
                if piece.completed:
                    _accept(window, piece.text)
        if following is None or not _ends_block(following):
            window.press("Enter")


def _ends_block(line: list[Piece]) -> bool:
    return line == [Piece("}")]


def _accept(window: Window, wanted: str) -> None:
    """Take the first item of the list when it is the wanted one."""
    label = window.page.locator(".label-name", has_text=re.compile(f"^{re.escape(wanted)}$"))
    rows = window.page.locator(".suggest-widget.visible .monaco-list-row")
    first = rows.and_(window.page.locator(".focused[data-index='0']"))
    right = first.filter(has=label)
    if not _is_there(right):
        window.again(lambda: window.press("Control+Space"), right)
    window.press("Tab")
    expect(rows).to_have_count(0)


def _choose(window: Window, wanted: str) -> bool:
    """Choose an item among the first three of the list; return True if it opened by itself."""
    label = re.compile(f"^{re.escape(wanted)}$")
    rows = window.page.locator(".suggest-widget.visible .monaco-list-row")
    first = rows.and_(window.page.locator("[data-index='0'], [data-index='1'], [data-index='2']"))
    row = first.filter(has=window.page.locator(".label-name", has_text=label))
    opened = _is_there(row)
    if not opened:
        window.again(lambda: window.press("Control+Space"), row)
    for _ in range(int(row.get_attribute("data-index") or 0)):
        window.press("ArrowDown")
    expect(row).to_have_class(re.compile("focused"))
    window.press("Enter")
    return opened


def _is_there(element: Locator) -> bool:
    try:
        expect(element).to_be_visible(timeout=_SOON)
    except AssertionError:
        return False
    return True
