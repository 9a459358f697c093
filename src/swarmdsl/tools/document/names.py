"""The names in a model: text of it with links, and what uses what."""

from __future__ import annotations

import re
from bisect import bisect_left
from collections.abc import Iterator

from swarmdsl.analysis.resolve.scopes import Scopes
from swarmdsl.analysis.resolve.type_names import interface_name
from swarmdsl.base.source import Span
from swarmdsl.driver.workspace.references import occurrences
from swarmdsl.project.loader import File, Project
from swarmdsl.syntax.ast import Documented, Interface, Node, TopLevel, TypeRef, nodes_of
from swarmdsl.syntax.types import Array, Named, Type
from swarmdsl.tools.document.elements import Element, Elements
from swarmdsl.tools.document.page import Code, Piece

_COMMENT = re.compile(r'("(?:[^"\\\n]|\\[^\n])*")|//[^\n]*|/\*(?:[^*]|\*(?!/))*\*/')
_Link = tuple[int, int, Element]


class Names:
    """What the names in the documented declarations mean, looked up once for each of them."""

    def __init__(self, project: Project, elements: Elements) -> None:
        self.elements = elements
        self._scopes = Scopes(project)
        self._links: dict[TopLevel, list[_Link]] = {}
        self._by_type: dict[Named, Element] = {}
        for top in elements.tops:
            if isinstance(top.node, Interface):
                self._by_type.setdefault(interface_name(top.file, top.name), top)
        self._users = self._all_users()

    def users(self, element: Element) -> list[Element]:
        """What names an element, each once, in the order of the text."""
        return list(self._users.get(element, ()))

    def type(self, type_: Type | None) -> Element | None:
        """The interface that a type names, or the elements of it, if there is something on it."""
        element = type_.element if isinstance(type_, Array) else type_
        return self._by_type.get(element) if isinstance(element, Named) else None

    def code(self, span: Span, owner: Element) -> Code:
        """A piece of a declaration as it is written, without comments and on one line."""
        links = self._of(owner.top)
        pieces: list[Piece] = []
        at = span.start
        for start, end, target in links[bisect_left(links, span.start, key=lambda link: link[0]) :]:
            if start >= span.end:
                break
            pieces.append((span.source.text[at:start], None))
            pieces.append((span.source.text[start:end], target.anchor))
            at = end
        pieces.append((span.source.text[at : span.end], None))
        return Code(tuple(_on_one_line(pieces)))

    def head(self, owner: Element) -> Code:
        """How a declaration begins: all of it but what is in its braces."""
        span = owner.node.span
        # Braces in comments and texts begin nothing.
        end = _COMMENT.sub(lambda found: " " * len(found[0]), span.text).find("{")
        return self.code(
            Span(span.source, span.start, span.start + end) if end > 0 else span, owner
        )

    def _of(self, top: Element) -> list[_Link]:
        node = top.node
        assert isinstance(node, TopLevel)
        if node not in self._links:
            found = {start: (start, end, to) for start, end, to in self._found(node, top.file)}
            self._links[node] = sorted(found.values(), key=lambda link: link[0])
        return self._links[node]

    def _found(self, owner: TopLevel, file: File) -> Iterator[_Link]:
        # By their types first: ROS interfaces are known in files that do not import them.
        for ref in nodes_of(owner, TypeRef):
            named = self.type(ref.type)
            if named is not None:
                yield ref.span.start, ref.span.start + len(ref.name), named
        for each in occurrences(owner, self._scopes[file]):
            target = self.elements.of(each.node)
            if target is not None and not each.declares:
                yield each.span.start, each.span.end, target

    def _all_users(self) -> dict[Element, dict[Element, None]]:
        users: dict[Element, dict[Element, None]] = {}
        for top in self.elements.tops:
            source = top.node.span.source
            for start, end, target in self._of(top):
                user = self.elements.at(Span(source, start, end))
                if user is not None and user is not target:
                    users.setdefault(target, {})[user] = None
        return users


def doc_of(node: Node) -> str:
    """The documentation of a node, empty where there is none."""
    return node.doc if isinstance(node, Documented) else ""


def _on_one_line(pieces: list[Piece]) -> Iterator[Piece]:
    after_space = True
    for text, anchor in pieces:
        text = _COMMENT.sub(lambda found: found[1] or " ", text)
        # Space in a text in quotes is part of the value.
        text = "".join(
            part if part[:1] == '"' else re.sub(r"\s+", " ", part)
            for part in re.split(r'("(?:[^"\\\n]|\\[^\n])*")', text)
        )
        if after_space:
            text = text.lstrip(" ")
        if text:
            after_space = text.endswith(" ")
            yield text, anchor
