"""Elements of a model with their anchors."""

from __future__ import annotations

import os
from bisect import bisect_right
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

from swarmdsl.analysis.node_kinds import KINDS, kind_name
from swarmdsl.base import resources
from swarmdsl.base.records import dataclass, field
from swarmdsl.base.source import Source, Span
from swarmdsl.project.loader import File
from swarmdsl.syntax.ast import (
    ActionType,
    Component,
    Event,
    Field,
    Node,
    Optimization,
    ServiceType,
    TopLevel,
    children,
    name_of,
)

_PARTS: dict[type[Node], tuple[str, ...]] = {
    ServiceType: ("request", "response"),
    ActionType: ("goal", "result", "feedback"),
}


@dataclass(eq=False, slots=True)
class Element:
    """A named element of the model and the elements inside it.

    `path` is the qualified name, such as `UavSearch.Mission.Idle`. It is also the anchor unless
    another element has the same path.
    """

    anchor: str
    path: str
    name: str
    kind: str
    node: Node
    file: File
    parent: Element | None
    children: list[Element] = field(default_factory=list)

    @property
    def top(self) -> Element:
        """Declaration that contains the element."""
        return self if self.parent is None else self.parent.top

    def walk(self) -> Iterator[Element]:
        """Yield the element and all its descendants in source order."""
        yield self
        for inner in self.children:
            yield from inner.walk()


class Elements:
    """Elements of the documented declarations."""

    def __init__(self, pairs: Sequence[tuple[File, TopLevel]]) -> None:
        self.tops: list[Element] = []
        self.anchors: dict[str, Element] = {}
        self._by_node: dict[Node, Element] = {}
        names = Counter(_name(node) for _, node in pairs)
        for file, node in pairs:
            name = _name(node)
            # The same disambiguation as in generated code.
            path = f"{file.package.replace('.', '_')}_{name}" if names[name] > 1 else name
            self.tops.append(self._add(path, name, node, file, None))
        self._starts: dict[Source, list[int]] = {}
        self._by_source: dict[Source, list[Element]] = {}
        for element in sorted(self._by_node.values(), key=lambda each: each.node.span.start):
            source = element.node.span.source
            self._by_source.setdefault(source, []).append(element)
            self._starts.setdefault(source, []).append(element.node.span.start)

    def of(self, node: Node | None) -> Element | None:
        """Element of a syntax node; None if it has no anchor."""
        return self._by_node.get(node) if node is not None else None

    def at(self, span: Span | None) -> Element | None:
        """Innermost element that contains a span."""
        if span is None or span.source not in self._by_source:
            return None
        found = bisect_right(self._starts[span.source], span.start) - 1
        element = self._by_source[span.source][found] if found >= 0 else None
        while element is not None and element.node.span.end < span.end:
            element = element.parent
        return element

    def _add(self, path: str, name: str, node: Node, file: File, parent: Element | None) -> Element:
        anchor, number = path, 1
        while anchor in self.anchors:
            number += 1
            anchor = f"{path}~{number}"
        element = Element(anchor, path, name, _kind(node), node, file, parent)
        self.anchors[anchor] = self._by_node[node] = element
        for inner, prefix in _named_children(node):
            inner_name = str(name_of(inner))
            inside = self._add(f"{path}.{prefix}{inner_name}", inner_name, inner, file, element)
            element.children.append(inside)
        return element


def _name(node: TopLevel) -> str:
    if isinstance(node, Optimization):
        # No other element can have a keyword as its name.
        return f"optimize.{node.swarm.name.rpartition('.')[2]}"
    return str(name_of(node))


def _kind(node: Node) -> str:
    """Kind of an element as shown to readers."""
    match node:
        case Optimization():
            return "optimization"
        case Component(kind="virtual"):
            return "virtual component"
        case Component(kind=kind):
            return kind
        case Event(swarm=True, operator=True):
            return "operator event"
        case Event(swarm=True):
            return "swarm event"
    return kind_name(node)


def _named_children(node: Node) -> Iterator[tuple[Node, str]]:
    """Yield the elements directly inside a node, with the interface part as a prefix."""
    parts: dict[Node, str] = {
        field: f"{part}."
        for part in _PARTS.get(type(node), ())
        for field in getattr(node, part)
        if isinstance(field, Field)
    }
    for child in children(node):
        if type(child) in KINDS:
            yield child, parts.get(child, "")


class SourceLocations:
    """File names relative to the common folder of the project.

    So a page does not depend on where the project is on disk.
    """

    def __init__(self, files: Iterable[File]) -> None:
        folders = [
            str(Path(os.path.abspath(file.source.name)).parent)  # noqa: PTH100 - keeps links
            for file in files
            if not file.library
        ]
        self._root = Path(os.path.commonpath(folders)) if folders else Path.cwd()

    def file(self, file: File) -> str:
        """Name of a file."""
        path = Path(os.path.abspath(file.source.name))  # noqa: PTH100 - keeps links
        for root in (self._root, resources.library()):
            if path.is_relative_to(root):
                return path.relative_to(root).as_posix()
        return path.name

    def location(self, element: Element) -> str:
        """Location of an element as `file:line`."""
        return f"{self.file(element.file)}:{element.node.span.line}"
