"""A diagram as plain data: nodes in nodes, and edges between them.

Every format is written from this; only SVG needs a layout on top.
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
    """A port on the border of a node; `type` without its package, all of it in `doc`."""

    id: str
    name: str
    direction: Literal["in", "out", "inout"]
    type: str
    doc: str = ""
    origin: Span | None = field(default=None, compare=False, repr=False)


@dataclass(frozen=True, slots=True)
class Node:
    """A box or a pseudo-state, with the nodes inside it.

    `keyword` is what UML writes in guillemets, `compartments` are groups of lines below
    the name, each with a line above it. Both and the nodes inside are left out if it is `folded`.
    The last of these lines are the transitions `internal`, by their ids.
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
        """Whether it has an inside that can be hidden: states, or what stands below its name."""
        return self.kind in _FOLDABLE and bool(self.nodes or self.compartments or self.folded)

    @property
    def hides_states(self) -> bool:
        """Whether there are states in it that are not drawn here."""
        return self.kind == "submachine" or (self.folded and self.kind in _STATES_INSIDE)

    def walk(self) -> Iterator[Node]:
        """Yield the node and all inside it, in the order of the model."""
        yield self
        for node in self.nodes:
            yield from node.walk()


@dataclass(frozen=True, slots=True)
class Edge:
    """From node `source` to node `target`, or from and to ports of them.

    `label` is in pieces that stay together where it is broken into lines.
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
    """One picture: everything is in the frame, whose name is that of its subject."""

    kind: Kind
    name: str
    frame: Node
    edges: tuple[Edge, ...]

    @property
    def stem(self) -> str:
        """What a file of it is called, without the suffix."""
        return f"{self.name}.{self.kind}"
