"""Diagrams as plain data: nested nodes and edges.

Every format is written from this; only SVG needs a layout as well.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Literal

from swarmdsl.base.records import dataclass, field
from swarmdsl.base.source import Span

Kind = Literal["composition", "internal", "statechart"]
KINDS: tuple[Kind, ...] = ("composition", "internal", "statechart")

_Box = Literal["frame", "swarm", "member", "environment", "fitness", "part"]
_State = Literal["state", "submachine", "composite", "parallel", "region"]
_PseudoState = Literal["initial", "final", "choice", "history", "deep history"]
NodeKind = _Box | _State | _PseudoState
_STATES_INSIDE: frozenset[NodeKind] = frozenset(("composite", "parallel"))
_FOLDABLE: frozenset[NodeKind] = _STATES_INSIDE | {"part", "member"}
EdgeKind = Literal["transition", "initial", "connector", "composition", "association", "flow"]


@dataclass(frozen=True, slots=True)
class Port:
    """Port on the border of a node; `type` is short, `doc` has the full type."""

    id: str
    name: str
    direction: Literal["in", "out", "inout"]
    type: str
    doc: str = ""
    origin: Span | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Node:
    """Box or pseudo-state, with the nodes inside it.

    `keyword` is shown in guillemets, `compartments` are groups of lines below the name, separated
    by rules. A `folded` node hides both and the nodes inside. The last of these lines are the
    transitions `internal`, by their ids.
    """

    id: str
    kind: NodeKind
    name: str
    keyword: str = ""
    compartments: tuple[tuple[str, ...], ...] = ()
    nodes: tuple[Node, ...] = ()
    ports: tuple[Port, ...] = ()
    doc: str = ""
    origin: Span | None = field(default=None, compare=False, repr=False)
    folded: bool = False
    internal: tuple[str, ...] = ()

    @property
    def foldable(self) -> bool:
        """True if the node has states or compartments to hide."""
        return self.kind in _FOLDABLE and bool(self.nodes or self.compartments or self.folded)

    @property
    def hides_states(self) -> bool:
        """True if the node has states that are not drawn here."""
        return self.kind == "submachine" or (self.folded and self.kind in _STATES_INSIDE)

    def walk(self) -> Iterator[Node]:
        """Yield the node and all inside it, in the order of the model."""
        yield self
        for node in self.nodes:
            yield from node.walk()


@dataclass(frozen=True, slots=True)
class Edge:
    """Edge from node `source` to node `target`, or between ports of them.

    `label` is in pieces, between which lines may break.
    """

    id: str
    kind: EdgeKind
    source: str
    target: str
    label: tuple[str, ...] = ()
    source_port: str | None = None
    target_port: str | None = None
    doc: str = ""
    origin: Span | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Diagram:
    """Frame with the name of the subject, and its content."""

    kind: Kind
    name: str
    frame: Node
    edges: tuple[Edge, ...]

    @property
    def stem(self) -> str:
        """Name of a file with the diagram, without the suffix."""
        return f"{self.name}.{self.kind}"
