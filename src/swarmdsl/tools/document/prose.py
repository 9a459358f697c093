"""Documentation as HTML: Markdown, of which nothing can run, and nothing is fetched.

CommonMark (https://spec.commonmark.org) with tables, without HTML and pictures. Headings are
text: those of a page are its own.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from urllib.parse import quote, unquote

from markdown_it import MarkdownIt
from markdown_it.token import Token
from markupsafe import Markup

_LEFT_OUT = ["html_block", "html_inline", "image", "heading", "lheading", "hr"]


class Prose:
    """Makes HTML of documentation; a name in backquotes leads to what is called so."""

    def __init__(self, anchors: Mapping[str, str]) -> None:
        """`anchors` are those of elements, by their paths."""
        self._anchors = anchors
        self._markdown = MarkdownIt("commonmark", {"html": False}).enable("table")
        self._markdown.disable(_LEFT_OUT)
        self.html = cache(self._html)

    def _html(self, text: str) -> Markup:
        tokens = self._markdown.parse(text)
        for token in tokens:
            if token.children:
                token.children = list(self._linked(token.children))
        return Markup(self._markdown.renderer.render(tokens, self._markdown.options, {}))

    def _linked(self, tokens: list[Token]) -> list[Token]:
        """The tokens of a line, with links that lead somewhere."""
        found: list[Token] = []
        closed: list[bool] = []
        for token in tokens:
            if token.type == "link_open":
                closed.append(not self._leads(token))
                if closed[-1]:
                    continue
            elif token.type == "link_close" and closed.pop():
                continue
            anchor = self._anchors.get(token.content) if token.type == "code_inline" else None
            if anchor is None or closed:
                found.append(token)
            else:
                opened = Token("link_open", "a", 1, attrs={"href": f"#{quote(anchor)}"})
                found += [opened, token, Token("link_close", "a", -1)]
        return found

    def _leads(self, token: Token) -> bool:
        """Whether a link leads to a page elsewhere, which is told nothing, or into this one."""
        to = str(token.attrGet("href") or "")
        if to.startswith("#"):
            return unquote(to[1:]) in self._anchors.values()
        token.attrSet("rel", "noreferrer")
        return to.startswith(("http://", "https://", "mailto:"))
