"""Scopes of files: the declarations that a name can mean.

A file sees its own declarations and those of the files it imports. Its own declarations win.
A name that two imported files declare must be qualified with a package.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from typing import TYPE_CHECKING, TypeVar

from swarmdsl.analysis.resolve.membership import MEMBER_EVENTS, member_events
from swarmdsl.base.diagnostics.collector import Label
from swarmdsl.base.records import dataclass
from swarmdsl.project.libraries import imported_name
from swarmdsl.project.loader import File, Project
from swarmdsl.syntax.ast import Declaration, Node

if TYPE_CHECKING:
    from swarmdsl.analysis.resolve.interfaces import Interfaces

D = TypeVar("D", bound=Declaration)


class Unresolved:
    """Result of `FileScope.resolve` for a name that means no declaration."""

    __slots__ = ()


@dataclass(frozen=True)
class Ambiguous(Unresolved):
    """Several packages declare the name: `candidates` by package."""

    candidates: Mapping[str, Declaration]


@dataclass(frozen=True)
class WrongKind(Unresolved):
    """The name means a declaration of another kind."""

    node: Declaration


@dataclass(frozen=True)
class Missing(Unresolved):
    """The file sees no declaration of the name."""


class FileScope:
    """Declarations that one file sees."""

    def __init__(self, file: File, scopes: Scopes) -> None:
        self._shared = scopes.shared
        self._package = file.package
        self.file = file
        self.project = scopes.project
        self.own = scopes.declared(file)
        # The names of each import, with the package of the imported file.
        self._imported = [
            (other.package, _only(imported_name(statement), scopes.declared(other)))
            for statement, other in file.imports
        ]
        self.packages = {self._package, *(package for package, _ in self._imported)}
        # A missing declaration may be in text that could not be parsed or read.
        self.skipped_names = file.parsed.skipped_names.union(
            *(other.parsed.skipped_names for _, other in file.imports)
        )
        # Hints for missing declarations, by name, kinds and built-in names: place and help.
        self.suggestions: dict[
            tuple[str, tuple[type[Node], ...], tuple[str, ...]],
            tuple[tuple[Label, ...], str | None],
        ] = {}
        found = {statement for statement, _ in file.imports}
        self.imports_resolved = all(statement in found for statement in file.model.imports)

    @property
    def interfaces(self) -> Interfaces:
        """Interfaces of the whole project."""
        return self._shared.interfaces

    def find(self, name: str) -> list[tuple[str, Declaration]]:
        """Return the nearest declarations that `name` can mean, each with its package."""
        if name in self.own:
            return [(self._package, self.own[name])]
        found = [(package, names[name]) for package, names in self._imported if name in names]
        if found:
            return found
        if name in MEMBER_EVENTS:
            file, events = member_events()
            return [(file.package, events[name])]
        if "." not in name:
            return found
        package, _, last = name.rpartition(".")
        return [
            (package, names[last])
            for of, names in [(self._package, self.own), *self._imported]
            if of == package and last in names
        ]

    def names(self, kind: type[Node]) -> list[str]:
        """Return the names of all visible declarations of a kind."""
        seen = [self.own, *(names for _, names in self._imported)]
        return [name for names in seen for name, node in names.items() if isinstance(node, kind)]

    def visible(self) -> dict[str, Declaration]:
        """Return all visible declarations by their names without packages."""
        names = {**self.own}
        for _, imported in self._imported:
            names.update(imported)
        return names

    def one(self, name: str, kind: type[D]) -> D | None:
        """Return the only declaration of this kind that a name means, None if there is none."""
        found = [node for _, node in self.find(name) if isinstance(node, kind)]
        return found[0] if len(found) == 1 else None

    def resolve(self, name: str, kinds: type[D] | tuple[type[D], ...]) -> D | Unresolved:
        """Return the declaration of one of these kinds that a name means, or why there is none."""
        found = self.find(name)
        if len(found) == 1 and isinstance(found[0][1], kinds):
            return found[0][1]
        # Repeated declarations in one package are reported there; the first one counts.
        candidates: dict[str, D] = {}
        for package, node in found:
            if isinstance(node, kinds):
                candidates.setdefault(package, node)
        if len(candidates) == 1:
            return next(iter(candidates.values()))
        if candidates:
            return Ambiguous(candidates)
        return WrongKind(found[0][1]) if found else Missing()


class SharedScopes:
    """Data that all scopes of a project share, in an object of its own to avoid a cycle."""

    def __init__(self, project: Project) -> None:
        self._project = project

    @cached_property
    def interfaces(self) -> Interfaces:
        """Interfaces of the project; only hints need them."""
        from swarmdsl.analysis.resolve.interfaces import Interfaces

        return Interfaces(self._project.declarations())


class Scopes(dict[File, FileScope]):
    """Scopes of the files of a project, created on first use."""

    def __init__(self, project: Project) -> None:
        super().__init__()
        self.project = project
        self.shared = SharedScopes(project)
        self._declared: dict[File, Mapping[str, Declaration]] = {}

    def __missing__(self, file: File) -> FileScope:
        self[file] = scope = FileScope(file, self)
        return scope

    def declared(self, file: File) -> Mapping[str, Declaration]:
        """Return the declarations of a file by name. The first of a repeated name counts."""
        if file not in self._declared:
            names: dict[str, Declaration] = {}
            for declaration in file.model.declarations:
                names.setdefault(str(declaration.name), declaration)
            self._declared[file] = names
        return self._declared[file]


def _only(name: str | None, names: Mapping[str, Declaration]) -> Mapping[str, Declaration]:
    """Restrict names to the given one; None keeps all."""
    if name is None:
        return names
    return {name: names[name]} if name in names else {}
