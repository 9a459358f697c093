"""`swarmc import`: from files of other tools to one model on disk or standard output."""

from __future__ import annotations

import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from swarmdsl import compiler
from swarmdsl.diagnostics import Diagnostics, Severity
from swarmdsl.format import formatted
from swarmdsl.importing import import_adf, import_scxml
from swarmdsl.naming import snake_case
from swarmdsl.printer import UnprintableError, print_system
from swarmdsl.reading import read_source
from swarmdsl.source import Source
from swarmdsl.staging import Staging


@dataclass(frozen=True)
class Imported:
    """What came of an import: the text of the model, None where there is none."""

    report: Diagnostics
    files: int
    text: str | None = None


def run(
    format_: Literal["scxml", "adf"],
    paths: Sequence[Path],
    described: Sequence[Path],
    out: Path | None,
    *,
    force: bool,
) -> Imported:
    """Read the files and write the model, unless something is wrong.

    The text is not written where the check of it would find an error.
    """
    report = Diagnostics()
    if out is not None and not force and out.exists():
        path = out.as_posix()
        way = "choose another name, or use `--force`"
        report.report("would-overwrite", path=path, reason="it exists already", help=way)
    sources = [read_source(path, None, report) for path in paths]
    adfs = [read_source(path, None, report) for path in described]
    files = len(paths) + len(described)
    if report.has_errors:
        return Imported(report, files)
    read, known = _present(sources), _present(adfs)
    name = _package(out or paths[0])
    if format_ == "adf":
        system = import_adf(read, name, report)
    else:
        system = import_scxml(read, known, name, report)
    if report.has_errors:
        return Imported(report, files)
    if not (system.machines or system.functions or system.components):
        report.report("nothing-to-import", path=paths[0].as_posix())
        return Imported(report, files)
    try:
        plain = print_system(system)
    except UnprintableError as fault:
        report.report("no-model", path=paths[0].as_posix(), reason=str(fault))
        return Imported(report, files)
    text = formatted(Source(f"{name}.swarm", plain), report) or plain
    _check(text, out or Path(f"{name}.swarm"), report)
    if not report.has_errors and out is not None:
        _write(out, text, report)
    return Imported(report, files, None if report.has_errors else text)


def _present(sources: Sequence[Source | None]) -> list[Source]:
    return [source for source in sources if source is not None]


def _package(path: Path) -> str:
    """The package of a model, after the file that it is in or comes from."""
    name = snake_case(path.name.partition(".")[0])
    return name if name[:1].isalpha() else f"model_{name}".rstrip("_")


def _check(text: str, out: Path, report: Diagnostics) -> None:
    """Report what is an error in the model that was made: it has no place in the files read."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / out.name
        path.write_text(text, encoding="utf-8")
        for found in compiler.check([path]).report:
            if found.severity is Severity.ERROR:
                line = (
                    found.primary.span.source.line_text(found.primary.span.line).strip()
                    if (found.primary is not None)
                    else ""
                )
                reason = f"{found.message} ({found.code}) in `{line}`"
                report.report("no-model", path=out.as_posix(), reason=reason)


def _write(out: Path, text: str, report: Diagnostics) -> None:
    try:
        with Staging() as staging:
            staging.add(out, text.encode())
            for _ in staging.move_in_place():
                pass
    except OSError as error:
        report.report("cannot-write", path=out.as_posix(), reason=error.strerror or str(error))
