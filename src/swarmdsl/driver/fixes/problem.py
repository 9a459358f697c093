"""A diagnostic with its place in the tree, and the fixes that can be made there."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import cached_property
from pathlib import Path
from typing import TypeVar

from swarmdsl.analysis.resolve.interfaces import Interfaces
from swarmdsl.base.diagnostics.collector import Diagnostic, Fix
from swarmdsl.base.records import dataclass
from swarmdsl.base.source import Source, Span
from swarmdsl.driver.workspace import Workspace
from swarmdsl.driver.workspace.references import owner_at, owners
from swarmdsl.project.loader import File
from swarmdsl.syntax.ast import EnumType, Node, TypeRef, Word, nodes_of, walk
from swarmdsl.syntax.types import BOOL, DURATION, FLOATS, INTEGERS, STRING, Named, Primitive

N = TypeVar("N", bound=Node)


@dataclass(eq=False)
class Problem:
    """Diagnostic in a file of a workspace."""

    found: Diagnostic
    workspace: Workspace
    file: File
    span: Span

    @property
    def source(self) -> Source:
        """The file, as it is shown."""
        return self.span.source

    @property
    def text(self) -> str:
        """Text of the file."""
        return self.source.text

    def part(self, start: int, end: int) -> Span:
        """Return a span of the file."""
        return Span(self.source, start, end)

    def inside(self, text: str) -> Span | None:
        """Return the first place of a text in the span of the diagnostic."""
        at = self.span.text.find(text)
        return (
            self.part(self.span.start + at, self.span.start + at + len(text)) if at >= 0 else None
        )

    def around(self, *kinds: type[N]) -> N | None:
        """Return the innermost node of these kinds around the place."""
        owner = owner_at(self.file, self.span.start)
        best: N | None = None
        for node in walk(owner) if owner is not None else ():
            span = node.span.absolute
            if (
                isinstance(node, kinds)
                and span.start <= self.span.start
                and self.span.end <= span.end
            ):
                best = node
        return best

    def declared(self, name: Span) -> Node | None:
        """Return the node with a name at a place of the model."""
        place = name.absolute
        path = place.source.path
        file = self.workspace.file(path) if isinstance(path, Path) else None
        owner = owner_at(file, place.start) if file is not None else None
        for node in walk(owner) if owner is not None else ():
            word = getattr(node, "name", None)
            if isinstance(word, Word) and word.span.absolute == place:
                return node
        return None

    def named(self, name: str, *kinds: type[N]) -> N | None:
        """Return the first node of these kinds with a name: first in the file, then in others."""
        for node in self.every(*kinds):
            if getattr(node, "name", None) == name:
                return node
        return None

    def every(self, *kinds: type[N]) -> Iterator[N]:
        """Yield the nodes of these kinds, first those of the same file."""
        files = [each for each in self.workspace.project.files if not each.library]
        for file in sorted(files, key=lambda each: each is not self.file):
            for owner in owners(file):
                for kind in kinds:
                    yield from nodes_of(owner, kind)

    @cached_property
    def interfaces(self) -> Interfaces:
        """Interfaces of the model."""
        return Interfaces(self.workspace.project.declarations())

    def zero(self, ref: TypeRef) -> str | None:
        """Return the zero of a type as it is written; None if it has none that can be written."""
        type_ = ref.type
        if ref.unit is not None:
            return f"0 {ref.unit}"
        if isinstance(type_, Named):
            declared = self.interfaces.declared.get(type_)
            if isinstance(declared, EnumType) and declared.values:
                return f"{ref.name}.{declared.values[0].name}"
            return None
        if type_ == DURATION:
            return "0 s"
        if type_ == BOOL:
            return "false"
        if type_ == STRING:
            return '""'
        if isinstance(type_, Primitive) and type_.name in FLOATS:
            return "0.0"
        if isinstance(type_, Primitive) and type_.name in INTEGERS:
            return "0"
        return None


Act = Callable[..., Iterator[Fix]]
"""Makes the fixes of a problem from the arguments of its advice."""

Rules = dict[str, Act]
"""Acts by the names that advice gives them."""


def proposed(problem: Problem, text: str) -> Iterator[Fix]:
    """Yield one of several texts that can stand at the place."""
    yield replacing(problem.span, text)


def replacing(span: Span, text: str, *, safe: bool = False, title: str = "") -> Fix:
    """Return the fix that replaces a span."""
    return Fix(title or f"Change to `{text}`", ((span, text),), safe)


def inserting(at: Span, text: str, shown: str = "", *, safe: bool = False) -> Fix:
    """Return the fix that inserts a text at the end of a span."""
    end = Span(at.source, at.end, at.end)
    return Fix(f"Add `{(shown or text).strip()}`", ((end, text),), safe)
