"""Resolve the names in a model: linked source text, and users of elements."""

from __future__ import annotations

import re
from bisect import bisect_left
from collections.abc import Iterator

from swarmdsl.analysis.resolve.scopes import Scopes
from swarmdsl.analysis.resolve.type_names import interface_name
from swarmdsl.base.source import Span
from swarmdsl.driver.workspace.references import occurrences
from swarmdsl.project.loader import File, Project
from swarmdsl.syntax.ast import (
    Branch,
    Documented,
    History,
    Initial,
    Interface,
    Node,
    StateMachine,
    TopLevel,
    Transition,
    TypeRef,
    nodes_of,
)
from swarmdsl.syntax.types import Array, Named, Type
from swarmdsl.tools.document.elements import Element, Elements
from swarmdsl.tools.document.page import Code, Fragment

_COMMENT = re.compile(r'("(?:[^"\\\n]|\\[^\n])*")|//[^\n]*|/\*(?:[^*]|\*(?!/))*\*/')
_Link = tuple[int, int, Element]


class NameResolver:
    """References in the documented declarations, resolved once per declaration."""

    def __init__(self, project: Project, elements: Elements) -> None:
        self.elements = elements
        self._scopes = Scopes(project)
        self._links: dict[TopLevel, list[_Link]] = {}
        self._by_type: dict[Named, Element] = {}
        for top in elements.tops:
            if isinstance(top.node, Interface):
                self._by_type.setdefault(interface_name(top.file, top.name), top)
        self._users: dict[Element, dict[Element, None]] = {}
        self._sources: dict[Element, dict[Element, None]] = {}
        self._find_users()

    def users(self, element: Element) -> list[Element]:
        """Elements that refer to an element, without duplicates, in source order."""
        return list(self._users.get(element, ()))

    def sources(self, state: Element) -> list[Element]:
        """Elements from which a transition, a branch or an initial state leads to a state."""
        return list(self._sources.get(state, ()))

    def type(self, type_: Type | None) -> Element | None:
        """Element of the interface that a type or its array element names, if documented."""
        element = type_.element if isinstance(type_, Array) else type_
        return self._by_type.get(element) if isinstance(element, Named) else None

    def code(self, span: Span, owner: Element) -> Code:
        """Source text of a span with links, without comments and on one line."""
        links = self._links_of(owner.top)
        pieces: list[Fragment] = []
        at = span.start
        for start, end, target in links[bisect_left(links, span.start, key=lambda link: link[0]) :]:
            if start >= span.end:
                break
            pieces.append((span.source.text[at:start], None))
            pieces.append((span.source.text[start:end], target.anchor))
            at = end
        pieces.append((span.source.text[at : span.end], None))
        return Code(tuple(_single_line(pieces)))

    def head(self, owner: Element) -> Code:
        """Return the declaration up to its opening brace."""
        span = owner.node.span
        # Ignore braces in comments and strings.
        end = _COMMENT.sub(lambda found: " " * len(found[0]), span.text).find("{")
        return self.code(
            Span(span.source, span.start, span.start + end) if end > 0 else span, owner
        )

    def _links_of(self, top: Element) -> list[_Link]:
        node = top.node
        assert isinstance(node, TopLevel)
        if node not in self._links:
            found = {start: (start, end, to) for start, end, to in self._find_links(node, top.file)}
            self._links[node] = sorted(found.values(), key=lambda link: link[0])
        return self._links[node]

    def _find_links(self, owner: TopLevel, file: File) -> Iterator[_Link]:
        # Resolve types first: ROS interfaces are known in files that do not import them.
        for ref in nodes_of(owner, TypeRef):
            named = self.type(ref.type)
            if named is not None:
                yield ref.span.start, ref.span.start + len(ref.name), named
        for each in occurrences(owner, self._scopes[file]):
            target = self.elements.of(each.node)
            if target is not None and not each.declares:
                yield each.span.start, each.span.end, target

    def _find_users(self) -> None:
        for top in self.elements.tops:
            source = top.node.span.source
            targets = {at for place in _targets(top.node) for at in range(place.start, place.end)}
            for start, end, target in self._links_of(top):
                user = self.elements.at(Span(source, start, end))
                if user is not None and user is not target:
                    self._users.setdefault(target, {})[user] = None
                    if start in targets:
                        self._sources.setdefault(target, {})[user] = None


def _targets(node: Node) -> Iterator[Span]:
    """Yield the places in a declaration that name a state to go to."""
    if not isinstance(node, StateMachine):
        return
    ways: list[Transition | Branch | Initial | History] = [*nodes_of(node, Transition)]
    ways += nodes_of(node, Branch)
    ways += nodes_of(node, Initial)
    ways += nodes_of(node, History)
    yield from (way.target.span for way in ways if way.target is not None)


def doc_of(node: Node) -> str:
    """Documentation of a node, or an empty string."""
    return node.doc if isinstance(node, Documented) else ""


def _single_line(pieces: list[Fragment]) -> Iterator[Fragment]:
    after_space = True
    for text, anchor in pieces:
        text = _COMMENT.sub(lambda found: found[1] or " ", text)
        # Keep spaces inside string literals.
        text = "".join(
            part if part[:1] == '"' else re.sub(r"\s+", " ", part)
            for part in re.split(r'("(?:[^"\\\n]|\\[^\n])*")', text)
        )
        if after_space:
            text = text.lstrip(" ")
        if text:
            after_space = text.endswith(" ")
            yield text, anchor
