"""A page as HTML: one file that needs nothing from elsewhere, and runs only its own script."""

from __future__ import annotations

import re
from base64 import b64encode
from collections.abc import Mapping
from hashlib import sha256
from pathlib import Path
from urllib.parse import quote

from jinja2 import Environment, FileSystemLoader, StrictUndefined
from markupsafe import Markup

from swarmdsl.diagram.svg import style
from swarmdsl.document.page import Code, Figure, Page
from swarmdsl.document.prose import Prose
from swarmdsl.exchange.xml import legal

_FILES = Path(__file__).resolve().parent / "files"


def html(page: Page, anchors: Mapping[str, str]) -> str:
    """The text of the page; `anchors` are those of elements, by their paths."""
    prose = Prose(anchors)
    environment = Environment(
        loader=FileSystemLoader(_FILES),
        autoescape=True,
        trim_blocks=True,
        lstrip_blocks=True,
        undefined=StrictUndefined,
    )
    environment.filters |= {
        "prose": prose.html,
        "code": _code,
        "href": _href,
        "breakable": _breakable,
    }
    environment.tests |= {
        "code": lambda value: isinstance(value, Code),
        "figure": lambda value: isinstance(value, Figure),
    }
    script = (_FILES / "page.js").read_text(encoding="utf-8")
    text = environment.get_template("page.html.jinja").render(
        page=page,
        script=Markup(script),
        script_hash=b64encode(sha256(script.encode()).digest()).decode(),
        styles=Markup(style() + (_FILES / "page.css").read_text(encoding="utf-8")),
    )
    return legal(text)


def _href(anchor: str) -> str:
    return f"#{quote(anchor)}"


def _breakable(name: str) -> Markup:
    """A name that may go on in the next line where a word of it ends."""
    return Markup(re.sub(r"(?<=[a-z0-9])([./_])(?=\w)", r"\1<wbr>", str(Markup.escape(name))))


def _code(code: Code) -> Markup:
    """Text of the model, with its links."""
    parts = [
        Markup('<a href="{}">{}</a>').format(_href(anchor), text) if anchor else Markup.escape(text)
        for text, anchor in code.pieces
    ]
    return Markup("<code>{}</code>").format(Markup("").join(parts))
