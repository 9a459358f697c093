"""Diagrams of a system with links to the entries of the page."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from urllib.parse import quote

from markupsafe import Markup

from swarmdsl import ir
from swarmdsl.base.source import Span
from swarmdsl.codegen.diagram.graph import Diagram, Node
from swarmdsl.tools.diagram.folding import fold
from swarmdsl.tools.diagram.layout import lay_out
from swarmdsl.tools.diagram.map import maps
from swarmdsl.tools.diagram.svg import draw
from swarmdsl.tools.diagram.views import diagrams
from swarmdsl.tools.document.elements import Element, Elements
from swarmdsl.tools.document.page import Figure

_MAX_NODES = 2_000
"""Larger diagrams are slow to lay out and unreadable."""
_FEW_NODES = 12
"""Smaller diagrams are not folded."""
_TITLES = {
    "composition": "Members of {}",
    "internal": "Parts of {}",
    "statechart": "States of {}",
}


def pictures(system: ir.System, elements: Elements) -> Mapping[Element, Figure]:
    """Diagrams of swarms, members and state machines, and maps of environments, by element."""
    found = {}
    for diagram in diagrams(system):
        element = elements.at(diagram.frame.origin)
        if element is not None:
            found[element] = _figure(diagram, element, elements)
    for drawn in maps(system):
        element = elements.at(drawn.environment.origin)
        if element is not None:
            link = _links(element, elements)
            found[element] = Figure(f"Map of {element.path}", Markup(drawn.svg(link)))
    return found


def _figure(diagram: Diagram, subject: Element, elements: Elements) -> Figure:
    title = _TITLES[diagram.kind].format(subject.path)
    count = sum(1 for _ in diagram.frame.walk())
    if count > _MAX_NODES:
        command = f"swarmc diagram --kind {diagram.kind} --name {diagram.name}"
        too_large = f"With {count} nodes, the diagram is too large for this page: use `{command}`."
        return Figure(title, None, too_large)

    link = _links(subject, elements)
    drawn = [Markup(draw(lay_out(each), link)) for each in (diagram, *_folded(diagram, count))]
    return Figure(title, drawn[0], folded=tuple(drawn[1:]))


def _folded(diagram: Diagram, count: int) -> Iterator[Diagram]:
    """Yield a large diagram with less and less in its nodes."""
    if count < _FEW_NODES:
        return
    depths: dict[str, int] = {}

    def measure(node: Node, depth: int) -> None:
        for child in node.nodes:
            if child.foldable and child.nodes:
                depths[child.id] = depth
            measure(child, depth + (child.id in depths))

    measure(diagram.frame, 0)
    for depth in range(max(depths.values(), default=-1), -1, -1):
        yield fold(diagram, [id_ for id_, of in depths.items() if of >= depth])


def _links(subject: Element, elements: Elements) -> Callable[[Span | None], str | None]:
    """Return a function for the links of a picture, which has none to its subject."""

    def link(origin: Span | None) -> str | None:
        element = elements.at(origin)
        return f"#{quote(element.anchor)}" if element not in (None, subject) else None

    return link
