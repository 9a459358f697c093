"""Merge an import into an existing model.

The import is text of the language as well, so that two models are merged by declarations.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping

from swarmdsl.analysis.types.enum_values import underlying
from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.text_edits import Edits
from swarmdsl.importing.update.declarations import merge_component, merge_event, merge_function
from swarmdsl.importing.update.interfaces import is_described, merge_interface
from swarmdsl.importing.update.known import Key, Model, group_of, groups_before, read_model
from swarmdsl.importing.update.merging import Guess, Merge, node_text
from swarmdsl.ir import Array, Primitive, Type
from swarmdsl.project.loader import File
from swarmdsl.syntax.ast import (
    Component,
    Declaration,
    EnumType,
    Event,
    Function,
    Interface,
    StateMachine,
)
from swarmdsl.syntax.formatter.tokens import tokenize


def update(
    model: Model,
    imported: Model,
    report: Diagnostics,
    guesses: Collection[Guess] = (),
    *,
    complete: bool = True,
    force: bool = False,
) -> Mapping[str, str]:
    """Return the changed texts of the model's files by source name.

    Comments and everything that the import does not contain stay. `complete` is True if the import
    format states interfaces completely, including empty ones and bounds of strings and arrays.
    `guesses` are the assumed properties.
    """
    updater = _Updater(model, report, guesses, complete, force)
    for key, (_, new) in imported.declared.items():
        updater.declaration(key, new)
    return {edits.source.name: edits.text() for edits in updater.edits.values() if edits}


class _Updater:
    def __init__(
        self,
        model: Model,
        report: Diagnostics,
        guesses: Collection[Guess],
        complete: bool,
        force: bool,
    ) -> None:
        self.edits: dict[File, Edits] = {}
        self._model = model
        self._report = report
        self._guesses = guesses
        self._complete = complete
        self._force = force
        self._merges: dict[File, Merge] = {}

    def declaration(self, key: Key, new: Declaration) -> None:
        """Change or add a declaration."""
        file, old = self._model.declared.get(key, (None, None))
        if file is None or old is None:
            if self._complete or not isinstance(new, Interface) or is_described(new):
                self._add(key[0], new)
        elif not file.library:
            self._merge(self._merge_of(file), old, new)
        elif self._differs(file, old, new):
            if isinstance(new, Interface):
                reason = f"`{file.package}` is a library and describes it differently"
                self._report.report("left-out", None, what=f"`{key[1]}`", reason=reason)
            else:
                self._add(key[0], new)

    def _differs(self, file: File, old: Declaration, new: Declaration) -> bool:
        """Return True if the import differs from the declaration in a library."""
        edits = Edits(file.source)
        found = Diagnostics()
        trial = Merge(edits, self._plain, self._guesses, found, force=True, is_trial=True)
        self._merge(trial, old, new)
        return bool(edits)

    def _merge_of(self, file: File) -> Merge:
        if file not in self._merges:
            edits = self.edits.setdefault(file, Edits(file.source))
            self._merges[file] = Merge(edits, self._plain, self._guesses, self._report, self._force)
        return self._merges[file]

    def _merge(self, merge: Merge, old: Declaration, new: Declaration) -> None:
        match old, new:
            case Function(), Function():
                merge_function(merge, old, new)
            case Event(), Event():
                merge_event(merge, old, new)
            case Component(), Component():
                merge_component(merge, old, new)
            case StateMachine(), StateMachine():
                _merge_machine(merge, old, new)
            case _ if isinstance(old, Interface) and isinstance(new, Interface):
                merge_interface(merge, old, new)

    def _add(self, group: str, new: Declaration) -> None:
        """Add a declaration below the last of its group, or of the groups usually before."""
        file = self._model.file
        edits = self.edits.setdefault(file, Edits(file.source))
        model = file.model
        declared = [(group_of(old), old) for old in model.declarations]
        same = [old for each, old in declared if each == group]
        before = same or [old for each, old in declared if each in groups_before(group)]
        if before:
            last = max(before, key=lambda old: old.span.start)
            together = isinstance(last, Event) and isinstance(new, Event) and not new.doc
            edits.below(last.span.end, node_text(new) if together else f"\n{node_text(new)}")
            return
        top = [*([model.package] if model.package is not None else []), *model.imports]
        end = top[-1].span.end if top else len(file.source.text)
        edits.below(end, f"\n{node_text(new)}")

    def _plain(self, type_: Type) -> Type:
        """Type as the import format can express it: enums as numbers, bounds if possible."""
        if isinstance(type_, Array):
            size = type_.size if self._complete or not type_.bounded else None
            return Array(self._plain(type_.element), size, type_.bounded and self._complete)
        if isinstance(type_, Primitive):
            return type_ if self._complete else Primitive(type_.name)
        _, declared = self._model.declared.get(("interface", str(type_)), (None, None))
        return underlying(declared) if isinstance(declared, EnumType) else type_


def _merge_machine(merge: Merge, old: StateMachine, new: StateMachine) -> None:
    """Keep a machine, because manual edits in it cannot be recognized."""
    if _words(old.span.text) == _words(new.span.text):
        return
    if merge.force:
        merge.edits.replace(old.span, new.span.text)
        return
    reason = "the imported one differs"
    hint = "use `--force` to replace it"
    merge.kept(old.name.span, f"state machine `{old.name}`", reason, hint)


def _words(text: str) -> list[str]:
    return [token.text for token in tokenize(text) if not token.is_comment]


__all__ = ["Guess", "Key", "Model", "read_model", "update"]
