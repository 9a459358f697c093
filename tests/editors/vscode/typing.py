"""Flows of a user who types at human pace and chooses from the lists that appear."""

from __future__ import annotations

import re

from playwright.sync_api import expect

from ...server.flows import flows
from .window import Window

# Milliseconds between two keys of a good typist.
_PACE = 90


def fill(window: Window) -> None:
    """Type each flow on its line of the open file, from the first line on."""
    line = 1
    for flow in flows():
        for _ in range(flow.line - line):
            window.press("ArrowDown")
        line = flow.line
        window.press("End")
        window.page.keyboard.type(flow.typed, delay=_PACE)
        _choose(window, flow.wanted)
        expect(window.line(flow.chosen)).not_to_have_count(0)
        if flow.then:
            window.page.keyboard.insert_text(flow.then)
        window.press("Escape")


def _choose(window: Window, wanted: str) -> None:
    """Choose an item among the first three of the list."""
    label = re.compile(f"^{re.escape(wanted)}$")
    rows = window.page.locator(".suggest-widget.visible .monaco-list-row")
    first = rows.and_(window.page.locator("[data-index='0'], [data-index='1'], [data-index='2']"))
    row = first.filter(has=window.page.locator(".label-name", has_text=label))
    expect(row).to_have_count(1)
    for _ in range(int(row.get_attribute("data-index") or 0)):
        window.press("ArrowDown")
    expect(row).to_have_class(re.compile("focused"))
    window.press("Enter")
