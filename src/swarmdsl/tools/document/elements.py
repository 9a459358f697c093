"""What a model has that can be linked to, each element with an anchor of its own."""

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
)

_PARTS: dict[type[Node], tuple[str, ...]] = {
    ServiceType: ("request", "response"),
    ActionType: ("goal", "result", "feedback"),
}


@dataclass(eq=False, slots=True)
class Element:
    """A named piece of the model; `inside` are those in it.

    `path` is what a person calls it: `UavSearch.Mission.Idle`. It is the anchor too, unless
    something else has the same.
    """

    anchor: str
    path: str
    name: str
    kind: str
    node: Node
    file: File
    parent: Element | None
    inside: list[Element] = field(default_factory=list)

    @property
    def top(self) -> Element:
        """The declaration that it is in."""
        return self if self.parent is None else self.parent.top

    def walk(self) -> Iterator[Element]:
        """Yield the element and all inside it, in the order of the text."""
        yield self
        for inner in self.inside:
            yield from inner.walk()


class Elements:
    """The elements of the declarations that a page is about."""

    def __init__(self, pairs: Sequence[tuple[File, TopLevel]]) -> None:
        self.tops: list[Element] = []
        self.anchors: dict[str, Element] = {}
        self._of: dict[Node, Element] = {}
        names = Counter(_name(node) for _, node in pairs)
        for file, node in pairs:
            name = _name(node)
            # As in what is generated.
            path = f"{file.package.replace('.', '_')}_{name}" if names[name] > 1 else name
            self.tops.append(self._add(path, name, node, file, None))
        self._starts: dict[Source, list[int]] = {}
        self._in: dict[Source, list[Element]] = {}
        for element in sorted(self._of.values(), key=lambda each: each.node.span.start):
            source = element.node.span.source
            self._in.setdefault(source, []).append(element)
            self._starts.setdefault(source, []).append(element.node.span.start)

    def of(self, node: Node | None) -> Element | None:
        """The element that a node of the syntax tree is, None for one that has no anchor."""
        return self._of.get(node) if node is not None else None

    def at(self, span: Span | None) -> Element | None:
        """The innermost element around a place."""
        if span is None or span.source not in self._in:
            return None
        found = bisect_right(self._starts[span.source], span.start) - 1
        element = self._in[span.source][found] if found >= 0 else None
        while element is not None and element.node.span.end < span.end:
            element = element.parent
        return element

    def _add(self, path: str, name: str, node: Node, file: File, parent: Element | None) -> Element:
        anchor, number = path, 1
        while anchor in self.anchors:
            number += 1
            anchor = f"{path}~{number}"
        element = Element(anchor, path, name, _kind(node), node, file, parent)
        self.anchors[anchor] = self._of[node] = element
        for inner, prefix in _named(node):
            inner_name = str(inner.name)  # type: ignore[attr-defined]
            inside = self._add(f"{path}.{prefix}{inner_name}", inner_name, inner, file, element)
            element.inside.append(inside)
        return element


def _name(node: TopLevel) -> str:
    if isinstance(node, Optimization):
        # A keyword, so that no other element is called so.
        return f"optimize.{node.swarm.name.rpartition('.')[2]}"
    return str(node.name)  # type: ignore[attr-defined]


def _kind(node: Node) -> str:
    """What a person calls it, as precisely as the model says it."""
    match node:
        case Optimization():
            return "optimization"
        case Component(kind="virtual"):
            return "virtual component"
        case Component(kind=kind):
            return kind
        case Event(swarm=True):
            return "swarm event"
    return kind_name(node)


def _named(node: Node) -> Iterator[tuple[Node, str]]:
    """The elements directly inside a node, each with the part of an interface that it is in."""
    parts: dict[Node, str] = {
        field: f"{part}."
        for part in _PARTS.get(type(node), ())
        for field in getattr(node, part)
        if isinstance(field, Field)
    }
    for child in children(node):
        if type(child) in KINDS:
            yield child, parts.get(child, "")


class Places:
    """How files are called on a page: by their paths from the folder that all of the project is in.

    So a page does not say where on a disk it was made.
    """

    def __init__(self, files: Iterable[File]) -> None:
        folders = [
            str(Path(os.path.abspath(file.source.name)).parent)  # noqa: PTH100 - keeps links
            for file in files
            if not file.library
        ]
        self._root = Path(os.path.commonpath(folders)) if folders else Path.cwd()

    def file(self, file: File) -> str:
        """The name of a file."""
        path = Path(os.path.abspath(file.source.name))  # noqa: PTH100 - keeps links
        for root in (self._root, resources.library()):
            if path.is_relative_to(root):
                return path.relative_to(root).as_posix()
        return path.name

    def place(self, element: Element) -> str:
        """`file:line` of an element."""
        return f"{self.file(element.file)}:{element.node.span.line}"
