"""Write diagrams as self-contained SVG for light and dark pages."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from xml.sax.saxutils import escape, quoteattr

from swarmdsl.base.source import Span
from swarmdsl.codegen.diagram.graph import Diagram
from swarmdsl.tools.diagram.layout import Box, Line, Picture, Pin, lay_out
from swarmdsl.tools.diagram.measure import SIZES, width
from swarmdsl.tools.diagram.shapes import PORT, port_text
from swarmdsl.tools.diagram.text_blocks import Block

_MARGIN = 12
_COLOURS = {
    # name: (light, dark)
    "paper": ("#ffffff", "#16191d"),
    "ink": ("#1d2733", "#e3e8ee"),
    "soft": ("#5b6876", "#9aa7b4"),
    "line": ("#44566b", "#8fa3b8"),
    "fill": ("#eef4fb", "#1f2c3a"),
    "inside": ("#f9fbfd", "#1a2027"),
    "head": ("#e3ecf6", "#243344"),
    "accent": ("#1f6fb2", "#62b0f0"),
}
_CLASS = "swarm-diagram"
_FONT = "Helvetica, Arial, 'Liberation Sans', sans-serif"
_RULES = f"""
text {{ font-family: {_FONT}; fill: @ink; }}
.name {{ font-size: {SIZES["name"]}px; font-weight: bold; }}
.keyword {{ font-size: {SIZES["keyword"]}px; fill: @soft; }}
.line {{ font-size: {SIZES["line"]}px; }}
.label {{ font-size: {SIZES["label"]}px; }}
.paper {{ fill: @paper; }}
.box {{ fill: @fill; stroke: @line; }}
.nest {{ fill: @inside; stroke: @line; }}
.outline {{ fill: none; stroke: @soft; }}
.tab {{ fill: @head; stroke: @soft; }}
.border {{ fill: none; stroke: @line; }}
.hit {{ fill: none; pointer-events: all; }}
.rule, .divider {{ stroke: @line; fill: none; }}
.divider {{ stroke-dasharray: 6 4; }}
.solid {{ fill: @ink; stroke: @ink; }}
.open {{ fill: @paper; stroke: @ink; }}
.edge path {{ fill: none; stroke: @line; stroke-width: 1.2; }}
.edge .arrow {{ fill: @line; stroke: @line; }}
.flow path {{ stroke: @accent; stroke-dasharray: 5 3; }}
.flow .arrow {{ fill: none; stroke: @accent; stroke-dasharray: none; }}
.flow text {{ fill: @accent; }}
.port rect {{ fill: @paper; stroke: @line; }}
.port path {{ fill: none; stroke: @line; }}
"""
# What XML cannot hold at all.
_IMPOSSIBLE = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")
_ARROW, _HALF = 8, 4
_DIAMOND = 14
_ROUND = {"state": 10, "submachine": 10, "composite": 12, "parallel": 12}


def svg(diagram: Diagram) -> str:
    """SVG text of a diagram."""
    return draw(lay_out(diagram))


def draw(picture: Picture, link: Callable[[Span | None], str | None] | None = None) -> str:
    """SVG of a laid-out diagram: a file, or a part of an HTML page if `link` is given.

    An HTML page also needs `style()`. Elements have the id of what they show as `data-id`, edges
    that of their target as `data-to`. In a file, `data-place` is the location in the model, for
    programs that show the diagram, and `data-fold` is `open` or `closed` for a foldable node. In a
    page, `link` gives the URL of an element.
    """
    return "\n".join([*_Writer(picture, link).lines(), ""])


class _Writer:
    def __init__(self, picture: Picture, link: Callable[[Span | None], str | None] | None) -> None:
        self.picture = picture
        self.link = link

    def lines(self) -> Iterator[str]:
        picture, frame = self.picture, self.picture.diagram.frame
        wide, high = picture.width + 2 * _MARGIN, picture.height + 2 * _MARGIN
        # Links inside role `img` cannot be reached with a keyboard.
        role = "img" if self.link is None else "group"
        yield (
            f'<svg xmlns="http://www.w3.org/2000/svg" class="{_CLASS}" role="{role}" '
            f'width="{wide}" height="{high}" '
            f'viewBox="{-_MARGIN} {-_MARGIN} {wide} {high}">'
        )
        yield f"<title>{_text(f'{frame.keyword} {frame.name}')}</title>"
        if frame.doc:
            yield f"<desc>{_text(frame.doc)}</desc>"
        if self.link is None:
            yield f"<style>{style()}</style>"
        yield f'<rect class="paper" x="{-_MARGIN}" y="{-_MARGIN}" width="{wide}" height="{high}"/>'
        for box in picture.boxes:
            named = box.node.kind not in ("frame", "initial")
            yield from self.linked(self.box(box), box.node.origin if named else None)
        for line in picture.lines:
            is_arrow = line.edge.kind in ("transition", "connector")
            yield from self.linked(self.edge(line), line.edge.origin if is_arrow else None, False)
        for pin in picture.pins:
            yield from self.linked(self.pin(pin), pin.port.origin, False)
        yield "</svg>"

    def linked(
        self, shape: Iterator[str], origin: Span | None, by_key: bool = True
    ) -> Iterator[str]:
        """Wrap a shape in a link to its element, with a tab stop if `by_key`."""
        to = self.link(origin) if self.link is not None else None
        if to is None:
            yield from shape
        else:
            yield f"<a href={_quoted(to)}>" if by_key else f'<a href={_quoted(to)} tabindex="-1">'
            yield from shape
            yield "</a>"

    def about(self, classes: str, id_: str, origin: Span | None) -> str:
        place = ""
        if origin is not None and self.link is None:
            at = origin.absolute
            line, column = at.source.line_column(at.start)
            place = f" data-place={_quoted(f'{at.source.name}:{line}:{column}')}"
        return f' class="{classes}" data-id={_quoted(id_)}{place}'

    def box(self, box: Box) -> Iterator[str]:
        node = box.node
        fold = ""
        if node.foldable and self.link is None:
            fold = f' data-fold="{"closed" if node.folded else "open"}"'
        yield f"<g{self.about(f'node {node.kind}', node.id, node.origin)}{fold}>"
        if node.doc:
            yield f"<title>{_text(node.doc)}</title>"
        match node.kind:
            case "frame":
                yield from self.frame(box)
            case "region":
                # Regions that fill a state share its border.
                style = "divider" if box.divider is None else "hit"
                yield f'<rect class="{style}" {_area(box.x, box.y, box.width, box.height)}/>'
                if box.divider:
                    yield f'<path class="divider" d="M{box.x},{box.y} {box.divider}"/>'
            case "initial":
                yield self.circle(box, "solid", 0)
            case "final":
                yield self.circle(box, "open", 0)
                yield self.circle(box, "solid", 4)
            case "history" | "deep history":
                yield self.circle(box, "open", 0)
                letter = "H*" if node.kind == "deep history" else "H"
                x, y, wide, high = box.core
                middle = f'x="{x + wide // 2}" y="{y + high // 2 + 4}" text-anchor="middle"'
                yield f'<text class="line" {middle}>{letter}</text>'
            case "choice":
                x, y, wide, high = box.core
                corners = (
                    f"M{x + wide // 2},{y} l{wide // 2},{high // 2} l{-(wide // 2)},{high // 2}"
                )
                yield f'<path class="box" d="{corners} l{-(wide // 2)},{-(high // 2)} Z"/>'
            case _:
                yield from self.rectangle(box)
        for rule in box.block.rules if node.kind != "frame" else ():
            yield f'<path class="rule" d="M{box.x},{box.y + rule} h{box.width}"/>'
        yield from self.block(box.block, box.x, box.y, box.width)
        yield "</g>"

    def frame(self, box: Box) -> Iterator[str]:
        """SysML frame with its title in a corner."""
        wide = min(
            max(text.width for text in box.block.texts if text.style == "name") + 32, box.width
        )
        high = 25
        yield f'<rect class="outline" {_area(box.x, box.y, box.width, box.height)}/>'
        tab = f"M{box.x},{box.y} h{wide} v{high - 8} l-8,8 H{box.x} Z"
        yield f'<path class="tab" d="{tab}"/>'

    def rectangle(self, box: Box) -> Iterator[str]:
        node = box.node
        style = "nest" if node.nodes else "box"
        radius = f' rx="{_ROUND[node.kind]}"' if node.kind in _ROUND else ""
        yield f'<rect class="{style}" {_area(box.x, box.y, box.width, box.height)}{radius}/>'
        if node.nodes:
            y = box.y + box.block.height
            yield f'<path class="rule" d="M{box.x},{y} h{box.width}"/>'
        if node.hides_states:
            # Two small states, the UML mark for a hidden decomposition.
            x, y = box.x + box.width - 24, box.y + box.height - 9
            yield f'<rect class="border" {_area(x, y, 6, 4)} rx="2"/>'
            yield f'<path class="border" d="M{x + 6},{y + 2} h5"/>'
            yield f'<rect class="border" {_area(x + 11, y, 6, 4)} rx="2"/>'

    def circle(self, box: Box, style: str, inset: int) -> str:
        x, y, wide, high = box.core
        return (
            f'<circle class="{style}" cx="{x + wide // 2}" cy="{y + high // 2}" '
            f'r="{wide // 2 - inset}"/>'
        )

    def block(self, block: Block, x: int, y: int, wide: int) -> Iterator[str]:
        for text in block.texts:
            left = x + (text.x if text.x is not None else (wide - text.width) // 2)
            yield _text_element(text.text, text.style, left, y + text.y, text.width, text.id)

    def edge(self, line: Line) -> Iterator[str]:
        edge, points = line.edge, list(line.points)
        about = self.about(f"edge {edge.kind}", edge.id, edge.origin)
        yield f"<g{about} data-to={_quoted(edge.target)}>"
        if edge.doc:
            yield f"<title>{_text(edge.doc)}</title>"
        yield f'<path d="{_rounded(points)}"/>'
        if edge.kind == "composition":
            yield f'<path class="arrow" d="{_diamond(points[0], points[1])}"/>'
        elif edge.kind != "association":
            yield f'<path class="arrow" d="{_arrow(points[-2], points[-1], edge.kind == "flow")}"/>'
        if line.label is not None:
            yield from self.block(line.label, line.label_x, line.label_y, line.label.width)
        yield "</g>"

    def pin(self, pin: Pin) -> Iterator[str]:
        half = PORT // 2
        port, x, y = pin.port, pin.x, pin.y
        yield f"<g{self.about('port', port.id, port.origin)}>"
        yield f"<title>{_text(port.doc)}</title>"
        yield f"<rect {_area(x - half, y - half, PORT, PORT)}/>"
        if port.direction != "inout":
            yield f'<path d="M{x - 2},{y - 3} l4,3 l-4,3"/>'
        else:
            yield f'<path d="M{x - 1},{y - 3} l-3,3 l3,3 M{x + 1},{y - 3} l3,3 l-3,3"/>'
        if pin.name_x is not None:
            name = port_text(port)
            yield _text_element(name, "line", pin.name_x, y - 5, width(name, "line"))
        yield "</g>"


def style() -> str:
    """Style sheet of diagrams, limited to their class.

    Each colour is given as a number and as a variable, because some programs do not know CSS
    variables.
    """
    light, dark = (
        "".join(f"--{name}: {pair[which]}; " for name, pair in _COLOURS.items()) for which in (0, 1)
    )
    lines = [
        f".{_CLASS} {{ {light}}}",
        f"@media (prefers-color-scheme: dark) {{ .{_CLASS} {{ {dark}}} }}",
    ]
    for rule in _RULES.strip().splitlines():
        selectors, _, body = rule.rstrip("} ").partition(" { ")
        where = ", ".join(f".{_CLASS} {each}" for each in selectors.split(", "))
        facts = []
        for fact in body.rstrip(";").split("; "):
            facts.append(re.sub(r"@(\w+)", lambda found: _COLOURS[found[1]][0], fact))
            if "@" in fact:
                facts.append(re.sub(r"@(\w+)", r"var(--\1)", fact))
        lines.append(f"{where} {{ {'; '.join(facts)}; }}")
    return "\n" + "\n".join(lines) + "\n"


def _text_element(text: str, style: str, x: int, y: int, wide: int, id_: str = "") -> str:
    """Line of text that is stretched to the measured width."""
    fitted = f' textLength="{wide}" lengthAdjust="spacingAndGlyphs"' if len(text) > 1 else ""
    about = f" data-id={_quoted(id_)}" if id_ else ""
    return f'<text class="{style}"{about} x="{x}" y="{y}"{fitted}>{_text(text)}</text>'


def _rounded(points: list[tuple[int, int]]) -> str:
    """Path with slightly rounded corners."""
    parts = [f"M{points[0][0]},{points[0][1]}"]
    for before, corner, after in zip(points, points[1:], points[2:], strict=False):
        near = [_towards(corner, other) for other in (before, after)]
        parts.append(
            f"L{near[0][0]},{near[0][1]} Q{corner[0]},{corner[1]} {near[1][0]},{near[1][1]}"
        )
    parts.append(f"L{points[-1][0]},{points[-1][1]}")
    return " ".join(parts)


def _towards(corner: tuple[int, int], other: tuple[int, int]) -> tuple[int, int]:
    dx, dy = other[0] - corner[0], other[1] - corner[1]
    size = min(4, (abs(dx) + abs(dy)) // 2)
    return corner[0] + _sign(dx) * size, corner[1] + _sign(dy) * size


def _arrow(before: tuple[int, int], tip: tuple[int, int], is_open: bool) -> str:
    dx, dy = _sign(tip[0] - before[0]), _sign(tip[1] - before[1])
    back = (tip[0] - dx * _ARROW, tip[1] - dy * _ARROW)
    one = (back[0] - dy * _HALF, back[1] + dx * _HALF)
    other = (back[0] + dy * _HALF, back[1] - dx * _HALF)
    return f"M{one[0]},{one[1]} L{tip[0]},{tip[1]} L{other[0]},{other[1]}" + (
        "" if is_open else " Z"
    )


def _diamond(tip: tuple[int, int], after: tuple[int, int]) -> str:
    dx, dy = _sign(after[0] - tip[0]), _sign(after[1] - tip[1])
    half = _DIAMOND // 2
    middle = (tip[0] + dx * half, tip[1] + dy * half)
    corners = (
        tip,
        (middle[0] - dy * _HALF, middle[1] + dx * _HALF),
        (tip[0] + dx * _DIAMOND, tip[1] + dy * _DIAMOND),
        (middle[0] + dy * _HALF, middle[1] - dx * _HALF),
    )
    return "M" + " L".join(f"{x},{y}" for x, y in corners) + " Z"


def _sign(number: int) -> int:
    return (number > 0) - (number < 0)


def _area(x: int, y: int, wide: int, high: int) -> str:
    return f'x="{x}" y="{y}" width="{wide}" height="{high}"'


def _quoted(text: str) -> str:
    return quoteattr(_IMPOSSIBLE.sub("\N{REPLACEMENT CHARACTER}", text))


def _text(text: str) -> str:
    return escape(_IMPOSSIBLE.sub("\N{REPLACEMENT CHARACTER}", text))
