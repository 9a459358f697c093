"""Labels and shapes of a diagram, each measured once."""

from __future__ import annotations

from swarmdsl.codegen.diagram.graph import Diagram, Node
from swarmdsl.tools.diagram.shapes import PSEUDO_STATES, Direction, Shape, shape_of
from swarmdsl.tools.diagram.text_blocks import Block, label_block


class Texts:
    """Blocks of text: `labels` by the number of the edge."""

    def __init__(self, diagram: Diagram, right_ports: set[str]) -> None:
        self._right_ports = right_ports
        self._shapes: dict[tuple[str, Direction], Shape] = {}
        self.labels: dict[int, Block] = {
            number: label_block(edge.label)
            for number, edge in enumerate(diagram.edges)
            if edge.label
        }

    def shape(self, node: Node, direction: Direction) -> Shape:
        """Shape of a node without its children, in a layout of a direction."""
        if node.kind not in PSEUDO_STATES:
            direction = "down"  # the same in both
        found = self._shapes.get((node.id, direction))
        if found is None:
            found = self._shapes[node.id, direction] = shape_of(node, direction, self._right_ports)
        return found
