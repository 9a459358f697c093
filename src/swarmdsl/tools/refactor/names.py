"""Find declared elements by qualified name: `Uav.altitude`, `Search.Rise`, `Dive.goal.depth`."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from swarmdsl.analysis.node_kinds import KINDS, kind_of
from swarmdsl.base.records import dataclass
from swarmdsl.base.source import Span
from swarmdsl.base.suggest import closest
from swarmdsl.driver.workspace import Workspace
from swarmdsl.driver.workspace.field_references import part_with
from swarmdsl.driver.workspace.references import owners
from swarmdsl.project.loader import File
from swarmdsl.syntax.ast import Field, Node, Region, children, name_of


@dataclass(frozen=True, eq=False)
class NamedElement:
    """Declared element and its qualified name, which leaves regions out."""

    file: File
    node: Node
    path: tuple[str, ...]

    @property
    def name_span(self) -> Span:
        """Span of the name in the declaration."""
        return name_of(self.node).span.absolute

    def __str__(self) -> str:
        return f"{kind_of(self.node)} `{'.'.join(self.path)}`"


def all_elements(workspace: Workspace, *, library: bool = False) -> Iterator[NamedElement]:
    """Yield the declared elements of the project, or with `library` of libraries."""
    for file in workspace.project.files:
        if file.library == library:
            for owner in owners(file):
                yield from _elements_in(file, owner, ())


def find_elements(workspace: Workspace, name: str, *, library: bool = False) -> list[NamedElement]:
    """Find the elements of the project, or with `library` of libraries, with a qualified name.

    An exact match wins over a suffix; `package.Name` finds a declaration.
    """
    words = tuple(name.split("."))
    every = list(all_elements(workspace, library=library))
    exact = [each for each in every if each.path == words]
    if exact:
        return exact
    suffixed = [each for each in every if each.path[-len(words) :] == words]
    if suffixed:
        return suffixed
    return [each for each in every if (*each.file.package.split("."), *each.path) == words]


def suggest_path(
    workspace: Workspace, name: str, kinds: type | tuple[type, ...] = Node
) -> str | None:
    """Suggest the qualified name of a similarly named element of the given kinds."""
    elements = [each for each in all_elements(workspace) if isinstance(each.node, kinds)]
    path = closest(name, [".".join(each.path) for each in elements])
    if path is not None:
        return path
    last = closest(name.rpartition(".")[2], [each.path[-1] for each in elements])
    return next((".".join(each.path) for each in elements if each.path[-1] == last), None)


def _elements_in(file: File, node: Node, around: Sequence[str]) -> Iterator[NamedElement]:
    path = (*around,)
    if type(node) in KINDS:
        own = (*around, str(name_of(node)))
        yield NamedElement(file, node, own)
        path = path if isinstance(node, Region) else own
    for child in children(node):
        part = part_with(child, node) if isinstance(child, Field) else ""
        yield from _elements_in(file, child, (*path, part) if part else path)
