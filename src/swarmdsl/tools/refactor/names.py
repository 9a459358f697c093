"""What a model declares, by the paths that a person writes: `Uav.altitude`, `Search.Rise`."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from swarmdsl.analysis.node_kinds import KINDS, kind_of
from swarmdsl.base.records import dataclass
from swarmdsl.base.source import Span
from swarmdsl.base.suggest import closest
from swarmdsl.driver.workspace import Workspace
from swarmdsl.driver.workspace.references import owners
from swarmdsl.project.loader import File
from swarmdsl.syntax.ast import Node, Region, children


@dataclass(frozen=True, eq=False)
class Named:
    """Something that a file declares, and its path, in which regions do not count."""

    file: File
    node: Node
    path: tuple[str, ...]

    @property
    def place(self) -> Span:
        """Where its name stands."""
        span: Span = self.node.name.span.absolute  # type: ignore[attr-defined]
        return span

    def __str__(self) -> str:
        return f"{kind_of(self.node)} `{'.'.join(self.path)}`"


def all_named(workspace: Workspace, *, library: bool = False) -> Iterator[Named]:
    """All that the files of the project itself declare, or those of libraries."""
    for file in workspace.project.files:
        if file.library == library:
            for owner in owners(file):
                yield from _inside(file, owner, ())


def find(workspace: Workspace, name: str) -> list[Named]:
    """What a path means: exactly that, else what ends so; `package.Name` names a declaration."""
    words = tuple(name.split("."))
    every = list(all_named(workspace))
    exact = [each for each in every if each.path == words]
    if exact:
        return exact
    ending = [each for each in every if each.path[-len(words) :] == words]
    if ending:
        return ending
    return [each for each in every if (*each.file.package.split("."), *each.path) == words]


def similar(workspace: Workspace, name: str, kinds: type | tuple[type, ...] = Node) -> str | None:
    """The path of something that may be meant, and is of one of some kinds."""
    named = [each for each in all_named(workspace) if isinstance(each.node, kinds)]
    path = closest(name, [".".join(each.path) for each in named])
    if path is not None:
        return path
    last = closest(name.rpartition(".")[2], [each.path[-1] for each in named])
    return next((".".join(each.path) for each in named if each.path[-1] == last), None)


def _inside(file: File, node: Node, around: Sequence[str]) -> Iterator[Named]:
    path = (*around,)
    if type(node) in KINDS:
        own = (*around, str(node.name))  # type: ignore[attr-defined]
        yield Named(file, node, own)
        path = path if isinstance(node, Region) else own
    for child in children(node):
        yield from _inside(file, child, path)
