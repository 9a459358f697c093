"""Pages about models."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from pathlib import Path
from urllib.parse import unquote

import pytest
from lxml import html

from swarmdsl.driver import pipeline
from swarmdsl.ir import System
from swarmdsl.tools.document import document

ROOT = Path(__file__).resolve().parents[2]
SAR = ROOT / "examples" / "search_and_rescue"
MODELS = [
    *sorted(path for path in (ROOT / "examples").iterdir() if path.is_dir()),
    *(ROOT / "tests" / "golden" / name for name in ("everything", "language", "operations")),
    ROOT / "tests" / "diagram" / "rover.swarm",
]


@dataclass(frozen=True)
class Page:
    """A page as a browser reads it, and the model that it is about."""

    text: str
    tree: html.HtmlElement
    system: System

    def at(self, anchor: str) -> html.HtmlElement:
        """The element with an anchor."""
        (found,) = (each for each in self.tree.iter() if each.get("id") == anchor)
        return found

    def told(self, anchor: str) -> str:
        """The text of an element, spaces as a browser shows them."""
        return " ".join(self.at(anchor).text_content().split())

    def fact(self, anchor: str, term: str) -> str:
        """Return the description of a term in an entry."""
        terms = [each for each in self.at(anchor).findall("dl/div") if each[0].text == term]
        return " ".join(terms[0][1].text_content().split()) if terms else ""

    def table(self, anchor: str, title: str) -> list[list[str]]:
        """The rows of a table in an entry or a section, the head first."""
        (found,) = (
            each
            for each in self.at(anchor).iterfind("div/table")
            if each.findtext("caption") == title
        )
        return [[" ".join(cell.text_content().split()) for cell in row] for row in found.iter("tr")]

    def links(self) -> list[str]:
        """The anchors that links lead to."""
        found = [str(link) for _, name, link, _ in self.tree.iterlinks() if name == "href"]
        return [unquote(link[1:]) for link in found if link.startswith("#")]


def read(text: str, system: System) -> Page:
    return Page(text, html.document_fromstring(text), system)


@cache
def page_of(path: Path, libraries: bool = False) -> Page:
    result = pipeline.check([path])
    assert result.valid is not None, [found.message for found in result.report]
    assert result.system is not None
    return read(document(result.valid, libraries=libraries)[1], result.system)


@pytest.fixture(params=MODELS, ids=lambda path: path.stem)
def page(request: pytest.FixtureRequest) -> Page:
    """The page about a model, one model after the other."""
    return page_of(request.param)


@pytest.fixture(scope="session")
def sar() -> Page:
    return page_of(SAR)
