"""Write diagrams as PlantUML.

https://plantuml.com/state-diagram and .../component-diagram.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator

from swarmdsl.codegen.diagram.graph import Diagram, Edge, Node
from swarmdsl.codegen.diagram.identifiers import identifiers

_STEREOTYPES = {
    "choice": " <<choice>>",
    "final": " <<end>>",
    "history": " <<history>>",
    "deep history": " <<history*>>",
}
_ARROWS = {"connector": "-->", "composition": "*--", "association": "--", "flow": "..>"}
# Markup, entities, comments, modifiers of fields, and calls of the preprocessor, which can read
# files and the environment: single characters, and some only when doubled.
_MARKUP = re.compile(r'[<>"~\\&\'{}%$]|([*_/\-.=\[\]])(?=\1)|(?<=([*_/\-.=\[\]]))\2')


def plantuml(diagram: Diagram) -> str:
    """PlantUML text of a diagram."""
    writer = _Writer(diagram)
    lines = writer.statechart() if diagram.kind == "statechart" else writer.blocks()
    title = _text(f"{diagram.frame.keyword} {diagram.name}")
    return "\n".join(["@startuml", f"title {title}", *lines, "@enduml", ""])


class _Writer:
    def __init__(self, diagram: Diagram) -> None:
        self.diagram = diagram
        self.names = identifiers(diagram)
        # PlantUML has no edges into or out of regions: if an edge crosses the border of a region,
        # the regions are drawn as nested states.
        self.crossed = _crossed(diagram)
        self.ports = {port.id: port for node in diagram.frame.walk() for port in node.ports}
        self.entries = {edge.source: edge for edge in diagram.edges if edge.kind == "initial"}

    def statechart(self) -> Iterator[str]:
        yield "hide empty description"
        yield from self.legend()
        yield from self.states(self.diagram.frame)
        for edge in self.diagram.edges:
            if edge.kind != "initial":
                label = f" : {_lines(edge.label)}" if edge.label else ""
                yield f"{self.names[edge.source]} --> {self.names[edge.target]}{label}"

    def legend(self) -> Iterator[str]:
        """Yield params and variables of the machine or member."""
        lines = [line for group in self.diagram.frame.compartments for line in group]
        if lines:
            yield from ("legend", *map(_text, lines), "endlegend")

    def states(self, owner: Node) -> Iterator[str]:
        for number, node in enumerate(owner.nodes):
            if number and owner.kind == "parallel" and owner.id not in self.crossed:
                yield "--"
            if node.kind == "initial":
                yield f"[*] --> {self.names[self.entries[node.id].target]}"
                continue
            name = self.names[node.id]
            head = f'state "{_text(node.name)}" as {name}{_STEREOTYPES.get(node.kind, "")}'
            if node.nodes:
                yield from (f"{head} {{", *_indented(self.states(node)), "}")
            else:
                yield head
            lines = (line for group in node.compartments for line in group)
            yield from (f"{name} : {_text(line)}" for line in lines)

    def blocks(self) -> Iterator[str]:
        """Yield boxes as classes, which every version of PlantUML draws with compartments."""
        frame = self.diagram.frame
        yield from ("hide circle", "hide empty members")
        if self.diagram.kind == "internal":
            yield "left to right direction"
            yield from self.legend()
            yield f'package "{_text(frame.name)}" <<{frame.keyword}>> {{'
            for port in frame.ports:
                text = _text(f"{port.direction} {port.name} : {port.type}")
                yield f'  interface "{text}" as {self.names[port.id]}'
            for node in frame.nodes:
                yield from _indented(self.box(node))
            yield "}"
        else:
            for node in frame.nodes:
                yield from self.box(node)
        yield from map(self.edge, self.diagram.edges)

    def box(self, node: Node) -> Iterator[str]:
        ports = tuple(f"{port.direction} {port.name} : {port.type}" for port in node.ports)
        yield f'class "{_text(node.name)}" as {self.names[node.id]} <<{node.keyword}>> {{'
        for number, group in enumerate((*node.compartments, *([ports] if ports else []))):
            yield from ["  --"] if number else []
            # Without `{field}`, a line with parentheses would be drawn as a method.
            yield from (f"  {{field}} {_text(line)}" for line in group)
        yield "}"

    def edge(self, edge: Edge) -> str:
        ends = []
        for node, port in ((edge.source, edge.source_port), (edge.target, edge.target_port)):
            if port is not None and not node:
                ends.append((self.names[port], ""))
            else:
                name = f'"{_text(self.ports[port].name)}"' if port is not None else ""
                ends.append((self.names[node], name))
        (source, tail), (target, head) = ends
        label = f" : {_lines(edge.label)}" if edge.label else ""
        words = filter(None, (source, tail, _ARROWS[edge.kind], head, target))
        return f"{' '.join(words)}{label}"


def _lines(lines: Iterable[str]) -> str:
    return r"\n".join(map(_text, lines))


def _crossed(diagram: Diagram) -> set[str]:
    """Return the ids of parallel states with an edge that crosses the border of a region."""
    # The regions around each node, with their parallel states.
    regions: dict[str, dict[str, str]] = {}
    stack: list[tuple[Node, str | None, dict[str, str]]] = [(diagram.frame, None, {})]
    while stack:
        node, parallel, around = stack.pop()
        regions[node.id] = around
        inside = around if parallel is None else {**around, node.id: parallel}
        owner = node.id if node.kind == "parallel" else None
        stack += [(each, owner, inside) for each in node.nodes]
    crossed: set[str] = set()
    for edge in diagram.edges:
        ends = [regions.get(end, {}) for end in (edge.source, edge.target)]
        for one, other in (ends, ends[::-1]):
            crossed.update(one[region] for region in one.keys() - other.keys())
    return crossed


def _text(text: str) -> str:
    """Escape markup."""
    return _MARKUP.sub(lambda found: f"<U+{ord(found[0]):04X}>", " ".join(text.split()))


def _indented(lines: Iterable[str]) -> Iterator[str]:
    return (f"  {line}" for line in lines)
