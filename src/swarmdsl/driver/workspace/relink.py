"""Links some units anew, and learns which others they use."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from swarmdsl.analysis.resolve.linker import Linker, machines_of
from swarmdsl.analysis.resolve.scopes import FileScope, Scopes
from swarmdsl.base.source import Source
from swarmdsl.driver.workspace.fragments import Unit
from swarmdsl.project.loader import File, Project
from swarmdsl.syntax.action_messages import generated_from
from swarmdsl.syntax.ast import (
    Activity,
    Declaration,
    Interface,
    NameUse,
    Node,
    StateMachine,
    TopLevel,
    TypeRef,
    nodes_of,
    references,
)
from swarmdsl.syntax.types import Array, Named

Units = Mapping[Source, Unit]
_NONE: frozenset[StateMachine] = frozenset()


class Seen(set[Source]):
    """Where stands what was looked up, and whether a name counted as possibly declared."""

    hushed = False


def link_outside(project: Project, units: Units, affected: set[Unit]) -> Linking:
    """Resolve what the affected units name of others; none of them is linked yet.

    Afterwards `driven` are machines in other units that a member runs now and did not before:
    what these may name is not the same.
    """
    linking = Linking(project, units)
    for unit in affected:
        for owner in unit.owners():
            linking.linker.link_outside(unit.file, owner, unit.outside)
        linking.take_seen(unit)
    for unit in affected:
        runs = [machine for runner in unit.runners() for machine in machines_of(runner)]
        unit.runs = frozenset(runs) if runs else _NONE
        driven = {units[machine.span.source] for machine in unit.runs}
        linking.driven |= driven - affected
    return linking


class Linking:
    """The second half, and what was seen in the first."""

    def __init__(self, project: Project, units: Units) -> None:
        self._seen = Seen()
        self._scopes = _WatchedScopes(project, self._seen)
        self._units = units
        self._seen_by: dict[Unit, set[Source]] = {}
        self.linker = Linker(project, self._scopes)
        self.driven: set[Unit] = set()

    def take_seen(self, unit: Unit) -> None:
        """Take what was seen since for what a unit has seen."""
        if self._seen:
            self._seen_by.setdefault(unit, set()).update(self._seen)
        unit.hushed |= self._seen.hushed
        self._seen.clear()
        self._seen.hushed = False

    def link_inside(self, affected: set[Unit]) -> None:
        """Resolve all other names in the units."""
        runners = _runners(self._units)
        machines = {machine for unit in affected for machine in _machines(unit)}
        self.linker.gather(
            runner
            for unit in self._units.values()
            if not machines.isdisjoint(unit.runs)
            for runner in unit.runners()
        )
        for unit in affected:
            for owner in unit.owners():
                self.linker.link_inside(unit.file, owner, unit.inside)
            for machine in _machines(unit):
                self._seen.update(runner.source for runner in runners.get(machine, ()))
            self.take_seen(unit)

    def learn_uses(self, affected: set[Unit], interfaces: Mapping[Named, Interface]) -> None:
        """Note what the units use."""
        for unit in affected:
            for owner in unit.owners():
                for node in _targets(owner, unit.file, self._scopes, interfaces):
                    self._seen.add(node.span.source)
            self.take_seen(unit)
            used = (self._units.get(source) for source in self._seen_by.pop(unit, ()))
            unit.use(each for each in used if each is not None)


def _machines(unit: Unit) -> Iterator[StateMachine]:
    for declaration in unit.parsed.model.declarations:
        if isinstance(declaration, StateMachine):
            yield declaration


def _runners(units: Units) -> Mapping[StateMachine, set[Unit]]:
    """The units with members that run a machine."""
    found: dict[StateMachine, set[Unit]] = {}
    for unit in units.values():
        for machine in unit.runs:
            found.setdefault(machine, set()).add(unit)
    return found


def _targets(
    owner: TopLevel, file: File, scopes: Scopes, interfaces: Mapping[Named, Interface]
) -> Iterator[Node]:
    """All that the names in a declaration lead to."""
    for _, ref in references(owner):
        if ref.target is not None:
            yield ref.target
    for use in nodes_of(owner, NameUse):
        if use.target is not None:
            yield use.target
    for activity in nodes_of(owner, Activity):
        if activity.owner is not None:
            yield activity.owner
    for type_ in nodes_of(owner, TypeRef):
        # An alias on the way leaves no trace in the type.
        yield from (node for _, node in scopes[file].find(type_.name))
        element = type_.type.element if isinstance(type_.type, Array) else type_.type
        if isinstance(element, Named):
            behind = (element, *(made.action for made in generated_from(element)))
            yield from (interfaces[name] for name in behind if name in interfaces)


class _WatchedScope(FileScope):
    """A scope that remembers where what was looked up in it stands."""

    def __init__(self, file: File, scopes: Scopes, seen: Seen) -> None:
        super().__init__(file, scopes)
        self._seen = seen
        self.skipped_names = _Lost(self.skipped_names, seen)

    def find(self, name: str) -> list[tuple[str, Declaration]]:
        """All declarations `name` could mean, the nearest only, each with its package."""
        found = super().find(name)
        self._seen.update(node.span.source for _, node in found)
        return found


class _Lost(frozenset[str]):
    """Names that may be declared in what could not be read; remembers that one was asked for."""

    def __new__(cls, names: frozenset[str], seen: Seen) -> _Lost:
        """Make them of names."""
        lost = super().__new__(cls, names)
        lost._seen = seen
        return lost

    _seen: Seen

    def __contains__(self, name: object) -> bool:
        found = super().__contains__(name)
        self._seen.hushed |= found
        return found


class _WatchedScopes(Scopes):
    def __init__(self, project: Project, seen: Seen) -> None:
        super().__init__(project)
        self._seen = seen

    def __missing__(self, file: File) -> FileScope:
        self[file] = scope = _WatchedScope(file, self, self._seen)
        return scope
