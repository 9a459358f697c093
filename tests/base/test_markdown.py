"""Text of models in Markdown documents, as a reader of Markdown sees it."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from markdown_it import MarkdownIt
from markdown_it.token import Token

from swarmdsl.base.markdown import cell, code_cell, prose

BAD = (
    "[x](javascript:alert(1)) ![x](http://x/y.png) [x]: http://x [y][x]",
    "<b>x</b> <!-- x --> <script>alert(1)</script> <http://x.org> <a@x.org>",
    "# head",
    "- # head",
    "head\n====",
    "head\n---",
    "- head\n  ---",
    "> head\n> ---",
    "a | b\n--|--\nc | d",
    "| `x` |\n|:-:|",
    "a|\n:-",
    "```",
    "``` <b>",
    "```\n<b>\n``` x",
    "~~~ x",
    "`a\n<b>`",
    "    `a\n<b>x</b> `",
    "\\`<b>`",
    "\\\\[x](y)",
    "\\",
    "`a` ``<b>` <b>",
    "a\u2028# b",
)


def flat(tokens: list[Token]) -> Iterator[Token]:
    for token in tokens:
        yield token
        yield from flat(token.children or [])


def types(text: str) -> set[str]:
    return {token.type for token in flat(MarkdownIt("gfm-like", {"linkify": False}).parse(text))}


WANTED = {"paragraph_open", "paragraph_close", "inline", "text", "softbreak", "code_inline"}
LISTS = {"bullet_list_open", "bullet_list_close", "list_item_open", "list_item_close"}


@pytest.mark.parametrize("text", BAD)
def test_documentation_stays_text(text: str) -> None:
    after = "\n\n# After"
    found = MarkdownIt("gfm-like", {"linkify": False}).parse(prose(text) + after)
    assert [token.content for token in flat(found)][-2] == "After"
    assert types(prose(text)) <= WANTED | LISTS | {"code_block"}


@pytest.mark.parametrize("text", [*BAD, "a|b `c|d` \\| `e\\|f`"])
def test_cells_stay_cells(text: str) -> None:
    for write in (cell, code_cell):
        table = f"| one | two |\n|---|---|\n| {write(text)} | x |\n"
        tokens = MarkdownIt("gfm-like", {"linkify": False}).parse(table)
        cells = [token for token in flat(tokens) if token.type == "td_open"]
        assert len(cells) == 2
        assert {token.type for token in flat(tokens)} <= WANTED | {
            f"{name}_{end}"
            for name in ("table", "thead", "tbody", "tr", "th", "td")
            for end in ("open", "close")
        }
        if write is code_cell:
            codes = [token.content for token in flat(tokens) if token.type == "code_inline"]
            assert codes == [" ".join(text.split())]


def test_documentation_keeps_lists_emphasis_and_code() -> None:
    text = "Search *here*.\n\n- `a | <b>`\n- see \\*"
    assert prose(text) == text
    assert cell("see `a`, *b*") == "see `a`, *b*"


def test_urls_are_not_links_of_github() -> None:
    assert prose("https://x.org www.x.org $x$") == r"https\://x.org www\.x.org \$x\$"
