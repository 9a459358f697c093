"""Fragments of files, with their trees, dependencies and diagnostics."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Iterator, Mapping
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
# Most fragments have no dependencies: a set for each would take megabytes.
_NONE: frozenset[Any] = frozenset()


class Fragment:
    """Unit of parsing, linking and checking: a part of a file, mostly one declaration.

    `uses` are the fragments that it depends on, `users` those that depend on it. It is
    `suppressed` if an unresolved name in it was not reported, because it may be declared in
    unparsed text. `eventless` are results of checks that look at no events, `checked` the others;
    `results` are some of these for other meanings of the events (`repeated_checks.py`). A fragment
    is parsed again if it or one that it uses changes: a linked tree is never linked again.
    """

    def __init__(self, source: Source, file: File, parser: ReportingParser, levels: Levels) -> None:
        self.source = source
        self.file = file
        self.parser = parser
        self.levels = levels
        self.uses: tuple[Fragment, ...] = ()
        self.users: frozenset[Fragment] | set[Fragment] = _NONE
        self.runs: frozenset[StateMachine] = _NONE
        self.syntax = Diagnostics(self.levels)
        self.parsed = self.parser(self.source, self.syntax)
        self.forget()

    def read_again(self) -> None:
        """Parse again, to get an unlinked tree."""
        imports = self.parsed.model.imports
        self.parsed = self.parser(self.source, Diagnostics())
        self.parsed.model.imports = imports  # resolved by the loader
        self.forget()

    def forget(self) -> None:
        """Discard the results of linking and checking."""
        self.outside = Diagnostics(self.levels)
        self.inside = Diagnostics(self.levels)
        self.checked = Diagnostics(self.levels)
        self.eventless = Diagnostics(self.levels)
        self.results: dict[Hashable, Diagnostics] = {}
        self.runs = _NONE
        self.suppressed = False
        self.use(())

    def use(self, fragments: Iterable[Fragment]) -> None:
        """Set the fragments that this one uses."""
        for fragment in self.uses:
            fragment.users -= {self}
        self.uses = tuple({fragment for fragment in fragments if fragment is not self})
        for fragment in self.uses:
            if not fragment.users:
                fragment.users = set()
            fragment.users |= {self}

    def owners(self) -> Iterator[Declaration | Optimization]:
        """Yield the declarations and optimizations in it."""
        yield from self.parsed.model.declarations
        yield from self.parsed.model.optimizations

    def runners(self) -> Iterator[Member | Component]:
        """Yield the declarations in it that run state machines."""
        for declaration in self.parsed.model.declarations:
            if isinstance(declaration, (Member, Component)):
                yield declaration

    @cached_property
    def closed(self) -> bool:
        """True if all brackets and comments are closed in it."""
        return is_self_contained(self.source.text)

    @property
    def has_package_or_imports(self) -> bool:
        """True if it has the package declaration or an import."""
        return self.parsed.model.package is not None or bool(self.parsed.model.imports)

    def found(self) -> Iterator[Diagnostic]:
        """Diagnostics of linking and checking."""
        for report in self.reports():
            yield from report

    def reports(self) -> tuple[Diagnostics, ...]:
        """Return the collectors of linking and checking."""
        return self.outside, self.inside, self.checked, self.eventless

    @property
    def noted(self) -> bool:
        """True if anything was reported or suppressed."""
        return self.suppressed or len(self.syntax) > 0 or any(self.found())


def with_users(fragments: Iterable[Fragment]) -> set[Fragment]:
    """Return the fragments and all that use them, transitively."""
    work = list(fragments)
    found = set(work)
    while work:
        for user in work.pop().users:
            if user not in found:
                found.add(user)
                work.append(user)
    return found
