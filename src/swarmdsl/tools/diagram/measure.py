"""How wide text is, without a font: the widths of Helvetica, which Arial and Liberation Sans share.

From Adobe's font metrics (Helvetica.afm), in thousandths of the size. A picture says how long
each text is, so that another font is fitted to that.
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
_SIGNS = "._-,(/="
_BOLD = 1.07
"""Bold letters are so much wider, on average."""
SIZES = {"name": 13, "keyword": 10, "line": 11, "label": 11}
LINE_HEIGHTS = {"name": 17, "keyword": 13, "line": 15, "label": 14}
BOLD = {"name"}


def width(text: str, style: str) -> int:
    """The width of a line of text in pixels."""
    units = sum(_WIDTHS.get(character) or _unusual(character) for character in text)
    return ceil(units * SIZES[style] / 1000 * (_BOLD if style in BOLD else 1))


def _unusual(character: str) -> int:
    if combining(character):
        return 0
    return _WIDE if east_asian_width(character) in "WF" else _OTHER


def wrapped(text: str, style: str, most: int) -> list[str]:
    """Text in lines that are not wider than `most`, broken at spaces where that is possible."""
    lines: list[str] = []
    line = ""
    for word in text.split():
        longer = f"{line} {word}" if line else word
        if width(longer, style) <= most:
            line = longer
            continue
        if line:
            lines.append(line)
        line = word
        while width(line, style) > most and len(line) > 1:
            end = len(line) - 1
            while end > 1 and width(line[:end], style) > most:
                end -= 1
            # Rather after a sign than in a name.
            end = max(
                (at for at in range(end // 2, end + 1) if line[at - 1] in _SIGNS), default=end
            )
            lines.append(line[:end])
            line = line[end:]
    return [*lines, line] if line else lines
