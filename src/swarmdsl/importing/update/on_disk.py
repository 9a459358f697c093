"""Read the existing model from disk and compute its changed files."""

from __future__ import annotations

import os
from collections import Counter
from collections.abc import Collection, Mapping
from functools import cached_property
from pathlib import Path

from swarmdsl.analysis.checks import validate
from swarmdsl.base.diagnostics.collector import Diagnostics, Severity
from swarmdsl.base.read_files import exists, is_file, is_folder, read_file
from swarmdsl.base.records import dataclass
from swarmdsl.base.rewriting import Layout
from swarmdsl.driver import pipeline
from swarmdsl.driver.config import find_settings
from swarmdsl.driver.config.settings import Settings
from swarmdsl.driver.format_files import layout_of
from swarmdsl.importing.update import Guess, Key, Model, read_model, update
from swarmdsl.ir import Communication, Function, Named, System
from swarmdsl.project.read_source import read_bytes
from swarmdsl.syntax.ast import Function as Declared


@dataclass(eq=False)
class Existing:
    """A model on disk."""

    path: Path
    settings: Settings
    model: Model

    @cached_property
    def system(self) -> System | None:
        """The checked system; None if the model has errors."""
        return pipeline.check([self.path], self.settings).system

    def operations(self) -> set[Key]:
        """Keys of functions and services that components declare as operations."""
        if self.system is None:
            return set()
        names = {name for component in self.system.components for name in component.operations}
        for member in self.system.members:
            names |= {name for part in member.parts for name in part.operations}
        offered = list(map(self.system.function, names))
        return {("function", function.name) for function in offered} | {
            ("interface", str(function.communication.type)) for function in offered
        }

    def functions(self) -> dict[str, Function]:
        """Return the declared functions by name, with a placeholder for their communication."""
        call = Communication("action", "unknown", Named("std_msgs", "Empty"))
        return {
            str(declared.name): Function(str(declared.name), declared.category, call, (), ())
            for file, declared in self.model.declared.values()
            if isinstance(declared, Declared) and not file.library
        }


def read_existing(path: Path, report: Diagnostics) -> Existing | None:
    """Read the model in a file; None if it does not exist or cannot be read.

    Only syntax errors are reported, because the import may bring missing names. Devices and pipes
    are refused: reading them might not end.
    """
    if not os.path.lexists(path):
        return None
    if exists(path) and not (is_file(path) or is_folder(path)):
        reason = "it is not a regular file"
        report.report(
            "cannot-write", path=path, reason=reason, help="omit `-o` to write to standard output"
        )
        return None
    content = read_bytes(path, None, report)
    if content is None or not content.strip():
        return None
    found = Diagnostics()
    settings = find_settings([path], found)
    model = read_model(path, found, settings.libraries)
    report.include(one for one in found if one.severity is Severity.ERROR)
    return None if report.has_errors else Existing(path, settings, model)


def update_files(
    existing: Existing,
    text: str,
    guesses: Collection[Guess],
    report: Diagnostics,
    *,
    complete: bool,
    force: bool,
) -> list[Layout]:
    """Files that an import changes, with their new contents.

    New errors in the resulting model are reported.
    """
    place = existing.path.with_name(f"{existing.path.name}.import")
    imported = read_model(place, Diagnostics(), texts={str(place): text})
    for key in existing.operations():
        imported.declared.pop(key, None)
    texts = update(existing.model, imported, report, guesses, complete=complete, force=force)
    layouts = [_layout(name, changed, report) for name, changed in texts.items()]
    made = [layout for layout in layouts if layout is not None]
    after = {layout.name: layout.after.decode().replace("\r\n", "\n") for layout in made}
    new = _errors(existing, after) - _errors(existing, {}) if made else Counter()
    for code, message in new:
        report.report("no-model", path=existing.path.as_posix(), reason=f"{message} ({code})")
    return [layout for layout in made if layout.changed]


def _layout(name: str, text: str, report: Diagnostics) -> Layout | None:
    """Return a changed file in canonical layout with its original line ends."""
    before = read_file(name)
    windows = before.partition(b"\n")[0].endswith(b"\r")
    content = text.replace("\n", "\r\n") if windows else text
    found = Diagnostics()
    made = layout_of(name, content.encode(), found)
    if made is None:
        for fault in found:
            reason = f"{fault.message} ({fault.code})"
            report.report("no-model", path=name, reason=reason)
        return None
    return Layout(name, before, made.after)


def _errors(existing: Existing, texts: Mapping[str, str]) -> Counter[tuple[str, str]]:
    """Errors of the model with `texts` in place of files on disk."""
    report = Diagnostics()
    libraries = existing.settings.libraries
    model = read_model(existing.path, report, libraries, texts, names=report)
    validate(model.project, report)
    return Counter(
        (found.code, found.message) for found in report if found.severity is Severity.ERROR
    )
