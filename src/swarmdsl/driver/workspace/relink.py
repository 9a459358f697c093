"""Link fragments again and record their dependencies."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from swarmdsl.analysis.resolve.linker import Linker, machines_of
from swarmdsl.analysis.resolve.scopes import FileScope, Scopes
from swarmdsl.base.source import Source
from swarmdsl.driver.workspace.fragments import Fragment
from swarmdsl.project.loader import File, Project
from swarmdsl.syntax.action_messages import generated_from
from swarmdsl.syntax.ast import (
    Activity,
    Declaration,
    Fitness,
    Interface,
    NameUse,
    Node,
    Property,
    StateMachine,
    TopLevel,
    TypeRef,
    nodes_of,
    references,
)
from swarmdsl.syntax.types import Array, Named

Fragments = Mapping[Source, Fragment]
_NONE: frozenset[StateMachine] = frozenset()


class LookupRecord(set[Source]):
    """Sources of the looked-up declarations; `suppressed` if one may be unparsed."""

    suppressed = False


def link_outside(project: Project, fragments: Fragments, affected: set[Fragment]) -> Linking:
    """Resolve references of unlinked fragments to other declarations.

    Then, `newly_run` are machines of other fragments that a member runs now and did not before:
    the names visible in them changed.
    """
    linking = Linking(project, fragments)
    for fragment in affected:
        for owner in fragment.owners():
            linking.linker.link_outside(fragment.file, owner, fragment.outside)
        linking.record_lookups(fragment)
    for fragment in affected:
        runs = [machine for runner in fragment.runners() for machine in machines_of(runner)]
        fragment.runs = frozenset(runs) if runs else _NONE
        newly_run = {fragments[machine.span.source] for machine in fragment.runs}
        linking.newly_run |= newly_run - affected
    return linking


class Linking:
    """Second phase of linking, with the lookups recorded in the first."""

    def __init__(self, project: Project, fragments: Fragments) -> None:
        self._lookups = LookupRecord()
        self._scopes = _RecordingScopes(project, self._lookups)
        self._fragments = fragments
        self._lookups_of: dict[Fragment, set[Source]] = {}
        self.linker = Linker(project, self._scopes)
        self.newly_run: set[Fragment] = set()

    def record_lookups(self, fragment: Fragment) -> None:
        """Assign the recorded lookups to a fragment."""
        if self._lookups:
            self._lookups_of.setdefault(fragment, set()).update(self._lookups)
        fragment.suppressed |= self._lookups.suppressed
        self._lookups.clear()
        self._lookups.suppressed = False

    def link_inside(self, affected: set[Fragment]) -> None:
        """Resolve all other names in the fragments."""
        runners = _runners(self._fragments)
        machines = {machine for fragment in affected for machine in _machines(fragment)}
        self.linker.gather(
            runner
            for fragment in self._fragments.values()
            if not machines.isdisjoint(fragment.runs)
            for runner in fragment.runners()
        )
        for fragment in affected:
            for owner in fragment.owners():
                self.linker.link_inside(fragment.file, owner, fragment.inside)
            for machine in _machines(fragment):
                self._lookups.update(runner.source for runner in runners.get(machine, ()))
            self.record_lookups(fragment)

    def record_uses(self, affected: set[Fragment], interfaces: Mapping[Named, Interface]) -> None:
        """Record the dependencies of the fragments."""
        for fragment in affected:
            for owner in fragment.owners():
                for node in _targets(owner, fragment.file, self._scopes, interfaces):
                    self._lookups.add(node.span.source)
            self.record_lookups(fragment)
            used = (self._fragments.get(source) for source in self._lookups_of.pop(fragment, ()))
            fragment.use(each for each in used if each is not None)


def _machines(fragment: Fragment) -> Iterator[StateMachine]:
    for declaration in fragment.parsed.model.declarations:
        if isinstance(declaration, StateMachine):
            yield declaration


def _runners(fragments: Fragments) -> Mapping[StateMachine, set[Fragment]]:
    """Map machines to the fragments with members that run them."""
    found: dict[StateMachine, set[Fragment]] = {}
    for fragment in fragments.values():
        for machine in fragment.runs:
            found.setdefault(machine, set()).add(fragment)
    return found


def _targets(
    owner: TopLevel, file: File, scopes: Scopes, interfaces: Mapping[Named, Interface]
) -> Iterator[Node]:
    """Yield all nodes that names in a declaration resolve to."""
    for _, ref in references(owner):
        if ref.target is not None:
            yield ref.target
    for use in nodes_of(owner, NameUse):
        if use.target is not None:
            yield use.target
    if isinstance(owner, (Fitness, Property)) and owner.about is not None:
        yield owner.about
    for activity in nodes_of(owner, Activity):
        if activity.owner is not None:
            yield activity.owner
    for type_ in nodes_of(owner, TypeRef):
        # The resolved type does not show aliases.
        yield from (node for _, node in scopes[file].find(type_.name))
        element = type_.type.element if isinstance(type_.type, Array) else type_.type
        if isinstance(element, Named):
            behind = (element, *(made.action for made in generated_from(element)))
            yield from (interfaces[name] for name in behind if name in interfaces)


class _RecordingScope(FileScope):
    """Scope that records lookups."""

    def __init__(self, file: File, scopes: Scopes, seen: LookupRecord) -> None:
        super().__init__(file, scopes)
        self._lookups = seen
        self.skipped_names = _UnparsedNames(self.skipped_names, seen)

    def find(self, name: str) -> list[tuple[str, Declaration]]:
        """Return the nearest declarations of `name`, each with its package."""
        found = super().find(name)
        self._lookups.update(node.span.source for _, node in found)
        return found


class _UnparsedNames(frozenset[str]):
    """Names that may be declared in unparsed text; records positive lookups."""

    def __new__(cls, names: frozenset[str], seen: LookupRecord) -> _UnparsedNames:
        """Create it from names."""
        lost = super().__new__(cls, names)
        lost._lookups = seen
        return lost

    _lookups: LookupRecord

    def __contains__(self, name: object) -> bool:
        found = super().__contains__(name)
        self._lookups.suppressed |= found
        return found


class _RecordingScopes(Scopes):
    def __init__(self, project: Project, seen: LookupRecord) -> None:
        super().__init__(project)
        self._lookups = seen

    def __missing__(self, file: File) -> FileScope:
        self[file] = scope = _RecordingScope(file, self, self._lookups)
        return scope
