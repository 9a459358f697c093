"""Render a page as one self-contained HTML file that runs only its own script."""

from __future__ import annotations

import re
from base64 import b64encode
from collections.abc import Mapping
from functools import cache
from hashlib import sha256
from pathlib import Path
from urllib.parse import quote

from jinja2 import Environment, FileSystemLoader, StrictUndefined, Template, pass_context
from jinja2.runtime import Context
from markupsafe import Markup, escape

from swarmdsl.base.read_files import read_text
from swarmdsl.base.xml_writer import legal
from swarmdsl.tools.diagram.svg import style
from swarmdsl.tools.document.page import Cell, Code, Figure, Inline, Page
from swarmdsl.tools.document.page import Prose as Documentation
from swarmdsl.tools.document.prose import Prose

_BREAK = re.compile(r"(?<=[a-z])([./_])(?=\w)")
_FILES = Path(__file__).resolve().parent / "files"


def html(page: Page, anchors: Mapping[str, str]) -> str:
    """HTML of a page; `anchors` maps paths of elements to anchors."""
    prose = Prose(anchors)
    script = read_text(_FILES / "page.js")
    text = _template().render(
        page=page,
        prose=prose,
        inline=_InlineRenderer(prose),
        script=Markup(script),
        script_hash=b64encode(sha256(script.encode()).digest()).decode(),
        styles=Markup(style() + read_text(_FILES / "page.css")),
    )
    return legal(text)


@cache
def _template() -> Template:
    """Return the template of pages; compiling it takes as long as filling it in."""
    environment = Environment(
        loader=FileSystemLoader(_FILES),
        autoescape=True,
        trim_blocks=True,
        lstrip_blocks=True,
        undefined=StrictUndefined,
    )
    environment.filters |= {
        "prose": _prose,
        "cell": _cell,
        "code": code,
        "href": href,
        "breakable": breakable,
    }
    environment.tests["figure"] = lambda value: isinstance(value, Figure)
    return environment.get_template("page.html.jinja")


@pass_context
def _prose(context: Context, text: str) -> Markup:
    prose: Prose = context["prose"]
    return prose.html(text)


@pass_context
def _cell(context: Context, cell: Cell) -> Markup:
    inline: _InlineRenderer = context["inline"]
    return inline.cell(cell)


class _InlineRenderer:
    """Renders inline content; without templates, because there is a lot of it."""

    def __init__(self, prose: Prose) -> None:
        self._prose = prose

    def cell(self, cell: Cell) -> Markup:
        """Concatenate strings, code and documentation."""
        return Markup("".join(map(self._one, cell)))

    def _one(self, part: Inline) -> str:
        match part:
            case Code():
                return str(code(part))
            case Documentation():
                return f'<span class="doc">{self._prose.html(part.text)}</span>'
        return str(escape(part))


def code(value: Code) -> Markup:
    """HTML of model text with its links."""
    parts = (
        f'<a href="{href(anchor)}">{breakable(text)}</a>' if anchor else breakable(text)
        for text, anchor in value.pieces
    )
    return Markup(f"<code>{''.join(parts)}</code>")


def href(anchor: str) -> str:
    """Escaped URL of an anchor on the page."""
    return f"#{quote(anchor)}"


def breakable(name: str) -> Markup:
    """Name with line-break opportunities between its words."""
    return Markup(_BREAK.sub(r"\1<wbr>", str(escape(name))))
