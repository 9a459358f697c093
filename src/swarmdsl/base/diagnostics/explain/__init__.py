"""The pages that explain each diagnostic, found by code or by name."""

from __future__ import annotations

from pathlib import Path

from swarmdsl.base.diagnostics.catalog import CODES
from swarmdsl.base.read_files import read_text

_PAGES = Path(__file__).resolve().parent


def page_path(code: str) -> Path:
    """Path of the page of a code."""
    return _PAGES / f"{code}.md"


def find_code(word: str) -> str | None:
    """Return the code meant by `SW0202`, `202` or `unresolved-name`; None for none."""
    if word.lower() in CODES:
        return CODES[word.lower()].code
    code = f"SW{word:0>4}" if word.isdecimal() else word.upper()
    return next((entry.code for entry in CODES.values() if entry.code == code), None)


def page(code: str) -> str:
    """Return the page of a code, in Markdown."""
    return read_text(page_path(code))
