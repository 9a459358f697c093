"""Walks over the tree."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from types import UnionType
from typing import Any, TypeVar, get_args

from swarmdsl.dataclass import described
from swarmdsl.syntax import architecture, behaviour, composition, file, interfaces, nodes
from swarmdsl.syntax.nodes import Documented, Node, Ref, TopLevel

_MODULES = (nodes, interfaces, architecture, behaviour, composition, file)

_ABSTRACT = (Node, Documented, TopLevel)
NODES: dict[str, type[Node]] = {
    cls.__name__: cls
    for module in _MODULES
    for cls in vars(module).values()
    if isinstance(cls, type) and issubclass(cls, Node) and cls not in _ABSTRACT
}
# What holds a part says so in its annotation: by a class of node, or a union of them.
_HOLDERS = NODES.keys() | {
    name
    for module in _MODULES
    for name, value in vars(module).items()
    if isinstance(value, UnionType) and issubclass(get_args(value)[0], Node)
}
_NO_PARTS = re.compile(r"(?:Ref|Literal)\[[^\]]*\]")


def _parts(cls: type[Node]) -> tuple[tuple[str, bool], ...]:
    """The attributes that hold parts of a node, and whether they hold many, last ones first."""
    annotations = {
        name: _NO_PARTS.sub("", annotation)
        for name, annotation, about in described(cls)
        if "elsewhere" not in about.get("metadata", ())
    }
    return tuple(
        (name, annotation.startswith(("list", "tuple")))
        for name, annotation in reversed(annotations.items())
        if not _HOLDERS.isdisjoint(re.findall(r"\w+", annotation))
    )


_PARTS = {cls: _parts(cls) for cls in NODES.values()}
_REFERENCES = {
    cls: tuple(name for name, annotation, _ in described(cls) if annotation.startswith("Ref["))
    for cls in NODES.values()
}

N = TypeVar("N", bound=Node)


def children(node: Node) -> Iterator[Node]:
    """The nodes directly inside a node, in document order."""
    for attribute, many in reversed(_PARTS[type(node)]):
        value = getattr(node, attribute)
        if many:
            yield from value
        elif value is not None:
            yield value


def walk(node: Node) -> Iterable[Node]:
    """A node and all inside it, in document order.

    Every phase walks every declaration, which hardly changes once it is parsed: what is in
    it is looked for once.
    """
    if not isinstance(node, TopLevel):
        return _walk(node)
    if node.nodes is None:
        node.nodes = tuple(_walk(node))
    return node.nodes


def nodes_of(owner: TopLevel, kind: type[N]) -> Sequence[N]:
    """The nodes of one class in a declaration, in document order, looked for once like all."""
    if owner.by_class is None:
        by_class: dict[type[Node], list[Any]] = {}
        for node in walk(owner):
            by_class.setdefault(type(node), []).append(node)
        owner.by_class = by_class
    return owner.by_class.get(kind, ())


def references(owner: Node) -> Iterator[tuple[Node, Ref[Any]]]:
    """The references in a node, in document order, each with the node that holds it."""
    for node in walk(owner):
        for attribute in _REFERENCES[type(node)]:
            ref = getattr(node, attribute)
            if ref is not None:
                yield node, ref


def changed(owner: TopLevel) -> None:
    """Forget what is in a declaration: a node of it was replaced."""
    owner.nodes = owner.by_class = None


def _walk(node: Node) -> Iterator[Node]:
    ahead = [node]
    while ahead:
        node = ahead.pop()
        yield node
        for attribute, many in _PARTS[type(node)]:
            value = getattr(node, attribute)
            if many:
                ahead.extend(reversed(value))
            elif value is not None:
                ahead.append(value)
