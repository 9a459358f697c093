"""Traversal of the syntax tree."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from functools import cache
from types import UnionType
from typing import Any, TypeVar, get_args

from swarmdsl.base.records import annotations_of, fields_of
from swarmdsl.syntax.ast import (
    architecture,
    behaviour,
    composition,
    file,
    interfaces,
    nodes,
    optimization,
    properties,
    space,
    values,
)
from swarmdsl.syntax.ast.nodes import Documented, Node, Ref, TopLevel, Word
from swarmdsl.syntax.ast.values import Input

_MODULES = (
    nodes,
    values,
    space,
    interfaces,
    behaviour,
    architecture,
    composition,
    optimization,
    properties,
    file,
)

_ABSTRACT = (Node, Documented, TopLevel, Input)
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
_WORD = re.compile(r"\w+")


class _Parts(dict[type[Node], tuple[tuple[str, bool], ...]]):
    """Attributes that hold child nodes, with True for lists; the last one first."""

    # A model has few kinds of nodes.
    def __missing__(self, cls: type[Node]) -> tuple[tuple[str, bool], ...]:
        annotations = annotations_of(cls)
        holding = [
            (name, annotations[name].startswith(("list", "tuple")))
            for name, about in fields_of(cls).items()
            if "elsewhere" not in about.get("metadata", ()) and _holds_parts(annotations[name])
        ]
        self[cls] = tuple(reversed(holding))
        return self[cls]


@cache
def _holds_parts(annotation: str) -> bool:
    return not _HOLDERS.isdisjoint(_WORD.findall(_NO_PARTS.sub("", annotation)))


class _References(dict[type[Node], tuple[str, ...]]):
    """Attributes that hold references."""

    def __missing__(self, cls: type[Node]) -> tuple[str, ...]:
        annotations = annotations_of(cls)
        self[cls] = tuple(name for name in fields_of(cls) if annotations[name].startswith("Ref["))
        return self[cls]


_PARTS = _Parts()
_REFERENCES = _References()

N = TypeVar("N", bound=Node)


def name_of(node: Node) -> Word:
    """Return the name of a node of a class with names."""
    name: Word = node.name  # type: ignore[attr-defined]  # classes with names have no base class
    return name


def children(node: Node) -> Iterator[Node]:
    """Yield the child nodes of a node, in document order."""
    for attribute, many in reversed(_PARTS[type(node)]):
        value = getattr(node, attribute)
        if many:
            yield from value
        elif value is not None:
            yield value


def walk(node: Node) -> Iterator[Node]:
    """Yield a node and its descendants, in document order."""
    ahead = [node]
    while ahead:
        node = ahead.pop()
        yield node
        for attribute, many in _PARTS[type(node)]:
            value = getattr(node, attribute)
            if many:
                ahead += value[::-1]
            elif value is not None:
                ahead.append(value)


def depth(node: Node) -> int:
    """Return the depth of a tree, counted in nodes."""
    levels, level = 0, [node]
    while level:
        levels += 1
        level = [inner for outer in level for inner in children(outer)]
    return levels


def by_class(owner: TopLevel) -> Mapping[type[Node], Sequence[Any]]:
    """Return the nodes of a declaration by class, each in document order.

    The result is cached: every phase needs it, and a parsed declaration hardly changes.
    """
    if owner.by_class is None:
        found: dict[type[Node], list[Any]] = defaultdict(list)
        for node in walk(owner):
            found[type(node)].append(node)
        owner.by_class = {kind: tuple(nodes) for kind, nodes in found.items()}
    return owner.by_class


def nodes_of(owner: TopLevel, kind: type[N]) -> Sequence[N]:
    """Return the nodes of one class in a declaration, in document order."""
    known = owner.by_class if owner.by_class is not None else by_class(owner)
    return known.get(kind, ())


def references(owner: TopLevel) -> Iterator[tuple[Node, Ref[Any]]]:
    """Yield the references in a declaration, each with its node."""
    for kind, found in by_class(owner).items():
        for attribute in _REFERENCES[kind]:
            for node in found:
                ref = getattr(node, attribute)
                if ref is not None:
                    yield node, ref


def invalidate(owner: TopLevel) -> None:
    """Drop the cache of a declaration, after one of its nodes was replaced."""
    owner.by_class = None
