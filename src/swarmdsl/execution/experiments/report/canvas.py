"""SVG shapes for a page with the style sheet of reports."""

from __future__ import annotations

import math
from collections.abc import Iterable
from xml.sax.saxutils import escape, quoteattr

from swarmdsl.base.xml_writer import legal


class Canvas:
    """Shapes in drawing order; escapes strings."""

    def __init__(self, width: float, height: float, label: str) -> None:
        size = f'width="{_n(width)}" height="{_n(height)}" viewBox="0 0 {_n(width)} {_n(height)}"'
        head = f'<svg xmlns="http://www.w3.org/2000/svg" role="img" {size}>'
        self._parts = [f"{head}<title>{_escaped(label)}</title>"]

    def text(self, x: float, y: float, text: str, style: str = "") -> None:
        """Draw a line of text."""
        self._parts.append(f'<text class="{style}" x="{_n(x)}" y="{_n(y)}">{_escaped(text)}</text>')

    def line(self, x: float, y: float, to_x: float, to_y: float, style: str) -> None:
        """Draw a straight line."""
        ends = f'x1="{_n(x)}" y1="{_n(y)}" x2="{_n(to_x)}" y2="{_n(to_y)}"'
        self._parts.append(f'<line class="{style}" {ends}/>')

    def dot(self, x: float, y: float, style: str, title: str, radius: float = 3.0) -> None:
        """Draw a dot with a tooltip."""
        self._titled(f'circle class="{style}" cx="{_n(x)}" cy="{_n(y)}" r="{_n(radius)}"', title)

    def bar(self, x: float, y: float, width: float, height: float, style: str, title: str) -> None:
        """Draw a rectangle with a tooltip."""
        box = f'x="{_n(x)}" y="{_n(y)}" width="{_n(width)}" height="{_n(height)}"'
        self._titled(f'rect class="{style}" {box}', title)

    def path(
        self,
        points: Iterable[tuple[float, float]],
        style: str,
        title: str = "",
        opacity: float = 1.0,
    ) -> None:
        """Draw lines from point to point, with a tooltip."""
        way = " ".join(f"{_n(x)},{_n(y)}" for x, y in points)
        faint = f' stroke-opacity="{_n(opacity)}"' if opacity < 1 else ""
        self._titled(f'polyline class={quoteattr(style)} points="{way}"{faint}', title)

    def _titled(self, shape: str, title: str) -> None:
        name = shape.partition(" ")[0]
        inner = f"><title>{_escaped(title)}</title></{name}>" if title else "/>"
        self._parts.append(f"<{shape}{inner}")

    def finish(self) -> str:
        """Return the SVG element."""
        return "\n".join([*self._parts, "</svg>"])


def ticks(low: float, high: float, most: int = 6) -> list[float]:
    """Return round numbers from `low` to `high`: multiples of 1, 2 or 5 times a power of ten."""
    if not high > low:
        return [low]
    rough = (high - low) / most
    power = 10.0 ** math.floor(math.log10(rough))
    step = next(each * power for each in (1, 2, 5, 10) if each * power >= rough * (1 - 1e-9))
    first, last = math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9)
    return [number * step for number in range(first, last + 1)]


def short(number: float) -> str:
    """Format a number in a few characters."""
    return f"{number:.4g}"


def _escaped(text: str) -> str:
    return escape(legal(text))


def _n(number: float) -> str:
    """Format a number with at most two decimals."""
    return f"{number:.2f}".rstrip("0").rstrip(".")
