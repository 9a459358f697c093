"""Incremental checking of a model that is edited.

An edit touches few declarations. These are parsed, linked and checked again, together with their
users and all that mention a name that may resolve differently now. Checks of the whole model run
each time. The diagnostics are the same as those of `pipeline.check`.
"""

from __future__ import annotations

from collections.abc import Container, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path

from swarmdsl.analysis.checks import (
    check_optimization,
    check_project,
    check_with_events,
    check_without_events,
    make_context,
    validate,
)
from swarmdsl.analysis.checks.context import Context, read_packages
from swarmdsl.analysis.checks.facts import FactCache
from swarmdsl.analysis.resolve.constant_cycles import open_cycles
from swarmdsl.analysis.resolve.linker import link
from swarmdsl.base.diagnostics.collector import Diagnostic, Diagnostics, Tally, placed
from swarmdsl.base.read_files import MOST
from swarmdsl.base.source import Source, Span
from swarmdsl.driver.config.settings import Settings
from swarmdsl.driver.workspace.documents import DocumentStore
from swarmdsl.driver.workspace.fragments import Fragment, with_users
from swarmdsl.driver.workspace.invalidation import (
    Change,
    affected,
    ambiguous_interfaces,
    packages,
    visible_names,
)
from swarmdsl.driver.workspace.rebinding import rebind, rebinding
from swarmdsl.driver.workspace.relink import link_outside
from swarmdsl.driver.workspace.repeated_checks import RepeatedChecks
from swarmdsl.project.libraries import imported_name
from swarmdsl.project.loader import File, Project, expanded, load
from swarmdsl.syntax.ast import Component, Member, StateMachine
from swarmdsl.syntax.parse import no_garbage_collection

_DEFAULTS = Settings()
_NO_TEXTS: Mapping[Path, str] = {}
# Diagnostics with a hint, which only the first few of them get.
_HINTED_DIAGNOSTICS = ("unresolved-name", "unknown-field", "unknown-param")


class Workspace:
    """The files of a model, the files that they import, and their diagnostics.

    `paths` are files and folders, as for `pipeline.check`; `texts` override the contents of files.
    Files outside of `within` or larger than `most` bytes are not read.
    """

    def __init__(
        self,
        paths: Sequence[Path],
        settings: Settings = _DEFAULTS,
        *,
        texts: Mapping[Path, str] = _NO_TEXTS,
        within: Container[Path] | None = None,
        most: int = MOST,
    ) -> None:
        self._paths = paths
        self.settings = settings
        self._store = DocumentStore(settings.levels, within, most)
        for path, text in texts.items():
            self._store.edit(path, text)
        self._fragments: dict[Source, Fragment] = {}
        self._loaded = self._collector()
        self._together = self._collector()
        # Result of a full check, where the order of declarations matters.
        self._full_report: Diagnostics | None = None
        self._reused: frozenset[StateMachine] = frozenset()
        self._facts = FactCache()
        self._packages: set[str] = set()
        # Fragments with reported or suppressed diagnostics.
        self._reported: set[Fragment] = set()
        self._imports_single_names = False  # some import is of a single name, which may be removed
        self.project = Project()
        with no_garbage_collection():
            change = Change(everything=True)
            self._load(change)
            self._apply(change)

    def update(self, texts: Mapping[Path, str | None]) -> None:
        """Override the contents of files; None reads a file from disk again.

        Use None for files that were changed, created or deleted on disk.
        """
        with no_garbage_collection():
            change, reload = Change(), False
            for path, text in texts.items():
                self._store.edit(path, text)
                document = self._store.document(path)
                source = self._store.reload(document) if document is not None else None
                if document is not None and source is not None:
                    change.replace(document, source)
                    continue
                reload = True
                if document is not None:
                    self._store.drop(path)
                    change.remove(document)
            if (
                reload
                or change.imports_changed
                or (change.declarations_changed and self._imports_single_names)
            ):
                self._load(change)
            self._apply(change)

    @contextmanager
    def overriding(self, texts: Mapping[Path, str]) -> Iterator[None]:
        """Override the contents of files temporarily."""
        before = {path: self._store.edited(path) for path in texts}
        try:
            self.update(texts)
            yield
        finally:
            self.update(before)

    @property
    def files(self) -> int:
        """Number of files, without those of libraries."""
        return self.project.size

    def file(self, path: Path) -> File | None:
        """Return a file of the model or of its imports, else None."""
        document = self._store.document(path)
        return document.file if document is not None else None

    def fragment_span(self, file: File, offset: int) -> Span:
        """Return the fragment at an offset; the last one includes its end."""
        document = self._store.document(Path(file.source.name))
        fragments = document.fragments if document is not None else []
        whole = Span(file.source, 0, len(file.source.text))
        spans = (
            Span(fragment.source, 0, len(fragment.source.text)).absolute
            for fragment in reversed(fragments)
        )
        return next((span for span in spans if span.start <= offset), whole)

    def runners(self, machine: StateMachine) -> list[Member | Component]:
        """Return the members and components that run a machine, or a reuse of it."""
        fragments = self._fragments.values()
        return [
            each
            for fragment in fragments
            if machine in fragment.runs
            for each in fragment.runners()
        ]

    @property
    def report(self) -> Diagnostics:
        """All diagnostics, with spans in files."""
        report = self._collector()
        report.include(placed(found, lambda span: span.absolute) for found in self._found())
        return report

    def watched(self) -> set[Path]:
        """Return the files and folders to watch: read, looked for or to be compiled."""
        return {*self._store.requested, *expanded(self._paths, Diagnostics())}

    def diagnostics(self) -> dict[str, list[Diagnostic]]:
        """Return the diagnostics by file name; "" has those without a file."""
        found: dict[str, list[Diagnostic]] = {file.source.name: [] for file in self.project.files}
        for one in self.report:
            name = one.primary.span.source.name if one.primary is not None else ""
            found.setdefault(name, []).append(one)
        return found

    def _collector(self) -> Diagnostics:
        return Diagnostics(self.settings.levels)

    def _found(self) -> Iterator[Diagnostic]:
        yield from self._loaded
        for document in self._store.documents.values():
            if len(document.diagnostics):
                yield from document.diagnostics
        for fragment in self._reported:
            yield from fragment.syntax
        if self._full_report is not None:
            yield from self._full_report
            return
        yield from self._together
        for fragment in self._reported:
            yield from fragment.found()

    def _load(self, change: Change) -> None:
        """Resolve the imports again; only read files that are not loaded."""
        store, before = self._store, dict(self._store.documents)
        files = self.project.files
        seen = {document.file: visible_names(document.file) for document in before.values()}
        read = read_packages(self.project)
        for document in before.values():
            document.file.imports = []
        store.in_use.clear()
        store.requested.clear()
        self._loaded = self._collector()
        self.project = load(self._paths, self._loaded, self.settings.libraries, store)
        self.project.models = frozenset(self.settings.models)
        if not self._paths:
            self._loaded.report("nothing-to-compile", path="[]")
        store.drop_unused()
        for identity, document in before.items():
            if store.documents.get(identity) is not document:
                change.remove(document)
        for identity, document in store.documents.items():
            if before.get(identity) is not document:
                change.add(document)
            elif visible_names(document.file) != seen[document.file]:
                change.stale.update(document.fragments)
        if files != self.project.files:
            change.names |= ambiguous_interfaces(self.project)
        change.everything |= read != read_packages(self.project)
        imports = (one for file in self.project.files for one in file.model.imports)
        self._imports_single_names = any(imported_name(one) is not None for one in imports)

    def _apply(self, change: Change) -> None:
        """Link and check the invalidated fragments."""
        for fragment in change.removed:
            self._fragments.pop(fragment.source, None)
        for fragment in change.new:
            self._fragments[fragment.source] = fragment
        if change.declarations_changed:
            before, self._packages = self._packages, packages(self.project)
            change.everything |= before != self._packages
        change.everything |= self._full_report is not None
        self._full_report = None
        self._reported.difference_update(change.removed)
        stale, checked = self._affected(change)
        fresh = set(change.new)
        for fragment in change.removed:
            fragment.forget()
        while True:
            self._read(stale - fresh)
            linking = link_outside(self.project, self._fragments, stale)
            if not linking.newly_run:
                break
            stale |= with_users(linking.newly_run)
            fresh.clear()
        linking.link_inside(stale)
        self._update_reported(stale)
        if self._has_cycles():
            self._check_all()
            return
        context = make_context(self.project, self._collector(), self._facts)
        linking.record_uses(stale, context.interfaces.declared)
        self._check(stale | checked, context, checked - stale)
        if self._exceeds_hint_limit():
            self._check_all()

    def _affected(self, change: Change) -> tuple[set[Fragment], set[Fragment]]:
        """Return the fragments to read, link and check again, and those only to check again."""
        events = rebinding(change, self._fragments, self._reported)
        if events is None:
            return affected(change, self._fragments.values(), self._reported), set()
        rebind(events, change, self._fragments, self.project)
        stale = {*change.new, *with_users(events.stale).intersection(self._fragments.values())}
        checked = events.checked - stale
        for fragment in events.outdated:
            self._facts.forget(fragment.parsed.model.declarations)
        self._update_reported(events.machines - stale)
        return stale, checked

    def _read(self, fragments: set[Fragment]) -> None:
        for fragment in fragments:
            fragment.read_again()
        for document in self._store.documents.values():
            if not fragments.isdisjoint(document.fragments):
                document.join()

    def _check(self, stale: set[Fragment], context: Context, rebound: set[Fragment]) -> None:
        """Run the checks of the whole model, and those of the stale fragments.

        In those that are `rebound`, nothing but events means something else.
        """
        self._together = self._collector()
        check_project(self.project, context.reporting_to(self._together))
        before, self._reused = self._reused, context.facts.reused
        turned = (self._fragments.get(node.span.source) for node in before ^ self._reused)
        others = {fragment for fragment in turned if fragment is not None}
        stale, rebound = stale | others, rebound - others
        repeated = RepeatedChecks(self._fragments)
        for fragment in stale:
            known = repeated.recall(fragment) if fragment in rebound else None
            fragment.checked = self._collector() if known is None else known
            if known is not None:
                continue
            of_fragment = context.reporting_to(fragment.checked)
            if fragment not in rebound:
                fragment.eventless = self._collector()
                fragment.results = {}
            without = context.reporting_to(fragment.eventless)
            for declaration in fragment.parsed.model.declarations:
                reused = declaration in self._reused
                check_with_events(fragment.file, declaration, of_fragment)
                if fragment not in rebound:
                    check_without_events(fragment.file, declaration, without)
                if not reused:
                    context.forget(declaration)
            for optimization in fragment.parsed.model.optimizations:
                check_optimization(optimization, of_fragment)
            shown = {label.span.source for found in fragment.found() for label in found.related}
            used = (each for each in fragment.uses if self._fragments.get(each.source) is each)
            fragment.use(
                {
                    *used,
                    *(self._fragments[each] for each in shown if each in self._fragments),
                }
            )
            repeated.keep(fragment)
        self._update_reported(stale)

    def _update_reported(self, fragments: set[Fragment]) -> None:
        self._reported -= fragments
        self._reported.update(fragment for fragment in fragments if fragment.noted)

    def _has_cycles(self) -> bool:
        """Return True if constants or aliases are cyclic; the first of them is reported."""
        cycles = Diagnostics()
        open_cycles(self.project, cycles)
        outside = (fragment.outside for fragment in self._reported)
        return len(cycles) > 0 or any(report.count_of("type-cycle") for report in outside)

    def _exceeds_hint_limit(self) -> bool:
        """Return True if only the first diagnostics get a hint."""
        for name in _HINTED_DIAGNOSTICS:
            total = Tally()
            total.add(self._loaded.tally(name))
            for fragment in self._reported:
                for report in fragment.reports():
                    total.add(report.tally(name))
            if not total.allows_hint:
                return True
        return False

    def _check_all(self) -> None:
        """Check everything at once, if the order of declarations affects diagnostics."""
        self._read(set(self._fragments.values()))
        self._update_reported(set(self._fragments.values()))
        self._full_report = self._collector()
        self._full_report.include(self._loaded)
        link(self.project, self._full_report)
        validate(self.project, self._full_report)
