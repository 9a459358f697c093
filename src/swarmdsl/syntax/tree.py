"""Walks over the tree."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import fields

from swarmdsl.syntax import architecture, behaviour, composition, file, interfaces, nodes
from swarmdsl.syntax.nodes import Node

_MODULES = (nodes, interfaces, architecture, behaviour, composition, file)

NODES: dict[str, type[Node]] = {
    cls.__name__: cls
    for module in _MODULES
    for cls in vars(module).values()
    if isinstance(cls, type) and issubclass(cls, Node)
}
# Where the parts of a node are; a node that it only refers to is no part of it.
_ATTRIBUTES = {
    cls: [part.name for part in fields(cls) if "elsewhere" not in part.metadata]
    for cls in NODES.values()
}


def children(node: Node) -> Iterator[Node]:
    """The nodes directly inside a node, in document order."""
    for attribute in _ATTRIBUTES[type(node)]:
        value = getattr(node, attribute)
        if isinstance(value, Node):
            yield value
        elif isinstance(value, (list, tuple)):
            yield from (item for item in value if isinstance(item, Node))


def walk(node: Node) -> Iterator[Node]:
    """A node and all inside it, in document order."""
    yield node
    for child in children(node):
        yield from walk(child)
