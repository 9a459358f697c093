"""Files into memory: read, parse, follow imports."""

from __future__ import annotations

import os
from collections import deque
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from pathlib import Path

from swarmdsl.diagnostics import Diagnostics, Label
from swarmdsl.graph import cycles
from swarmdsl.parse import Parsed, parse
from swarmdsl.source import Source, Span
from swarmdsl.suggest import did_you_mean
from swarmdsl.syntax import Declaration, Import, Model

SUFFIX = ".swarm"


@dataclass(eq=False)
class File:
    """A file of the project; `imports` are the files it imports, where they could be read."""

    source: Source
    parsed: Parsed
    imports: list[tuple[Import, File]] = field(default_factory=list)

    @property
    def model(self) -> Model:
        """The syntax tree."""
        return self.parsed.model

    @property
    def package(self) -> str:
        """The name of the package, or of the file where it declares none."""
        if self.model.package is not None:
            return str(self.model.package.name)
        return Path(self.source.name).stem


@dataclass
class Project:
    """All files of a run: first those that no other imports, then what they import.

    So a folder and the one file in it that imports all others are the same project.
    """

    files: list[File] = field(default_factory=list)

    def declarations(self) -> Iterator[tuple[File, Declaration]]:
        """Every top-level declaration with its file."""
        for file in self.files:
            for declaration in file.model.declarations:
                yield file, declaration


def load(paths: Iterable[Path], report: Diagnostics) -> Project:
    """Read the files, those in the folders, and everything they import."""
    project = Project()
    known: dict[str, File | None] = {}
    work: deque[tuple[Path, File | None, Import | None]] = deque(
        (path, None, None) for path in _expanded(paths, report)
    )
    while work:
        path, importer, statement = work.popleft()
        identity = os.path.realpath(path)
        if identity not in known:
            file = _read(path, statement.path.span if statement else None, report)
            known[identity] = file
            if file is not None:
                project.files.append(file)
                work.extend(
                    (_relative(path, wanted.path), file, wanted) for wanted in file.model.imports
                )
        imported = known[identity]
        if importer is not None and statement is not None and imported is not None:
            importer.imports.append((statement, imported))
    _report_cycles(project, report)
    project.files = _in_import_order(project.files)
    return project


def _in_import_order(files: list[File]) -> list[File]:
    """Start with the files that no other imports, then level by level what they import."""
    imported = {target for file in files for _, target in file.imports}
    ordered = dict.fromkeys(file for file in files if file not in imported)
    work = deque(ordered)
    while work:
        for _, target in work.popleft().imports:
            if target not in ordered:
                ordered[target] = None
                work.append(target)
    ordered.update(dict.fromkeys(files))  # those of a cycle that nothing else leads to
    return list(ordered)


def _expanded(paths: Iterable[Path], report: Diagnostics) -> Iterator[Path]:
    """Replace each folder by the .swarm files below it, in a stable order."""
    for path in paths:
        if not os.path.isdir(path):  # noqa: PTH112 - takes any path, a far too long one too
            yield path
            continue
        found = sorted(inside for inside in path.rglob(f"*{SUFFIX}") if inside.is_file())
        if not found:
            report.report("nothing-to-compile", path=path)
        yield from found


def _relative(importer: Path, wanted: str) -> Path:
    """Where an import leads, as a person would write it from here."""
    return Path(os.path.normpath(importer.parent / wanted))


def _read(path: Path, at: Span | None, report: Diagnostics) -> File | None:
    """Read and parse a file; None when it cannot be read, which is reported at `at`."""
    if os.path.isdir(path):  # noqa: PTH112 - as above
        report.report("not-a-file", at, path=path, help="name a file in it")
        return None
    try:
        data = path.read_bytes()
    except FileNotFoundError:
        report.report("file-not-found", at, path=path, help=_similar_file(path))
        return None
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        report.report("unreadable-file", at, path=path, reason=reason.lower())
        return None
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        _report_encoding(path, at, data, error, report)
        return None
    if "\0" in text:
        report.report("not-text", at, path=path, help="this looks like a binary file")
        return None
    source = Source(str(path), _unified(text), path)
    before = len(report)
    parsed = parse(source, report)
    if not parsed.model.declarations and not parsed.model.imports and len(report) == before:
        report.report(
            "empty-file",
            Span(source, 0, 0),
            help="declare something, `event Start : ...` for instance",
        )
    return File(source, parsed)


def _report_encoding(
    path: Path, at: Span | None, data: bytes, error: UnicodeDecodeError, report: Diagnostics
) -> None:
    if data.startswith((b"\xff\xfe", b"\xfe\xff")):
        report.report("not-text", at, path=path, help="it looks like UTF-16: save it as UTF-8")
    elif b"\0" in data:
        report.report("not-text", at, path=path, help="this looks like a binary file")
    else:
        data = error.object  # without the byte order mark that may come first
        readable = _unified(data[: error.start].decode())
        rest = _unified(data[error.start :].decode(errors="replace"))
        source = Source(str(path), readable + rest, path)
        report.report(
            "not-text",
            Span(source, len(readable), len(readable) + 1),
            path=path,
            related=(Label(at, "imported here"),) if at else (),
            help="save it as UTF-8",
        )


def _unified(text: str) -> str:
    """The text with all ends of lines alike."""
    return text.replace("\r\n", "\n").replace("\r", "\n")


def _similar_file(path: Path) -> str | None:
    try:
        names = [entry.name for entry in path.parent.iterdir() if entry.suffix == SUFFIX]
    except OSError:
        return None
    return did_you_mean(path.name, names)


def _report_cycles(project: Project, report: Diagnostics) -> None:
    for file, imports in cycles(project.files, lambda file: file.imports):
        *way, last = imports
        report.report(
            "import-cycle",
            last.path.span,
            path=file.source.name,
            related=tuple(Label(step.path.span, "by way of this import") for step in way),
            help="move what both files need to a third one" if way else "remove this import",
        )
