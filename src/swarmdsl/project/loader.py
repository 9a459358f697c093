"""Load a project: read and parse files, follow imports."""

from __future__ import annotations

import os
from collections import deque
from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from swarmdsl.base.diagnostics.advice import Advice
from swarmdsl.base.diagnostics.collector import Diagnostics, Label
from swarmdsl.base.graphs import cycles
from swarmdsl.base.read_files import exists, is_file, is_folder
from swarmdsl.base.records import dataclass, field
from swarmdsl.base.source import Source, Span
from swarmdsl.base.suggest import did_you_mean
from swarmdsl.project.libraries import SUFFIX, Libraries, imported_name, place_of
from swarmdsl.project.read_source import read_source, without_control_characters
from swarmdsl.project.rosidl.interface_file import INTERFACE_KINDS, parse_interface
from swarmdsl.syntax.ast import (
    Declaration,
    Import,
    ImportFile,
    ImportLibrary,
    ImportRos,
    Model,
    Optimization,
)
from swarmdsl.syntax.parse import Parsed, parse

if TYPE_CHECKING:
    from swarmdsl.project.rosidl.package_folder import InterfacePath

_IMPORTED = "`swarmc import` converts SCXML, ADF and AMF to a model"
_WAYS = {
    ".toml": "`swarmc simulate --scenario FILE` runs a scenario, `swarmc test FILE` runs tests; "
    "swarm.toml is found without being named",
    ".jsonl": "`swarmc simulate` takes events by `--events FILE`, and traces by `--replay FILE`, "
    "given before each file",
    ".json": "`swarmc simulate` takes events by `--events FILE`",
    ".xml": _IMPORTED,
    ".scxml": _IMPORTED,
}
"""Purpose of files that are often given instead of models, by suffix."""


@dataclass(eq=False)
class File:
    """A file of the project; `imports` are the imported files that could be read.

    A file that only a library or a ROS package brings in is a `library` file: only its used
    declarations belong to the system.
    """

    source: Source
    parsed: Parsed
    library: bool = False
    imports: list[tuple[Import, File]] = field(default_factory=list)

    @property
    def model(self) -> Model:
        """Syntax tree of the file."""
        return self.parsed.model

    @property
    def package(self) -> str:
        """Name of the package, by default that of the file."""
        if self.model.package is not None:
            return str(self.model.package.name)
        return Path(self.source.name).stem


@dataclass
class Project:
    """All files of a run: first the files that no other imports, then the imported ones.

    A folder and the one file in it that imports all others give the same project.
    """

    files: list[File] = field(default_factory=list)
    models: frozenset[str] = frozenset()
    """Names of the function models that the project has beside those of swarmdsl."""

    @property
    def size(self) -> int:
        """Number of files, without those of libraries unless there are no others."""
        return sum(not file.library for file in self.files) or len(self.files)

    def declarations(self) -> Iterator[tuple[File, Declaration]]:
        """Yield all top-level declarations with their files."""
        for file in self.files:
            for declaration in file.model.declarations:
                yield file, declaration

    def optimizations(self) -> Iterator[tuple[File, Optimization]]:
        """Yield all optimizations with their files."""
        for file in self.files:
            for optimization in file.model.optimizations:
                yield file, optimization


class Reader:
    """Reads and parses files. A file that cannot be read is reported at `at` and gives None."""

    def look(self, path: Path) -> None:
        """Note a path that was tried: its contents decide about imports."""

    def allows(self, path: Path, at: Span | None, report: Diagnostics) -> bool:
        """Return True if a file or folder may be read; report any other at `at`."""
        return True

    def model(self, path: Path, at: Span | None, report: Diagnostics) -> File | None:
        """Read and parse a .swarm file."""
        source = read_source(path, at, report)
        return parsed_model(source, report) if source is not None else None

    def interface(
        self, interface: InterfacePath, at: Span | None, report: Diagnostics
    ) -> File | None:
        """Read a ROS interface file as a file with one declaration."""
        source = read_source(interface.path, at, report)
        return File(source, parsed_interface(interface, source, report)) if source else None


_READER = Reader()


def load(
    paths: Iterable[Path],
    report: Diagnostics,
    libraries: Sequence[Path] = (),
    reader: Reader = _READER,
) -> Project:
    """Load files, the files in folders, and all that they import.

    `libraries` are folders with packages, searched before the installed ones.
    """
    return _Loader(report, Libraries(libraries, report, reader.look), reader).load(paths)


@dataclass
class _Step:
    """A file to read, with the import that needs it (None for a file that the user named)."""

    path: Path
    importer: File | None = None
    statement: Import | None = None
    interface: InterfacePath | None = None

    @property
    def place(self) -> Span | None:
        """Span at which to report errors of the file."""
        return place_of(self.statement) if self.statement is not None else None

    @property
    def library(self) -> bool:
        """True for a file of a library."""
        if self.importer is None:
            return False
        return self.importer.library or not isinstance(self.statement, ImportFile)


class _Loader:
    def __init__(self, report: Diagnostics, libraries: Libraries, reader: Reader) -> None:
        self._report = report
        self._reader = reader
        self._libraries = libraries
        self._known: dict[str, File | None] = {}
        self._work: deque[_Step] = deque()

    def load(self, paths: Iterable[Path]) -> Project:
        self._work.extend(_Step(path) for path in expanded(paths, self._report))
        while self._work:
            step = self._work.popleft()
            file = self._file(step)
            if file is None or step.importer is None or step.statement is None:
                continue
            step.importer.imports.append((step.statement, file))
        files = [file for file in self._known.values() if file is not None]
        _report_cycles(files, self._report)
        for file in files:
            for statement in file.model.imports:
                self._check_name(file, statement)
        return Project(_in_import_order(files))

    def _file(self, step: _Step) -> File | None:
        identity = os.path.realpath(step.path)
        if identity not in self._known:
            if step.interface is not None:
                file = self._reader.interface(step.interface, step.place, self._report)
            else:
                file = self._reader.model(step.path, step.place, self._report)
            self._known[identity] = file
            if file is not None:
                file.library = step.library
                for statement in file.model.imports:
                    self._work.extend(self._imported(file, statement))
        file = self._known[identity]
        if file is not None and not step.library:
            file.library = False
        return file

    def _imported(self, file: File, statement: Import) -> Iterator[_Step]:
        folder = Path(file.source.name).parent
        match statement:
            case ImportFile(path=target) if Path(target).suffix[1:] in INTERFACE_KINDS:
                self._report.report(
                    "not-a-file",
                    target.span,
                    path=target,
                    actual="an interface of ROS",
                    expected="a .swarm file",
                    help=_with_its_folder(target),
                )
            case ImportFile(path=target):
                yield _Step(_relative(folder, target), file, statement)
            case ImportRos(path=target):
                place = _relative(folder, target)
                if not self._reader.allows(place, target.span, self._report):
                    return
                # Most files import no interfaces.
                from swarmdsl.project.rosidl.installed import installed_package
                from swarmdsl.project.rosidl.package_folder import find_interfaces

                if not exists(place):
                    place = installed_package(target) or place
                found = find_interfaces(
                    place, target.span, self._report, look=self._reader.look, named=target
                )
                for interface in found:
                    yield _Step(interface.path, file, statement, interface)
            case ImportLibrary():
                for path in self._libraries.find_package(statement, folder):
                    yield _Step(path, file, statement)

    def _check_name(self, file: File, statement: Import) -> None:
        """Report an import of a name that its package does not declare.

        The import is removed then, so that uses of the name are not reported too.
        """
        name = imported_name(statement)
        targets = [target for found, target in file.imports if found is statement]
        if name is None or not targets:
            return
        declared = [str(node.name) for target in targets for node in target.model.declarations]
        if name in declared or any(name in target.parsed.skipped_names for target in targets):
            return
        place = place_of(statement)
        whole = place.text
        help_ = did_you_mean(name, declared)
        if self._libraries.is_package(whole, Path(file.source.name).parent):
            help_ = Advice(
                f"write `import {whole}.*` for all that this package declares",
                "write import",
                f"import {whole}.*",
            )
        self._report.report(
            "unresolved-name",
            Span(place.source, place.end - len(name), place.end),
            kind=f"declaration of package `{whole.rpartition('.')[0]}`",
            name=name,
            help=help_,
        )
        file.imports = [found for found in file.imports if found[0] is not statement]


def _in_import_order(files: list[File]) -> list[File]:
    """Sort files: first those that no other imports, then their imports level by level."""
    imported = {target for file in files for _, target in file.imports}
    ordered = dict.fromkeys(file for file in files if file not in imported)
    work = deque(ordered)
    while work:
        for _, target in work.popleft().imports:
            if target not in ordered:
                ordered[target] = None
                work.append(target)
    ordered.update(dict.fromkeys(files))  # the files of a cycle that no other file imports
    return list(ordered)


def expanded(paths: Iterable[Path], report: Diagnostics) -> Iterator[Path]:
    """Replace each folder by the .swarm files below it, in a stable order.

    Files with another suffix are reported and left out.
    """
    for path in paths:
        if not is_folder(path):
            help_ = _WAYS.get(path.suffix)
            if help_ is None or not is_file(path):
                yield path
            else:
                actual = f"a {path.suffix} file"
                expected = f"a model, *{SUFFIX}"
                report.report("not-a-file", path=path, actual=actual, expected=expected, help=help_)
            continue
        from swarmdsl.project.search import found_below

        found = found_below(path, SUFFIX, report)
        if found is not None and not found:
            report.report("nothing-to-compile", path=path)
        yield from found or ()


def _relative(folder: Path, path: str) -> Path:
    """Return the normalized path of an import in a folder."""
    return Path(os.path.normpath(folder / path))


def parsed_interface(interface: InterfacePath, source: Source, report: Diagnostics) -> Parsed:
    """Parse a ROS interface file."""
    read = parse_interface(source, interface.package, interface.name, interface.kind, report)
    whole = Span(source, 0, len(source.text))
    parsed = Parsed(Model(whole, None, [], [read.declaration], []))
    if read.damaged:
        parsed.incomplete |= {read.declaration}
    return parsed


def parsed_model(source: Source, report: Diagnostics) -> File:
    """Parse a .swarm file."""
    before = len(report)
    source = without_control_characters(source, report)
    parsed = parse(source, report)
    if len(report) == before:
        report_empty(source, parsed.model, report)
    return File(source, parsed)


def _with_its_folder(target: str) -> Advice:
    statement = f'import ros "{Path(target).parent.as_posix()}"'
    return Advice(f"write `{statement}`, with its folder", "write import", statement)


def report_empty(source: Source, model: Model, report: Diagnostics) -> None:
    """Report a correct file without any declaration."""
    if not (model.declarations or model.imports or model.optimizations):
        report.report(
            "empty-file",
            Span(source, 0, 0),
            help=Advice("declare something, `event Start : ...` for instance", "declare something"),
        )


def _report_cycles(files: list[File], report: Diagnostics) -> None:
    for file, imports in cycles(files, lambda file: file.imports):
        *earlier, last = imports
        report.report(
            "import-cycle",
            place_of(last),
            path=file.source.name,
            related=tuple(Label(place_of(step), "through this import") for step in earlier),
            help="move what both files need to a third one"
            if earlier
            else Advice("remove this import", "remove import"),
        )
