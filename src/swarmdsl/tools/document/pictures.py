"""Diagrams of a system with links to the entries of the page."""

from __future__ import annotations

from collections.abc import Mapping
from urllib.parse import quote

from markupsafe import Markup

from swarmdsl import ir
from swarmdsl.base.source import Span
from swarmdsl.codegen.diagram.graph import Diagram
from swarmdsl.tools.diagram.layout import lay_out
from swarmdsl.tools.diagram.svg import draw
from swarmdsl.tools.diagram.views import diagrams
from swarmdsl.tools.document.elements import Element, Elements
from swarmdsl.tools.document.page import Figure

_MAX_NODES = 2_000
"""Larger diagrams are slow to lay out and unreadable."""
_TITLES = {
    "composition": "Members of {}",
    "internal": "Parts of {}",
    "statechart": "States of {}",
}


def pictures(system: ir.System, elements: Elements) -> Mapping[Element, Figure]:
    """Diagrams of swarms, members and state machines by element."""
    found = {}
    for diagram in diagrams(system):
        element = elements.at(diagram.frame.origin)
        if element is not None:
            found[element] = _figure(diagram, element, elements)
    return found


def _figure(diagram: Diagram, subject: Element, elements: Elements) -> Figure:
    title = _TITLES[diagram.kind].format(subject.path)
    count = sum(1 for _ in diagram.frame.walk())
    if count > _MAX_NODES:
        command = f"swarmc diagram --kind {diagram.kind} --name {diagram.name}"
        too_large = f"With {count} nodes, the diagram is too large for this page: use `{command}`."
        return Figure(title, None, too_large)

    def link(origin: Span | None) -> str | None:
        element = elements.at(origin)
        return f"#{quote(element.anchor)}" if element not in (None, subject) else None

    return Figure(title, Markup(draw(lay_out(diagram), link)))
