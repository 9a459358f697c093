"""The project's Markdown, read as the tests need it: blocks, links, headings.

A block of code can say more after its language:

    swarm                      a whole file, without errors and warnings
    swarm file=robot.swarm     the same, kept under this name for later blocks of the page
    swarm with=robot.swarm     a file that begins with an import of that one
    swarm reports=SW0505       a file about which the compiler says this, and nothing else
    swarm except=smach,scxml   a file that these targets cannot express, and all others can

Any block can be written, on the way through a page, or can be for another place:

    toml file=swarm.toml       a file that the reader writes; `file=+swarm.toml` adds to its end
    diff file=robot.swarm      a change that the reader makes in a file: lines with ` `, `-`, `+`
    sh needs=ros2              for who has ROS 2, too: not run everywhere
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from markdown_it import MarkdownIt
from markdown_it.token import Token

ROOT = Path(__file__).resolve().parents[2]


@dataclass(frozen=True)
class Block:
    """A fenced block; `line` is that of its first fence."""

    page: Page
    line: int
    language: str
    attributes: dict[str, str]
    text: str

    def __str__(self) -> str:
        return f"{self.page}:{self.line}"


@dataclass(frozen=True)
class Page:
    """A file of Markdown."""

    path: Path

    def __str__(self) -> str:
        return self.path.relative_to(ROOT).as_posix()

    @cached_property
    def text(self) -> str:
        return self.path.read_text(encoding="utf-8")

    @cached_property
    def tokens(self) -> list[Token]:
        return MarkdownIt("commonmark").enable("table").parse(self.text)

    @cached_property
    def blocks(self) -> list[Block]:
        return [self._block(token) for token in self.tokens if token.type == "fence" and token.info]

    def _block(self, token: Token) -> Block:
        language, *words = token.info.split()
        attributes = dict(word.split("=", 1) for word in words)
        assert token.map is not None
        return Block(self, token.map[0] + 1, language, attributes, token.content)

    def inline(self) -> Iterator[Token]:
        """Everything inside paragraphs, headings and tables."""
        for token in self.tokens:
            yield from token.children or ()

    @cached_property
    def code(self) -> list[str]:
        """The text of each piece of code, in a line or in a block."""
        inside = [token.content for token in self.inline() if token.type == "code_inline"]
        return inside + [token.content for token in self.tokens if token.type == "fence"]

    @cached_property
    def links(self) -> list[str]:
        """Return the targets of links and images."""
        found = [
            token.attrGet("href") if token.type == "link_open" else token.attrGet("src")
            for token in self.inline()
            if token.type in ("link_open", "image")
        ]
        return [str(link) for link in found]

    @cached_property
    def anchors(self) -> set[str]:
        """The anchors of the headings, as GitHub makes them."""
        anchors: dict[str, int] = {}
        for heading, content in zip(self.tokens, self.tokens[1:], strict=False):
            if heading.type == "heading_open":
                text = "".join(inner.content for inner in content.children or ())
                anchor = re.sub(r"[^\w\- ]", "", text.lower()).replace(" ", "-")
                anchors[anchor] = anchors.get(anchor, -1) + 1
        return {
            f"{anchor}-{number}" if number else anchor
            for anchor, last in anchors.items()
            for number in range(last + 1)
        }


def _pages() -> list[Page]:
    paths = [ROOT / name for name in ("README.md", "CONTRIBUTING.md", "CHANGELOG.md")]
    for folder in ("docs", "examples", "generators"):
        paths += sorted((ROOT / folder).rglob("*.md"))
    return [Page(path) for path in paths]


PAGES = _pages()
LANGUAGE = Page(ROOT / "docs" / "language.md")


def blocks(*languages: str) -> list[Block]:
    """The blocks of all pages in these languages."""
    return [block for page in PAGES for block in page.blocks if block.language in languages]
