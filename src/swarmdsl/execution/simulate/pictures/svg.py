"""SVG shapes of a timeline."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from xml.sax.saxutils import escape, quoteattr

from swarmdsl.base.xml_writer import legal

LETTER = 6.2
"""Average width of a letter."""
_STYLE = """
text { font: 11px "DejaVu Sans", Verdana, "Helvetica Neue", Arial, sans-serif; fill: #1f2430 }
.title { font-size: 17px; font-weight: bold }
.note, .time { fill: #667085 }
.time { text-anchor: middle; font-size: 10px }
.member { text-anchor: end; font-weight: bold }
.machine { font-weight: bold }
.state { font-size: 10px; pointer-events: none }
.paper { fill: #ffffff }
.lane { fill: #f1f3f6 }
.tick { stroke: #d5d9e0; stroke-width: 1 }
.bar { stroke: #ffffff; stroke-width: 0.6 }
.arrow, .ignored { stroke: #20304d; stroke-opacity: 0.6; marker-end: url(#head) }
.ignored { stroke-dasharray: 1 2; marker-end: url(#ring) }
.dropped { stroke: #c0362c; stroke-opacity: 0.8; stroke-dasharray: 3 2; marker-end: url(#cross) }
.spine { stroke: #20304d; stroke-opacity: 0.45 }
.spine.lost { stroke: #c0362c; stroke-dasharray: 3 2 }
.head { fill: #20304d }
.ring { fill: #ffffff; stroke: #20304d; stroke-width: 1 }
.cross { stroke: #c0362c; stroke-width: 1.6; fill: none }
@media (prefers-color-scheme: dark) {
text { fill: #e3e8ee }
.state { fill: #1f2430 }
.note, .time { fill: #9aa5b4 }
.paper { fill: #16191d }
.lane { fill: #242a32 }
.tick { stroke: #3a424d }
.bar { stroke: #16191d }
.arrow, .ignored, .spine { stroke: #ffffff; stroke-opacity: 0.75 }
.head { fill: #ffffff }
.ring { fill: #16191d; stroke: #ffffff }
.dropped, .spine.lost, .cross { stroke: #ff8a7a; stroke-opacity: 1 }
}
"""
_DEFINITIONS = """<defs>
<marker id="head" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="6" markerHeight="6"
 orient="auto" markerUnits="userSpaceOnUse">
<path class="head" d="M0,0.5 L8,4 L0,7.5 z"/></marker>
<marker id="cross" viewBox="0 0 8 8" refX="4" refY="4" markerWidth="7" markerHeight="7"
 markerUnits="userSpaceOnUse">
<path class="cross" d="M1,1 L7,7 M7,1 L1,7"/></marker>
<marker id="ring" viewBox="0 0 8 8" refX="4" refY="4" markerWidth="6" markerHeight="6"
 markerUnits="userSpaceOnUse">
<circle class="ring" cx="4" cy="4" r="2.8"/></marker>
<pattern id="lost" width="6" height="6" patternUnits="userSpaceOnUse" patternTransform="rotate(45)">
<rect width="6" height="6" fill="#d9dce2"/>
<rect width="2" height="6" fill="#c0362c" opacity="0.45"/>
</pattern>
</defs>"""


class Drawing:
    """Shapes in drawing order; escapes strings."""

    def __init__(self, width: float, title: str, description: str = "") -> None:
        self._width = width
        names = f"<title>{_text(title)}</title>"
        if description:
            names += f"<desc>{_text(description)}</desc>"
        self._parts = [
            names,
            f"<style>{_STYLE}</style>",
            _DEFINITIONS,
            '<rect class="paper" width="100%" height="100%"/>',
        ]

    def text(self, x: float, y: float, text: str, style: str) -> None:
        """Draw a line of text."""
        self._parts.append(f'<text class="{style}" x="{_n(x)}" y="{_n(y)}">{_text(text)}</text>')

    def line(self, x: float, y: float, to_x: float, to_y: float, style: str) -> None:
        """Draw a straight line."""
        self._parts.append(f'<line class="{style}" {_ends(x, y, to_x, to_y)}/>')

    def rect(self, x: float, y: float, width: float, height: float, style: str) -> None:
        """Draw a rectangle."""
        self._parts.append(f'<rect class="{style}" {_box(x, y, width, height)}/>')

    def bar(self, x: float, y: float, width: float, height: float, colour: str, title: str) -> None:
        """Draw a rectangle with a tooltip."""
        self._parts.append(
            f'<rect class="bar" {_box(x, y, width, height)} rx="2" fill={quoteattr(colour)}>'
            f"<title>{_text(title)}</title></rect>"
        )

    def arrow(
        self, x: float, y: float, to_x: float, to_y: float, style: str, width: float, title: str
    ) -> None:
        """Draw an arrow with a tooltip; the style is `arrow`, `ignored` or `dropped`."""
        self._parts.append(
            f'<line class="{style}" {_ends(x, y, to_x, to_y)} stroke-width="{_n(width)}">'
            f"<title>{_text(title)}</title></line>"
        )

    def comb(
        self,
        spines: Iterable[tuple[float, float, float]],
        marks: Iterable[tuple[float, float, bool, str]],
        style: str,
        width: float,
        title: str,
    ) -> None:
        """Draw upright lines with marks along them, and one tooltip.

        A spine has its x and its ends. A mark has its place, True if it points down, and the style
        of an arrow.
        """
        lines = "".join(f"M{_n(x)},{_n(y)} V{_n(to)} " for x, y, to in spines).rstrip()
        self._parts.append(
            f'<g class="comb"><title>{_text(title)}</title>'
            f'<path class="{style}" stroke-width="{_n(width)}" d="{lines}"/>'
        )
        for x, y, down, kind in marks:
            shape, draw = _MARKS[kind]
            self._parts.append(f'<path class="{shape}" d="{draw(x, y, 1 if down else -1)}"/>')
        self._parts.append("</g>")

    def finish(self, height: float) -> str:
        """Return the SVG file, with its height."""
        width, height_ = _n(self._width), _n(height)
        size = f'width="{width}" height="{height_}" viewBox="0 0 {width} {height_}"'
        head = f'<svg xmlns="http://www.w3.org/2000/svg" role="img" {size}>'
        return "\n".join([head, *self._parts, "</svg>", ""])


def _text(text: str) -> str:
    return escape(legal(text))


def _ends(x: float, y: float, to_x: float, to_y: float) -> str:
    return f'x1="{_n(x)}" y1="{_n(y)}" x2="{_n(to_x)}" y2="{_n(to_y)}"'


def _box(x: float, y: float, width: float, height: float) -> str:
    return f'x="{_n(x)}" y="{_n(y)}" width="{_n(width)}" height="{_n(height)}"'


def _n(number: float) -> str:
    """Format a number with at most two decimals."""
    return f"{number:.2f}".rstrip("0").rstrip(".")


def _head(x: float, y: float, way: int) -> str:
    return f"M{_n(x - 3)},{_n(y - 5 * way)} h6 L{_n(x)},{_n(y)} z"


def _ring(x: float, y: float, way: int) -> str:
    return f"M{_n(x - 2.2)},{_n(y - 2.4 * way)} a2.2,2.2 0 1 0 4.4,0 a2.2,2.2 0 1 0 -4.4,0 z"


def _cross(x: float, y: float, way: int) -> str:
    return f"M{_n(x - 2.5)},{_n(y - 5 * way)} l5,{5 * way} m-5,0 l5,{-5 * way}"


_MARKS: Mapping[str, tuple[str, Callable[[float, float, int], str]]] = {
    "arrow": ("head", _head),
    "ignored": ("ring", _ring),
    "dropped": ("cross", _cross),
}
"""Class and path of the end of an arrow, by the style of the arrow."""
