"""The diagrams of a system as parts of a page, with links to what they show."""

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

_MOST_NODES = 2_000
"""A larger diagram takes long to lay out, and nobody can read it."""
_TITLES = {
    "composition": "The members of {}",
    "internal": "The parts of {}",
    "statechart": "The states of {}",
}


def pictures(system: ir.System, elements: Elements) -> Mapping[Element, Figure]:
    """The diagram of each swarm, member and state machine that has one."""
    found = {}
    for diagram in diagrams(system):
        element = elements.at(diagram.frame.origin)
        if element is not None:
            found[element] = _figure(diagram, element, elements)
    return found


def _figure(diagram: Diagram, subject: Element, elements: Elements) -> Figure:
    title = _TITLES[diagram.kind].format(subject.path)
    count = sum(1 for _ in diagram.frame.walk())
    if count > _MOST_NODES:
        way = f"swarmc diagram --kind {diagram.kind} --name {diagram.name}"
        return Figure(title, None, f"A diagram of {count} nodes is not drawn here; `{way}` does.")

    def link(origin: Span | None) -> str | None:
        element = elements.at(origin)
        return f"#{quote(element.anchor)}" if element not in (None, subject) else None

    return Figure(title, Markup(draw(lay_out(diagram), link)))
