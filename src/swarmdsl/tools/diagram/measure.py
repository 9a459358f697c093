"""Measure text by the widths of Helvetica, Arial and Liberation Sans.

The widths are from Adobe's font metrics (Helvetica.afm), in thousandths of the font size. The SVG
states the length of each text, so that other fonts are stretched to fit.
"""

from __future__ import annotations

import re
from math import ceil
from unicodedata import combining, east_asian_width

_WIDTHS = dict(
    zip(
        map(chr, range(32, 127)),
        (
            *(278, 278, 355, 556, 556, 889, 667, 191, 333, 333, 389, 584, 278, 333, 278, 278),
            *(556, 556, 556, 556, 556, 556, 556, 556, 556, 556, 278, 278, 584, 584, 584, 556),
            *(1015, 667, 667, 722, 722, 667, 611, 778, 722, 278, 500, 667, 556, 833, 722, 778),
            *(667, 778, 722, 667, 611, 722, 667, 944, 667, 667, 611, 278, 278, 278, 469, 556),
            *(333, 556, 556, 500, 556, 556, 278, 556, 556, 222, 222, 500, 222, 833, 556, 556),
            *(556, 556, 333, 500, 278, 556, 500, 722, 500, 500, 500, 334, 260, 334, 584),
        ),
        strict=True,
    )
)
_OTHER, _WIDE = 600, 1000
_BREAK_AFTER = ".-,(/="
_ATOMS = re.compile(r"[A-Za-z0-9_]+|.", re.DOTALL)
"""Parts of a text between which a line may break."""
_BOLD = 1.07
"""Average width of bold relative to regular text."""
SIZES = {"name": 13, "keyword": 10, "line": 11, "label": 11}
LINE_HEIGHTS = {"name": 17, "keyword": 13, "line": 15, "label": 14}
BOLD = {"name"}


def width(text: str, style: str) -> int:
    """Width of a line of text in pixels."""
    units = sum(_WIDTHS.get(character) or _fallback_width(character) for character in text)
    return ceil(units * SIZES[style] / 1000 * (_BOLD if style in BOLD else 1))


def _fallback_width(character: str) -> int:
    if combining(character):
        return 0
    return _WIDE if east_asian_width(character) in "WF" else _OTHER


def wrap(text: str, style: str, limit: int) -> list[str]:
    """Wrap text into lines of at most `limit` pixels, at spaces if possible.

    A line breaks before or after an operator rather than at any character, and never inside an
    identifier or a number: one that is wider has a line of its own.
    """
    lines: list[str] = []
    line = ""
    for word in text.split():
        longer = f"{line} {word}" if line else word
        if width(longer, style) <= limit:
            line = longer
            continue
        if line:
            lines.append(line)
        *full, line = _broken(word, style, limit)
        lines += full
    return [*lines, line] if line else lines


def _broken(word: str, style: str, limit: int) -> list[str]:
    """Break a word without spaces."""
    if width(word, style) <= limit:
        return [word]
    lines = [""]
    for atom in _ATOMS.findall(word):
        if lines[-1] and width(lines[-1] + atom, style) > limit:
            at = max(lines[-1].rfind(mark) for mark in _BREAK_AFTER) + 1
            # Prefer a break after punctuation in the second half of the line.
            if 2 * at > len(lines[-1]) > at:
                lines[-1:] = [lines[-1][:at], lines[-1][at:]]
                if width(lines[-1] + atom, style) <= limit:
                    lines[-1] += atom
                    continue
            lines.append("")
        lines[-1] += atom
    return lines
