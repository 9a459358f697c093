"""What an edit changes, and which units it has an effect on."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Collection, Iterable, Iterator

from swarmdsl.analysis.resolve.type_names import interface_name
from swarmdsl.base.records import dataclass, field
from swarmdsl.base.source import Source
from swarmdsl.driver.workspace.documents import Sheet
from swarmdsl.driver.workspace.fragments import Unit, with_users
from swarmdsl.project.loader import File, Project
from swarmdsl.project.rosidl import standard
from swarmdsl.syntax.action_messages import generated_names
from swarmdsl.syntax.ast import ActionType, Interface


@dataclass
class Change:
    """What was edited.

    `gone` and `new` are units; `words` the names that may mean something else now, or
    something for the first time, or nothing; `stale` the units in which any name may, and
    `everything` says that it is so in all. `lost` says that other names may be declared in what
    could not be read.
    """

    gone: list[Unit] = field(default_factory=list)
    new: list[Unit] = field(default_factory=list)
    words: set[str] = field(default_factory=set)
    stale: set[Unit] = field(default_factory=set)
    everything: bool = False
    lost: bool = False

    @property
    def heads(self) -> bool:
        """Whether packages or imports changed."""
        return bool(self.stale or self.everything)

    @property
    def shape(self) -> bool:
        """Whether names or imports changed, and not only what is inside of declarations."""
        return bool(self.words or self.stale or self.everything or self.lost)

    def replace(self, sheet: Sheet, source: Source) -> None:
        """Give a file another text."""
        file = sheet.file
        package, lost = file.package, file.parsed.skipped_names
        gone, new = sheet.replace(source)
        self.gone += gone
        self.new += new
        self.lost |= lost != file.parsed.skipped_names
        names, others = Counter(_names(gone)), Counter(_names(new))
        self.words |= {name for _, name in (names - others) + (others - names)}
        if package != file.package:
            self.words |= {name for _, name in _names([*gone, *sheet.units])}
        if any(unit.has_head for unit in (*gone, *new)):
            self.stale |= set(sheet.units)

    def come(self, sheet: Sheet) -> None:
        """Take in a file that was not there."""
        self.new += sheet.units
        self._all_words(sheet)

    def go(self, sheet: Sheet) -> None:
        """Give up a file."""
        self.gone += sheet.units
        self._all_words(sheet)

    def _all_words(self, sheet: Sheet) -> None:
        self.words |= {name for _, name in _names(sheet.units)}
        self.lost = True
        self.everything |= sheet.interface is not None


def affected(change: Change, units: Collection[Unit], noted: Iterable[Unit]) -> set[Unit]:
    """Those of the units that must be linked and checked again.

    `noted` are those of which something was reported, or might have been.
    """
    if change.everything or _is_standard([*change.gone, *change.new]):
        return set(units)
    found = {*change.gone, *change.new, *change.stale}
    if change.shape:
        # What was said of a name that means nothing depends on all names there are.
        found.update(noted)
    if change.words:
        found.update(_mentioning(change.words, units))
    return with_users(found).intersection(units)


def _mentioning(words: Collection[str], units: Iterable[Unit]) -> Iterator[Unit]:
    """The units in which one of the words stands."""
    pattern = re.compile(rf"\b(?:{'|'.join(map(re.escape, words))})\b")
    for unit in units:
        text = unit.source.text
        if any(word in text for word in words) and pattern.search(text):
            yield unit


def _names(units: Iterable[Unit]) -> Iterable[tuple[type, str]]:
    """The kinds and names of declarations; those of ROS interfaces without the package.

    With an action come the messages that ROS makes of it.
    """
    for unit in units:
        for declaration in unit.parsed.model.declarations:
            name = declaration.name.rpartition("/")[2]
            yield type(declaration), name
            if isinstance(declaration, ActionType):
                yield from ((ActionType, made) for made in generated_names(name))


def _is_standard(units: Iterable[Unit]) -> bool:
    """Whether an interface is one that those of ROS are made of: nobody needs to name it."""
    return any(
        interface_name(unit.file, declaration.name).package in standard.packages()
        for unit in units
        for declaration in unit.parsed.model.declarations
        if isinstance(declaration, Interface)
    )


def declared_twice(project: Project) -> set[str]:
    """The names of interfaces of which there are several: that in the first file counts."""
    count = Counter(
        interface_name(file, declaration.name)
        for file, declaration in project.declarations()
        if isinstance(declaration, Interface)
    )
    return {name.name for name, times in count.items() if times > 1}


def packages(project: Project) -> set[str]:
    """The packages of all interfaces."""
    return {
        interface_name(file, declaration.name).package
        for file, declaration in project.declarations()
        if isinstance(declaration, Interface)
    }


def sight(file: File) -> object:
    """What decides on what a file sees, beside what it declares itself."""
    imported = {statement for statement, _ in file.imports}
    return (
        file.library,
        [(str(statement.span.text), target) for statement, target in file.imports],
        [statement in imported for statement in file.model.imports],
    )
