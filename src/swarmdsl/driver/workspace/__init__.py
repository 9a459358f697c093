"""A model that is edited: what is wrong with it, known anew after each edit in little time.

An edit touches few declarations. These are parsed, linked and checked again, and so are those
that were linked or checked with one of them, or that name something whose meaning the edit may
have changed. The rest stays as it is; rules about all declarations together run each time. What
comes of it is what `compiler.check` would say of the same texts.
"""

from __future__ import annotations

from collections.abc import Container, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path

from swarmdsl.analysis.checks import (
    check_declaration,
    check_optimization,
    check_project,
    make_context,
    validate,
)
from swarmdsl.analysis.checks.context import Context, read_packages
from swarmdsl.analysis.checks.facts import FactCache
from swarmdsl.analysis.resolve.constant_cycles import open_cycles
from swarmdsl.analysis.resolve.linker import link
from swarmdsl.base.diagnostics.collector import MOST_HINTS, Diagnostic, Diagnostics, placed
from swarmdsl.base.source import Source, Span
from swarmdsl.driver.config.settings import Settings
from swarmdsl.driver.workspace.documents import Desk
from swarmdsl.driver.workspace.fragments import Unit, with_users
from swarmdsl.driver.workspace.invalidation import Change, affected, declared_twice, packages, sight
from swarmdsl.driver.workspace.relink import link_outside
from swarmdsl.project.libraries import imported_name
from swarmdsl.project.loader import File, Project, expanded, load
from swarmdsl.syntax.ast import Component, Member, StateMachine
from swarmdsl.syntax.parse import no_garbage_collection

_DEFAULTS = Settings()
_NO_TEXTS: Mapping[Path, str] = {}
# What looks for names that may be meant, as long as there are not too many of them.
_HINTED = ("unresolved-name", "unknown-field", "unknown-param")


class Workspace:
    """The files of a model, those they import, and what is wrong with them.

    `paths` are files and folders, as for `compiler.check`; `texts` are taken for the contents of
    files. What does not lie `within` some folders is not read, nor what has more than `most` bytes.
    """

    def __init__(
        self,
        paths: Sequence[Path],
        settings: Settings = _DEFAULTS,
        *,
        texts: Mapping[Path, str] = _NO_TEXTS,
        within: Container[Path] | None = None,
        most: int | None = None,
    ) -> None:
        self._paths = paths
        self.settings = settings
        self._desk = Desk(settings.levels, within, most)
        for path, text in texts.items():
            self._desk.edit(path, text)
        self._units: dict[Source, Unit] = {}
        self._loaded = self._collector()
        self._together = self._collector()
        # What checking all at once has found, where the order of declarations decides on it.
        self._in_order: Diagnostics | None = None
        self._reused: frozenset[StateMachine] = frozenset()
        self._facts = FactCache()
        self._packages: set[str] = set()
        # Units of which something was reported, or nothing because of what cannot be read.
        self._noted: set[Unit] = set()
        self._picks = False  # whether an import is of one name, which may be gone
        self.project = Project()
        with no_garbage_collection():
            change = Change(everything=True)
            self._load(change)
            self._apply(change)

    def update(self, texts: Mapping[Path, str | None]) -> None:
        """Take texts for the contents of files; None for one that is to be read from disk again.

        That is what to do with a file that was changed, made or deleted there.
        """
        with no_garbage_collection():
            change, reload = Change(), False
            for path, text in texts.items():
                self._desk.edit(path, text)
                sheet = self._desk.sheet(path)
                source = self._desk.reread(sheet) if sheet is not None else None
                if sheet is not None and source is not None:
                    change.replace(sheet, source)
                    continue
                reload = True
                if sheet is not None:
                    self._desk.drop(path)
                    change.go(sheet)
            if reload or change.heads or (change.shape and self._picks):
                self._load(change)
            self._apply(change)

    @contextmanager
    def supposing(self, texts: Mapping[Path, str]) -> Iterator[None]:
        """Take texts for the contents of files for a while; what was before comes back."""
        before = {path: self._desk.edited(path) for path in texts}
        try:
            self.update(texts)
            yield
        finally:
            self.update(before)

    @property
    def files(self) -> int:
        """How many files there are."""
        return len(self.project.files)

    def file(self, path: Path) -> File | None:
        """A file of the model, or one that it imports; None for any other."""
        sheet = self._desk.sheet(path)
        return sheet.file if sheet is not None else None

    def piece(self, file: File, offset: int) -> Span:
        """The piece of a file that an offset is in, or that ends there if it is the last."""
        sheet = self._desk.sheet(Path(file.source.name))
        units = sheet.units if sheet is not None else []
        whole = Span(file.source, 0, len(file.source.text))
        spans = (Span(unit.source, 0, len(unit.source.text)).absolute for unit in reversed(units))
        return next((span for span in spans if span.start <= offset), whole)

    def runners(self, machine: StateMachine) -> list[Member | Component]:
        """The members and components that run a machine, or what reuses it."""
        units = self._units.values()
        return [each for unit in units if machine in unit.runs for each in unit.runners()]

    @property
    def report(self) -> Diagnostics:
        """All that is wrong, at places in the files."""
        report = self._collector()
        report.include(placed(found, lambda span: span.absolute) for found in self._found())
        return report

    def watched(self) -> set[Path]:
        """The files and folders that matter: those read, those looked for, those to be compiled."""
        return {*self._desk.asked, *expanded(self._paths, Diagnostics())}

    def diagnostics(self) -> dict[str, list[Diagnostic]]:
        """What is wrong by the name of the file; of "" what is wrong with no file."""
        found: dict[str, list[Diagnostic]] = {file.source.name: [] for file in self.project.files}
        for one in self.report:
            name = one.primary.span.source.name if one.primary is not None else ""
            found.setdefault(name, []).append(one)
        return found

    def _collector(self) -> Diagnostics:
        return Diagnostics(self.settings.levels)

    def _found(self) -> Iterator[Diagnostic]:
        yield from self._loaded
        for sheet in self._desk.sheets.values():
            if len(sheet.said):
                yield from sheet.said
        for unit in self._noted:
            yield from unit.syntax
        if self._in_order is not None:
            yield from self._in_order
            return
        yield from self._together
        for unit in self._noted:
            yield from unit.found()

    def _load(self, change: Change) -> None:
        """Follow the imports anew; what was read before is not read again."""
        desk, before = self._desk, dict(self._desk.sheets)
        files = self.project.files
        seen = {sheet.file: sight(sheet.file) for sheet in before.values()}
        read = read_packages(self.project)
        for sheet in before.values():
            sheet.file.imports = []
        desk.wanted.clear()
        desk.asked.clear()
        self._loaded = self._collector()
        self.project = load(self._paths, self._loaded, self.settings.libraries, desk)
        if not self._paths:
            self._loaded.report("nothing-to-compile", path="[]")
        desk.tidy()
        for identity, sheet in before.items():
            if desk.sheets.get(identity) is not sheet:
                change.go(sheet)
        for identity, sheet in desk.sheets.items():
            if before.get(identity) is not sheet:
                change.come(sheet)
            elif sight(sheet.file) != seen[sheet.file]:
                change.stale.update(sheet.units)
        if files != self.project.files:
            change.words |= declared_twice(self.project)
        change.everything |= read != read_packages(self.project)
        imports = (one for file in self.project.files for one in file.model.imports)
        self._picks = any(imported_name(one) is not None for one in imports)

    def _apply(self, change: Change) -> None:
        """Link and check what the change has an effect on."""
        for unit in change.gone:
            self._units.pop(unit.source, None)
        for unit in change.new:
            self._units[unit.source] = unit
        if change.shape:
            before, self._packages = self._packages, packages(self.project)
            change.everything |= before != self._packages
        change.everything |= self._in_order is not None
        self._in_order = None
        self._noted.difference_update(change.gone)
        stale = affected(change, self._units.values(), self._noted)
        fresh = set(change.new)
        for unit in change.gone:
            unit.forget()
        while True:
            self._read(stale - fresh)
            linking = link_outside(self.project, self._units, stale)
            if not linking.driven:
                break
            stale |= with_users(linking.driven)
            fresh.clear()
        linking.link_inside(stale)
        self._note(stale)
        if self._has_circles():
            self._check_in_order()
            return
        context = make_context(self.project, self._collector(), self._facts)
        linking.learn_uses(stale, context.interfaces.declared)
        self._check(stale, context)
        if self._has_many_mistakes():
            self._check_in_order()

    def _read(self, units: set[Unit]) -> None:
        for unit in units:
            unit.read_again()
        for sheet in self._desk.sheets.values():
            if not units.isdisjoint(sheet.units):
                sheet.join()

    def _check(self, stale: set[Unit], context: Context) -> None:
        """Run the rules about all together, and those about each of some units."""
        self._together = self._collector()
        check_project(self.project, context.reporting_to(self._together))
        before, self._reused = self._reused, context.facts.reused
        turned = (self._units.get(node.span.source) for node in before ^ self._reused)
        stale = stale.union(unit for unit in turned if unit is not None)
        for unit in stale:
            unit.checked = self._collector()
            of_unit = context.reporting_to(unit.checked)
            for declaration in unit.parsed.model.declarations:
                reused = declaration in self._reused
                check_declaration(unit.file, declaration, of_unit)
                if not reused:
                    context.forget(declaration)
            for optimization in unit.parsed.model.optimizations:
                check_optimization(optimization, of_unit)
            shown = {label.span.source for found in unit.found() for label in found.related}
            unit.use({*unit.uses, *(self._units[each] for each in shown if each in self._units)})
        self._note(stale)

    def _note(self, units: set[Unit]) -> None:
        self._noted -= units
        self._noted.update(unit for unit in units if unit.noted)

    def _has_circles(self) -> bool:
        """Whether constants or aliases lead in a circle, which begins at the first of them."""
        circles = Diagnostics()
        open_cycles(self.project, circles)
        outside = (unit.outside for unit in self._noted)
        return len(circles) > 0 or any(report.count_of("type-cycle") for report in outside)

    def _has_many_mistakes(self) -> bool:
        """Whether not all have a hint what may be meant: it is the first that have."""
        counts = dict.fromkeys(_HINTED, self._loaded.count_of(_HINTED[0]))
        for unit in self._noted:
            for report in (unit.outside, unit.inside, unit.checked):
                for name in _HINTED:
                    counts[name] += report.count_of(name)
        return any(count >= MOST_HINTS for count in counts.values())

    def _check_in_order(self) -> None:
        """Check all of it at once, where the order of all declarations decides what is said."""
        self._read(set(self._units.values()))
        self._note(set(self._units.values()))
        self._in_order = self._collector()
        self._in_order.include(self._loaded)
        link(self.project, self._in_order)
        validate(self.project, self._in_order)
