"""Find the fragments that an edit invalidates."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Collection, Iterable, Iterator

from swarmdsl.analysis.resolve.type_names import interface_name
from swarmdsl.base.records import dataclass, field
from swarmdsl.base.source import Source
from swarmdsl.driver.workspace.documents import Document
from swarmdsl.driver.workspace.fragments import Fragment, with_users
from swarmdsl.project.loader import File, Project
from swarmdsl.project.rosidl import standard
from swarmdsl.syntax.action_messages import generated_names
from swarmdsl.syntax.ast import (
    ActionType,
    Component,
    Declaration,
    Environment,
    Fitness,
    Interface,
    Property,
    Sight,
    SpaceMeasure,
    Swarm,
    nodes_of,
)


@dataclass
class Change:
    """Effects of an edit.

    `removed` and `new` are fragments. `names` are those that may resolve differently now. `stale`
    are the fragments in which any name may; `everything` stands for all fragments.
    `unparsed_changed` is set if the names in unparsed text may have changed.
    """

    removed: list[Fragment] = field(default_factory=list)
    new: list[Fragment] = field(default_factory=list)
    names: set[str] = field(default_factory=set)
    stale: set[Fragment] = field(default_factory=set)
    everything: bool = False
    unparsed_changed: bool = False

    @property
    def imports_changed(self) -> bool:
        """True if packages or imports changed."""
        return bool(self.stale or self.everything)

    @property
    def declarations_changed(self) -> bool:
        """True if names or imports changed, not only the bodies of declarations."""
        return bool(self.names or self.stale or self.everything or self.unparsed_changed)

    def replace(self, document: Document, source: Source) -> None:
        """Replace the content of a document."""
        file = document.file
        package, lost = file.package, file.parsed.skipped_names
        removed, new = document.replace(source)
        self.removed += removed
        self.new += new
        self.unparsed_changed |= lost != file.parsed.skipped_names
        names, others = Counter(_names(removed)), Counter(_names(new))
        self.names |= {name for _, name in (names - others) + (others - names)}
        if package != file.package:
            self.names |= {name for _, name in _names([*removed, *document.fragments])}
        if any(fragment.has_package_or_imports for fragment in (*removed, *new)):
            self.stale |= set(document.fragments)

    def add(self, document: Document) -> None:
        """Add a document."""
        self.new += document.fragments
        self._all_names(document)

    def remove(self, document: Document) -> None:
        """Remove a document."""
        self.removed += document.fragments
        self._all_names(document)

    def _all_names(self, document: Document) -> None:
        self.names |= {name for _, name in _names(document.fragments)}
        self.unparsed_changed = True
        self.everything |= document.interface is not None


def affected(
    change: Change, fragments: Collection[Fragment], noted: Iterable[Fragment]
) -> set[Fragment]:
    """Return the fragments to link and check again.

    `noted` are the fragments with reported or suppressed diagnostics.
    """
    if change.everything or _has_standard_interface([*change.removed, *change.new]):
        return set(fragments)
    found = {*change.removed, *change.new, *change.stale}
    if change.declarations_changed:
        # Diagnostics of unresolved names depend on all names.
        found.update(noted)
    if change.declarations_changed or any(_has(Swarm, each) for each in found):
        # The subject of a property or fitness that names none depends on all declarations, that of
        # a fitness also on the swarms that have it.
        found.update(each for each in fragments if _names_no_subject(each))
    if change.declarations_changed or any(_has(Environment, each) for each in found):
        # What a sensor finds is in any environment.
        found.update(each for each in fragments if _names_targets(each))
    if change.names:
        found.update(_containing(change.names, fragments))
    return with_users(found).intersection(fragments)


def _names_no_subject(fragment: Fragment) -> bool:
    """Return True if a property or fitness in a fragment does not say what it is about."""
    return any(
        isinstance(each, (Fitness, Property)) and each.subject is None
        for each in fragment.parsed.model.declarations
    )


def _has(kind: type[Declaration], fragment: Fragment) -> bool:
    return any(isinstance(each, kind) for each in fragment.parsed.model.declarations)


def _names_targets(fragment: Fragment) -> bool:
    return any(
        nodes_of(each, SpaceMeasure if isinstance(each, Fitness) else Sight)
        for each in fragment.parsed.model.declarations
        if isinstance(each, (Component, Fitness))
    )


def _containing(names: Collection[str], fragments: Iterable[Fragment]) -> Iterator[Fragment]:
    """Yield the fragments that contain one of the names."""
    pattern = re.compile(rf"\b(?:{'|'.join(map(re.escape, names))})\b")
    for fragment in fragments:
        text = fragment.source.text
        if any(name in text for name in names) and pattern.search(text):
            yield fragment


def _names(fragments: Iterable[Fragment]) -> Iterable[tuple[type, str]]:
    """Yield kinds and names of declarations; without package for ROS interfaces.

    An action also declares the messages that ROS generates from it.
    """
    for fragment in fragments:
        for declaration in fragment.parsed.model.declarations:
            name = declaration.name.rpartition("/")[2]
            yield type(declaration), name
            if isinstance(declaration, ActionType):
                yield from ((ActionType, made) for made in generated_names(name))


def _has_standard_interface(fragments: Iterable[Fragment]) -> bool:
    """Return True for standard ROS interfaces, which are used without being named."""
    return any(
        interface_name(fragment.file, declaration.name).package in standard.packages()
        for fragment in fragments
        for declaration in fragment.parsed.model.declarations
        if isinstance(declaration, Interface)
    )


def ambiguous_interfaces(project: Project) -> set[str]:
    """Return the names of interfaces with several declarations; the first file wins."""
    count = Counter(
        interface_name(file, declaration.name)
        for file, declaration in project.declarations()
        if isinstance(declaration, Interface)
    )
    return {name.name for name, times in count.items() if times > 1}


def packages(project: Project) -> set[str]:
    """Return the packages of all interfaces."""
    return {
        interface_name(file, declaration.name).package
        for file, declaration in project.declarations()
        if isinstance(declaration, Interface)
    }


def visible_names(file: File) -> object:
    """Return a key of the names visible in a file, apart from its own declarations."""
    imported = {statement for statement, _ in file.imports}
    return (
        file.library,
        [(str(statement.span.text), target) for statement, target in file.imports],
        [statement in imported for statement in file.model.imports],
    )
