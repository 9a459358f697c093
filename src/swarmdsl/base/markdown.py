"""Text of a model in Markdown documents (CommonMark, and tables of GitHub).

Documentation is Markdown: lists, emphasis and code stay. Nothing in it becomes a link, an image,
HTML, a heading, a fence or a part of a table, because it is only a piece of a document.
"""

from __future__ import annotations

import re

_TOKEN = re.compile(
    r"(?P<escape>\\[!-/:-@\[-`{-~])"
    r"|(?<!`)(?P<code>(?P<ticks>`{1,2})(?!`).+?(?<!`)(?P=ticks)(?!`))"
    r"|(?P<markup>[\\`\[\]<|~#$]|:(?=//)|(?<=\bwww)\.)"
)
# A line that makes a heading or table of the line above, or a quotation.
_LINE = re.compile(r"^(\s*)(?=:?-+:?\s*$|=+\s*$|>)")
_TICKS = re.compile("`+")


def prose(text: str) -> str:
    """Return documentation as paragraphs or lists of a document."""
    # Each line alone: code that goes on in the next line could end with a paragraph.
    return "\n".join(_LINE.sub(r"\1\\", _escaped(line)) for line in re.split("\r\n?|\n", text))


def cell(text: str) -> str:
    """Return documentation as a cell of a table."""
    return _TOKEN.sub(_in_cell, " ".join(text.split()))


def code_cell(text: str) -> str:
    """Return any text as code in a cell of a table."""
    flat = " ".join(text.split())
    if not flat:
        return ""
    ticks = "`" * (max(map(len, _TICKS.findall(flat)), default=0) + 1)
    pad = " " if "`" in (flat[0], flat[-1]) else ""
    return f"{ticks}{pad}{_without_bars(flat)}{pad}{ticks}"


def _escaped(line: str) -> str:
    return _TOKEN.sub(lambda found: f"\\{found[0]}" if found["markup"] else found[0], line)


def _in_cell(found: re.Match[str]) -> str:
    if found["markup"]:
        return f"\\{found[0]}"
    return _without_bars(found[0]) if found["code"] else found[0]


def _without_bars(code: str) -> str:
    """Escape the ends of cells, which are found before code is."""
    return code.replace("|", "\\|")
