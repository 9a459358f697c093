"""The pieces of files, and what is known of each: its tree, what it uses, what was said of it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from swarmdsl.base.diagnostics.collector import Diagnostic, Diagnostics, Level
from swarmdsl.base.source import Source
from swarmdsl.project.loader import File
from swarmdsl.syntax.ast import Component, Declaration, Member, Optimization, StateMachine
from swarmdsl.syntax.parse import Parsed
from swarmdsl.syntax.segments import is_self_contained

ReportingParser = Callable[[Source, Diagnostics], Parsed]
Levels = Mapping[str, Level]
# Most units use none, are used by none and run none: a set for each would take megabytes.
_NONE: frozenset[Any] = frozenset()


@dataclass(eq=False)
class Unit:
    """A piece of a file, mostly one declaration: what is read, linked and checked at once.

    `uses` are the units whose content it was linked and checked with, `users` those that did so
    with it. It is `hushed` if a name that means nothing in it was not reported, because it may be
    declared in what could not be read. A unit whose content changed, or that of one that it uses,
    is read anew: nothing that was linked is ever linked again.
    """

    source: Source
    file: File
    parser: ReportingParser
    levels: Levels
    uses: tuple[Unit, ...] = ()
    users: frozenset[Unit] | set[Unit] = _NONE
    runs: frozenset[StateMachine] = _NONE

    def __post_init__(self) -> None:
        self.syntax = Diagnostics(self.levels)
        self.parsed = self.parser(self.source, self.syntax)
        self.forget()

    def read_again(self) -> None:
        """Make the tree anew, in which nothing is linked."""
        imports = self.parsed.model.imports
        self.parsed = self.parser(self.source, Diagnostics())
        self.parsed.model.imports = imports  # the loader has followed these
        self.forget()

    def forget(self) -> None:
        """Forget what linking and checking have found."""
        self.outside = Diagnostics(self.levels)
        self.inside = Diagnostics(self.levels)
        self.checked = Diagnostics(self.levels)
        self.runs = _NONE
        self.hushed = False
        self.use(())

    def use(self, units: Iterable[Unit]) -> None:
        """Remember which other units this one uses now."""
        for unit in self.uses:
            unit.users -= {self}
        self.uses = tuple({unit for unit in units if unit is not self})
        for unit in self.uses:
            if not unit.users:
                unit.users = set()
            unit.users |= {self}

    def owners(self) -> Iterator[Declaration | Optimization]:
        """The declarations and optimizations in it."""
        yield from self.parsed.model.declarations
        yield from self.parsed.model.optimizations

    def runners(self) -> Iterator[Member | Component]:
        """The declarations in it that run state machines."""
        for declaration in self.parsed.model.declarations:
            if isinstance(declaration, (Member, Component)):
                yield declaration

    @cached_property
    def closed(self) -> bool:
        """Whether no bracket or comment in it goes on in others."""
        return is_self_contained(self.source.text)

    @property
    def has_head(self) -> bool:
        """Whether the package or an import is in it."""
        return self.parsed.model.package is not None or bool(self.parsed.model.imports)

    def found(self) -> Iterator[Diagnostic]:
        """What linking and checking have found."""
        for report in (self.outside, self.inside, self.checked):
            yield from report

    @property
    def noted(self) -> bool:
        """Whether anything was reported, or a name was not."""
        return self.hushed or len(self.syntax) > 0 or any(self.found())


def with_users(units: Iterable[Unit]) -> set[Unit]:
    """The units, and all that use one of them, directly or not."""
    work = list(units)
    found = set(work)
    while work:
        for user in work.pop().users:
            if user not in found:
                found.add(user)
                work.append(user)
    return found
