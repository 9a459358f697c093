"""SVG shapes of a timeline."""

from __future__ import annotations

from xml.sax.saxutils import escape, quoteattr

from swarmdsl.base.xml_writer import legal

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
.arrow { stroke: #20304d; stroke-width: 1; stroke-opacity: 0.55; marker-end: url(#head) }
.head { fill: #20304d }
.dropped { stroke: #c0362c; stroke-width: 1; stroke-opacity: 0.7; stroke-dasharray: 3 2;
  marker-end: url(#cross) }
@media (prefers-color-scheme: dark) {
text { fill: #e3e8ee }
.state { fill: #1f2430 }
.note, .time { fill: #9aa5b4 }
.paper { fill: #16191d }
.lane { fill: #242a32 }
.tick { stroke: #3a424d }
.bar { stroke: #16191d }
.arrow { stroke: #ffffff; stroke-opacity: 0.75 }
.head { fill: #ffffff }
.dropped { stroke: #ff8a7a; stroke-opacity: 1 }
}
"""
_DEFINITIONS = """<defs>
<marker id="head" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="6" markerHeight="6"
 orient="auto">
<path class="head" d="M0,0.5 L8,4 L0,7.5 z"/></marker>
<marker id="cross" viewBox="0 0 8 8" refX="4" refY="4" markerWidth="7" markerHeight="7">
<path d="M1,1 L7,7 M7,1 L1,7" stroke="#c0362c" stroke-width="1.6"/></marker>
<pattern id="lost" width="6" height="6" patternUnits="userSpaceOnUse" patternTransform="rotate(45)">
<rect width="6" height="6" fill="#d9dce2"/>
<rect width="2" height="6" fill="#c0362c" opacity="0.45"/>
</pattern>
</defs>"""


class Drawing:
    """Shapes in drawing order; escapes strings."""

    def __init__(self, width: float, height: float) -> None:
        size = f'width="{_n(width)}" height="{_n(height)}" viewBox="0 0 {_n(width)} {_n(height)}"'
        self._parts = [
            f'<svg xmlns="http://www.w3.org/2000/svg" {size}>',
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

    def arrow(self, x: float, y: float, to_x: float, to_y: float, title: str) -> None:
        """Draw an arrow with a tooltip."""
        self._titled("arrow", _ends(x, y, to_x, to_y), title)

    def lost(self, x: float, y: float, to_x: float, to_y: float, title: str) -> None:
        """Draw an arrow of a lost message."""
        self._titled("dropped", _ends(x, y, to_x, to_y), title)

    def _titled(self, style: str, ends: str, title: str) -> None:
        self._parts.append(f'<line class="{style}" {ends}><title>{_text(title)}</title></line>')

    def finish(self) -> str:
        """Return the SVG file."""
        return "\n".join([*self._parts, "</svg>", ""])


def _text(text: str) -> str:
    return escape(legal(text))


def _ends(x: float, y: float, to_x: float, to_y: float) -> str:
    return f'x1="{_n(x)}" y1="{_n(y)}" x2="{_n(to_x)}" y2="{_n(to_y)}"'


def _box(x: float, y: float, width: float, height: float) -> str:
    return f'x="{_n(x)}" y="{_n(y)}" width="{_n(width)}" height="{_n(height)}"'


def _n(number: float) -> str:
    """Format a number with at most two decimals."""
    return f"{number:.2f}".rstrip("0").rstrip(".")
