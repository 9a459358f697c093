"""Diagrams as Mermaid text, which GitHub and GitLab draw in Markdown.

https://mermaid.js.org/syntax/stateDiagram.html and .../flowchart.html.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from swarmdsl.codegen.diagram.graph import Diagram, Edge, Node
from swarmdsl.codegen.diagram.identifiers import identifiers

_ENTITIES = {
    ord(character): f"#{code};"
    for character, code in (
        *(('"', "quot"), ("<", "lt"), (">", "gt"), ("&", "amp")),
        *((each, str(ord(each))) for each in "#;:{}|%\\`~*"),
    )
}
_HISTORY = {"history": "H", "deep history": "H*"}
_ARROWS = {
    "connector": "-->",
    "composition": "---",
    "association": "---",
    "flow": "-.->",
}


def mermaid(diagram: Diagram) -> str:
    """Return the text of a diagram."""
    writer = _Writer(identifiers(diagram), diagram)
    lines = writer.statechart() if diagram.kind == "statechart" else writer.blocks()
    # The preamble sets the title.
    title = f"{diagram.frame.keyword} {diagram.name}"
    return "\n".join(["---", f"title: {title}", "---", *lines, ""])


class _Writer:
    def __init__(self, names: dict[str, str], diagram: Diagram) -> None:
        self.names = names
        self.diagram = diagram
        self.entries = {edge.source: edge for edge in diagram.edges if edge.kind == "initial"}
        self.ports = {port.id: port for node in diagram.frame.walk() for port in node.ports}

    def statechart(self) -> Iterator[str]:
        yield "stateDiagram-v2"
        yield from _indented(self.states(self.diagram.frame))
        for edge in self.diagram.edges:
            if edge.kind != "initial":
                label = f" : {_text(' '.join(edge.label))}" if edge.label else ""
                yield f"  {self.names[edge.source]} --> {self.names[edge.target]}{label}"
        lines = [line for group in self.diagram.frame.compartments for line in group]
        first = next((n for n in self.diagram.frame.nodes if n.kind != "initial"), None)
        if lines and first is not None:
            yield f"  note left of {self.names[first.id]}"
            yield from (f"    {_text(line)}" for line in lines)
            yield "  end note"

    def states(self, owner: Node) -> Iterator[str]:
        """Yield the lines of the states in a state, with its initial state."""
        for number, node in enumerate(owner.nodes):
            if owner.kind == "parallel" and number:
                yield "--"
            if node.kind == "initial":
                yield f"[*] --> {self.names[self.entries[node.id].target]}"
            else:
                yield from self.state(node)

    def state(self, node: Node) -> Iterator[str]:
        name = self.names[node.id]
        if node.kind == "choice":
            yield f"state {name} <<choice>>"
            return
        shown = f"{_HISTORY[node.kind]} {node.name}" if node.kind in _HISTORY else node.name
        lines = [line for group in node.compartments for line in group]
        if node.nodes:
            # A composite state has no lines of its own: they follow its name.
            shown = "<br/>".join(map(_text, (shown, *lines)))
            yield f'state "{shown}" as {name} {{'
            yield from _indented(self.states(node))
            yield "}"
            return
        yield f'state "{_text(shown)}" as {name}'
        yield from (f"{name} : {_text(line)}" for line in lines)
        if node.kind == "final":
            yield f"{name} --> [*]"

    def blocks(self) -> Iterator[str]:
        frame = self.diagram.frame
        yield "flowchart LR" if self.diagram.kind == "internal" else "flowchart TB"
        for port in frame.ports:
            text = _text(f"{port.direction} {port.name} : {port.type}")
            yield f'  {self.names[port.id]}(["{text}"])'
        if frame.compartments:
            yield f'  {self.names[frame.id]}["{self.text(frame)}"]'
        for node in frame.nodes:
            yield f'  {self.names[node.id]}["{self.text(node)}"]'
        for edge in self.diagram.edges:
            yield f"  {self.edge(edge)}"

    def text(self, node: Node) -> str:
        lines = [f"«{node.keyword}»", node.name]
        lines += (line for group in node.compartments for line in group)
        lines += (f"{port.direction} {port.name} : {port.type}" for port in node.ports)
        return "<br/>".join(map(_text, lines))

    def edge(self, edge: Edge) -> str:
        source, target, label = edge.source, edge.target, " ".join(edge.label)
        if edge.source_port is not None and edge.target_port is not None:
            # A port of the frame is a node of its own.
            names = [self.ports[edge.source_port].name, self.ports[edge.target_port].name]
            label = " → ".join(names if names[0] != names[1] else names[:1])
            source = source or edge.source_port
            target = target or edge.target_port
        arrow = _ARROWS[edge.kind]
        shown = f'|"{_text(label)}"|' if label else ""
        return f"{self.names[source]} {arrow}{shown} {self.names[target]}"


def _text(text: str) -> str:
    """Return text without special characters; line breaks become blanks."""
    return " ".join(text.split()).translate(_ENTITIES)


def _indented(lines: Iterable[str]) -> Iterator[str]:
    return (f"  {line}" for line in lines)
