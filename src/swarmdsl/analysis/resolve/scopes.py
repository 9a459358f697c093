"""Which declaration a name means in a file.

A file sees what it declares itself and what the files it imports declare. Its own
declarations win; a name that two imported files declare must be qualified by a package.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, TypeVar

from swarmdsl.base.diagnostics.collector import Diagnostics, Label, listed
from swarmdsl.base.source import Span
from swarmdsl.base.suggest import closest
from swarmdsl.project.libraries import imported_name
from swarmdsl.project.loader import File, Project
from swarmdsl.syntax.ast import (
    ActionType,
    AliasType,
    Choice,
    Component,
    Constant,
    Declaration,
    EnumType,
    EnumValue,
    Environment,
    Event,
    Field,
    FinalState,
    Fitness,
    FitnessInput,
    Function,
    History,
    ImportLibrary,
    Member,
    MessageType,
    Node,
    Operation,
    Parallel,
    Param,
    Parameter,
    Part,
    Port,
    Region,
    Role,
    ServiceType,
    State,
    StateMachine,
    StructType,
    Swarm,
    Variable,
)

if TYPE_CHECKING:
    from swarmdsl.analysis.interfaces import Interfaces

D = TypeVar("D", bound=Declaration)

KINDS: dict[type[Node], str] = {
    StructType: "a struct",
    EnumType: "an enum",
    AliasType: "a type",
    Constant: "a constant",
    MessageType: "a message",
    ServiceType: "a service",
    ActionType: "an action",
    Event: "an event",
    Function: "a function",
    Component: "a component",
    Member: "a member",
    StateMachine: "a state machine",
    Swarm: "a swarm",
    Environment: "an environment",
    Fitness: "a fitness",
    FitnessInput: "an input",
    Operation: "an operation",
    Parameter: "a parameter",
    EnumValue: "a value",
    History: "a history",
    Role: "a role",
    Part: "a part",
    Port: "a port",
    Param: "a param",
    Field: "a field",
    Variable: "a variable",
    State: "a state",
    Parallel: "a parallel state",
    Region: "a region",
    Choice: "a choice",
    FinalState: "a final state",
}


def kind_of(node: Node | type[Node]) -> str:
    """What a person calls it, with an article: `a state machine`."""
    return KINDS[node if isinstance(node, type) else type(node)]


def bare(kind: str) -> str:
    """The same without the article."""
    return kind.split(" ", 1)[1]


def _kind_of_any(kinds: tuple[type[Node], ...]) -> str:
    """What a person calls something of one of these kinds: several are those of types or values."""
    if len(kinds) == 1:
        return kind_of(kinds[0])
    return "a value" if Constant in kinds else "a type"


class FileScope:
    """The declarations that one file sees."""

    def __init__(self, file: File, scopes: Scopes) -> None:
        self._known = scopes.known
        self._project = scopes.project
        self._package = file.package
        self.file = file
        self.own = scopes.declared(file)
        # What each import brings in, with the package that it is of.
        self._imported = [
            (other.package, _only(imported_name(statement), scopes.declared(other)))
            for statement, other in file.imports
        ]
        self.packages = {self._package, *(package for package, _ in self._imported)}
        # Whatever is missing may stand in text that could not be parsed or read.
        self.lost = file.parsed.lost_names.union(
            *(other.parsed.lost_names for _, other in file.imports)
        )
        found = {statement for statement, _ in file.imports}
        self.complete = all(statement in found for statement in file.model.imports)

    @property
    def interfaces(self) -> Interfaces:
        """Those of the whole project."""
        return self._known.interfaces

    def find(self, name: str) -> list[tuple[str, Declaration]]:
        """All declarations `name` could mean, the nearest only, each with its package."""
        if name in self.own:
            return [(self._package, self.own[name])]
        found = [(package, names[name]) for package, names in self._imported if name in names]
        if found or "." not in name:
            return found
        package, _, last = name.rpartition(".")
        return [
            (package, names[last])
            for of, names in [(self._package, self.own), *self._imported]
            if of == package and last in names
        ]

    def names(self, kind: type[Declaration]) -> list[str]:
        """The names of all declarations of this kind that the file sees."""
        seen = [self.own, *(names for _, names in self._imported)]
        return [name for names in seen for name, node in names.items() if isinstance(node, kind)]

    def one(self, name: str, kind: type[D]) -> D | None:
        """The one declaration of this kind that a name means, None when there is none."""
        found = [node for _, node in self.find(name) if isinstance(node, kind)]
        return found[0] if len(found) == 1 else None

    def resolve(
        self,
        name: str,
        at: Span,
        wanted: type[D] | tuple[type[D], ...],
        report: Diagnostics,
        *,
        built_in: Iterable[str] = (),
        instead: Mapping[type[Node], str] | None = None,
        way: Callable[[], str | None] | None = None,
    ) -> D | None:
        """Find the declaration a name means; None when there is none, which is reported.

        `built_in` are names that need no declaration: one of them may be meant. `instead` says
        what to do where something of another kind has the name.
        """
        found = self.find(name)
        if len(found) == 1 and isinstance(found[0][1], wanted):
            return found[0][1]
        kinds = wanted if isinstance(wanted, tuple) else (wanted,)
        # Of one package's declarations with this name only the first counts: the others
        # are reported where they stand.
        fitting: dict[str, D] = {}
        for package, node in found:
            if isinstance(node, kinds):
                fitting.setdefault(package, node)
        if len(fitting) == 1:
            return next(iter(fitting.values()))
        expected = _kind_of_any(kinds)
        if fitting:
            report.report(
                "ambiguous-name",
                at,
                name=name,
                related=tuple(Label(node.name.span, "declared here") for node in fitting.values()),
                help=f"write {listed([f'{package}.{name}' for package in fitting])}",
            )
        elif found and name.rpartition(".")[2] not in self.lost:
            report.report(
                "wrong-kind",
                at,
                name=name,
                actual=kind_of(found[0][1]),
                expected=expected,
                related=(Label(found[0][1].name.span, "declared here"),),
                help=(instead or {}).get(type(found[0][1])),
            )
        elif not found and self.complete:
            self._report_unresolved(name, at, kinds, built_in, report, way)
        return None

    def _report_unresolved(
        self,
        name: str,
        at: Span,
        kinds: tuple[type[D], ...],
        built_in: Iterable[str],
        report: Diagnostics,
        way: Callable[[], str | None] | None,
    ) -> None:
        if name.rpartition(".")[2] in self.lost:
            return
        kind = bare(_kind_of_any(kinds))
        if not report.wants_hint("unresolved-name"):
            report.report("unresolved-name", at, kind=kind, name=name)
            return
        elsewhere = next(
            (
                (file, node)
                for file, node in self._project.declarations()
                if node.name == name and isinstance(node, kinds)
            ),
            None,
        )
        if elsewhere is not None:
            file, node = elsewhere
            report.report(
                "unresolved-name",
                at,
                kind=kind,
                name=name,
                related=(Label(node.name.span, "declared in a file that is not imported"),),
                help=f"add `import {self._way_to(file, name)}`",
            )
            return
        names = {**self.own}
        for _, imported in self._imported:
            names.update(imported)
        candidates = [key for key, node in names.items() if isinstance(node, kinds)]
        package, _, _ = name.rpartition(".")
        if package in self.packages:
            candidates = [f"{package}.{key}" for key in candidates if self.find(f"{package}.{key}")]
            names = {key: self.find(key)[0][1] for key in candidates}
        if package:
            report_unresolved(kind, name, at, [*built_in, *candidates], names, report)
            return
        # Models that are right do not wait for it.
        from swarmdsl.analysis.resolve.missing_declaration import missing_import, missing_line

        line = missing_import(name, kinds, self._project)
        if line is not None:
            report.report("unresolved-name", at, kind=kind, name=name, help=f"add `{line}`")
            return

        def advice() -> str | None:
            return missing_line(name, kinds) or (way() if way is not None else None)

        report_unresolved(kind, name, at, [*built_in, *candidates], names, report, way=advice)

    def _way_to(self, other: File, name: str) -> str:
        """How this file imports what another file declares: that of a library by its package."""
        for file in self._project.files:
            for statement, target in file.imports:
                if target is other and isinstance(statement, ImportLibrary):
                    return f"{statement.name.rpartition('.')[0]}.{name}"
        if other.library:
            return f"{other.package}.{name}"
        way = os.path.relpath(other.source.name, Path(self.file.source.name).parent)
        return f'"{Path(way).as_posix()}"'


class _Known:
    """What all scopes of a project share; apart from them, so that they do not hold each other."""

    def __init__(self, project: Project) -> None:
        self._project = project

    @cached_property
    def interfaces(self) -> Interfaces:
        """The interfaces of the project; only what is said of mistakes asks for them."""
        from swarmdsl.analysis.interfaces import Interfaces

        return Interfaces(self._project.declarations())


class Scopes(dict[File, FileScope]):
    """The scopes of the files of a project, each made when it is first asked for."""

    def __init__(self, project: Project) -> None:
        super().__init__()
        self.project = project
        self.known = _Known(project)
        self._declared: dict[File, Mapping[str, Declaration]] = {}

    def __missing__(self, file: File) -> FileScope:
        self[file] = scope = FileScope(file, self)
        return scope

    def declared(self, file: File) -> Mapping[str, Declaration]:
        """What a file declares, by name; of two with one name the first counts."""
        if file not in self._declared:
            names: dict[str, Declaration] = {}
            for declaration in file.model.declarations:
                names.setdefault(str(declaration.name), declaration)
            self._declared[file] = names
        return self._declared[file]


def report_unresolved(
    kind: str,
    name: str,
    at: Span,
    candidates: Iterable[str],
    nodes: dict[str, Declaration] | None,
    report: Diagnostics,
    *,
    way: Callable[[], str | None] | None = None,
) -> None:
    """Report a name that means nothing, with the most similar one that would.

    `way` says what to do where none is similar.
    """
    close = closest(name, candidates) if report.wants_hint("unresolved-name") else None
    similar = nodes.get(close) if close and nodes else None
    advice = way() if way is not None and not close else None
    report.report(
        "unresolved-name",
        at,
        kind=kind,
        name=name,
        related=(Label(similar.name.span, "this has a similar name"),) if similar else (),
        help=f"did you mean `{close}`?" if close else advice,
    )


def _only(name: str | None, names: Mapping[str, Declaration]) -> Mapping[str, Declaration]:
    """All of the names, or the one that is given."""
    if name is None:
        return names
    return {name: names[name]} if name in names else {}
