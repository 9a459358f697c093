"""Write diagrams as DOT for Graphviz (https://graphviz.org/doc/info/lang.html)."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from swarmdsl.codegen.diagram.graph import Diagram, Edge, Node
from swarmdsl.codegen.diagram.identifiers import identifiers

_SHAPES = {
    "initial": 'shape=circle, style=filled, fillcolor=black, width=0.18, label=""',
    "final": 'shape=doublecircle, style=filled, fillcolor=black, width=0.12, label="", '
    "xlabel={name}",
    "choice": 'shape=diamond, width=0.35, height=0.35, label="", xlabel={name}',
    "history": "shape=circle, width=0.3, fixedsize=true, label={letter}, xlabel={name}",
}
_EDGES = {
    "composition": "dir=both, arrowtail=diamond, arrowhead=none",
    "association": "arrowhead=none",
    "flow": "style=dashed, arrowhead=vee",
}


def dot(diagram: Diagram) -> str:
    """DOT text of a diagram."""
    return "\n".join([*_Writer(diagram).lines(), ""])


class _Writer:
    def __init__(self, diagram: Diagram) -> None:
        self.diagram = diagram
        self.names = identifiers(diagram)
        self.nodes = {node.id: node for node in diagram.frame.walk()}
        self.parents = {child.id: node.id for node in diagram.frame.walk() for child in node.nodes}

    def lines(self) -> Iterator[str]:
        frame = self.diagram.frame
        direction = "LR" if self.diagram.kind == "internal" else "TB"
        yield f"digraph {_quoted(f'{self.diagram.kind} {self.diagram.name}')} {{"
        yield f"  graph [compound=true, rankdir={direction}, fontname=Helvetica, fontsize=11]"
        yield "  node [shape=box, fontname=Helvetica, fontsize=11]"
        yield "  edge [fontname=Helvetica, fontsize=10]"
        yield f"  label={_label(_head(frame))}"
        yield "  labelloc=t"
        for port in frame.ports:
            text = f"{port.name} : {port.type}"
            yield f"  {self.names[port.id]} [shape=cds, label={_quoted(text)}]"
        for node in frame.nodes:
            yield from _indented(self.node(node))
        for edge in self.diagram.edges:
            yield f"  {self.edge(edge)}"
        yield "}"

    def node(self, node: Node) -> Iterator[str]:
        name = self.names[node.id]
        if node.nodes:
            style = "dashed" if node.kind == "region" else "rounded"
            yield f"subgraph cluster_{name} {{"
            yield f"  label={_label(_head(node))}"
            yield f"  style={style}"
            # Edges to the whole state end at an invisible point in the cluster.
            yield f'  {name} [shape=point, style=invis, width=0, label=""]'
            for child in node.nodes:
                yield from _indented(self.node(child))
            yield "}"
        elif node.kind in ("history", "deep history"):
            letter = _quoted("H*" if node.kind == "deep history" else "H")
            shape = _SHAPES["history"].format(letter=letter, name=_quoted(node.name))
            yield f"{name} [{shape}]"
        elif node.kind in _SHAPES:
            shape = _SHAPES[node.kind].format(name=_quoted(node.name))
            yield f"{name} [{shape}]"
        elif node.ports:
            yield f"{name} [shape=plain, label={self.table(node)}]"
        else:
            style = "rounded" if node.kind in ("state", "submachine") else "solid"
            yield f"{name} [style={style}, label={_label(_head(node))}]"

    def table(self, node: Node) -> str:
        """HTML label of a box with a cell for each port."""
        head = "<br/>".join(map(_html, _head(node)))
        rows = [f'<tr><td colspan="2">{head}</td></tr>']
        ins = [port for port in node.ports if port.direction != "out"]
        outs = [port for port in node.ports if port.direction == "out"]
        for number in range(max(len(ins), len(outs))):
            cells = ""
            for ports in (ins, outs):
                if number < len(ports):
                    port = ports[number]
                    text = _html(f"{port.name} : {port.type}")
                    cells += f'<td port="{self.names[port.id]}">{text}</td>'
                else:
                    cells += "<td></td>"
            rows.append(f"<tr>{cells}</tr>")
        return f'<<table border="0" cellborder="1" cellspacing="0">{"".join(rows)}</table>>'

    def edge(self, edge: Edge) -> str:
        ends = [
            self.end(edge.source, edge.source_port),
            self.end(edge.target, edge.target_port),
        ]
        facts = [_EDGES[edge.kind]] if edge.kind in _EDGES else []
        if edge.label:
            facts.append(f"label={_label(edge.label)}")
        # Graphviz cannot clip an edge at a cluster that contains its other end.
        if self.nodes[edge.source].nodes and not self.within(edge.target, edge.source):
            facts.append(f"ltail=cluster_{self.names[edge.source]}")
        if self.nodes[edge.target].nodes and not self.within(edge.source, edge.target):
            facts.append(f"lhead=cluster_{self.names[edge.target]}")
        shown = f" [{', '.join(facts)}]" if facts else ""
        return f"{' -> '.join(ends)}{shown}"

    def end(self, node: str, port: str | None) -> str:
        if port is None:
            return self.names[node]
        return f"{self.names[node]}:{self.names[port]}" if node else self.names[port]

    def within(self, node: str, ancestor: str) -> bool:
        """Return True if a node is `ancestor` or inside it; the frame contains all nodes."""
        at: str | None = node
        while at is not None and at != ancestor:
            at = self.parents.get(at)
        return at == ancestor


def _head(node: Node) -> list[str]:
    """Keyword, name and compartments of a node."""
    name = f"{node.keyword} {node.name}" if node.kind == "frame" else node.name
    keyword = [f"«{node.keyword}»"] if node.keyword and node.kind != "frame" else []
    return [*keyword, name, *(line for group in node.compartments for line in group)]


def _label(lines: Iterable[str]) -> str:
    return '"' + r"\n".join(_quoted(line)[1:-1] for line in lines) + '"'


def _quoted(text: str) -> str:
    # Graphviz reads entities of HTML in every label.
    escaped = " ".join(text.split()).replace("&", "&amp;")
    return '"' + escaped.replace("\\", "\\\\").replace('"', '\\"') + '"'


def _html(text: str) -> str:
    escaped = text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")
    return escaped.replace('"', "&quot;")


def _indented(lines: Iterable[str]) -> Iterator[str]:
    return (f"  {line}" for line in lines)
