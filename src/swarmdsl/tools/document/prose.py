"""Render documentation as HTML that runs no scripts and fetches nothing.

The input is CommonMark (https://spec.commonmark.org) with tables, without HTML and images. Headings
become text, because the page has its own.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from urllib.parse import quote, unquote

from markdown_it import MarkdownIt
from markdown_it.token import Token
from markupsafe import Markup

_DISABLED_RULES = ["html_block", "html_inline", "image", "heading", "lheading", "hr"]


class Prose:
    """Renders documentation; a name in backquotes becomes a link to its element."""

    def __init__(self, anchors: Mapping[str, str]) -> None:
        """Create a renderer; `anchors` maps paths of elements to anchors."""
        self._anchors = anchors
        self._markdown = MarkdownIt("commonmark", {"html": False}).enable("table")
        self._markdown.disable(_DISABLED_RULES)
        self.html = cache(self._html)

    def _html(self, text: str) -> Markup:
        tokens = self._markdown.parse(text)
        for token in tokens:
            if token.children:
                token.children = list(self._with_links(token.children))
        return Markup(self._markdown.renderer.render(tokens, self._markdown.options, {}))

    def _with_links(self, tokens: list[Token]) -> list[Token]:
        """Add links for names and drop links without a valid target."""
        found: list[Token] = []
        closed: list[bool] = []
        for token in tokens:
            if token.type == "link_open":
                closed.append(not self._has_target(token))
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

    def _has_target(self, token: Token) -> bool:
        """Return True for a link to another site or to an anchor of this page.

        Links to other sites send no referrer.
        """
        to = str(token.attrGet("href") or "")
        if to.startswith("#"):
            return unquote(to[1:]) in self._anchors.values()
        token.attrSet("rel", "noreferrer")
        return to.startswith(("http://", "https://", "mailto:"))
