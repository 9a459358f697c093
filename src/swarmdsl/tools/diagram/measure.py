"""Measure text by the widths of Helvetica, Arial and Liberation Sans.

The widths are from Adobe's font metrics (Helvetica.afm), in thousandths of the font size. The SVG
states the length of each text, so that other fonts are stretched to fit.
"""

from __future__ import annotations

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
_BREAK_AFTER = "._-,(/="
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
    """Wrap text into lines of at most `most` pixels, at spaces if possible."""
    lines: list[str] = []
    line = ""
    for word in text.split():
        longer = f"{line} {word}" if line else word
        if width(longer, style) <= limit:
            line = longer
            continue
        if line:
            lines.append(line)
        line = word
        while width(line, style) > limit and len(line) > 1:
            end = len(line) - 1
            while end > 1 and width(line[:end], style) > limit:
                end -= 1
            # Prefer a break after punctuation to one inside a name.
            end = max(
                (at for at in range(end // 2, end + 1) if line[at - 1] in _BREAK_AFTER), default=end
            )
            lines.append(line[:end])
            line = line[end:]
    return [*lines, line] if line else lines
