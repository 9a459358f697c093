"""Command `swarmc trace`: copy logs and add notes."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from io import FileIO
from pathlib import Path
from typing import BinaryIO

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.read_files import is_file, open_file
from swarmdsl.driver.config import find_settings
from swarmdsl.output import manifest
from swarmdsl.project.read_source import report_unreadable
from swarmdsl.tools.trace.annotations import Annotator
from swarmdsl.tools.trace.generated_files import OutputFolders, nearby_folders
from swarmdsl.tools.trace.stream import Tracer

_AT_ONCE = 1 << 16


def run(
    logs: Sequence[Path],
    outs: Sequence[Path],
    stdin: BinaryIO,
    stdout: BinaryIO,
    report: Diagnostics,
    *,
    colour: bool,
) -> None:
    """Write the logs with notes; without logs, read standard input.

    `outs` are output folders; without them, likely folders nearby are used. Unreadable logs and
    folders without source maps are reported.
    """
    here = Path()
    folders = OutputFolders(
        outs or (find_settings((), Diagnostics()).out, *nearby_folders(here.absolute()))
    )
    tracer = Tracer(folders, Annotator(colour))
    for data in _pieces(logs, stdin, report):
        stdout.write(tracer.feed(data))
        stdout.flush()
    stdout.write(tracer.end())
    stdout.flush()
    for out in outs:
        if not is_file(out / manifest.NAME):
            _report_missing(out, "nothing was built into it", report)
    for out in folders.unmapped:
        _report_missing(out, "it was built by a version of swarmc that wrote none", report)
    if not (outs or folders.found or folders.unmapped):
        hint = "name the output folder of `swarmc build`: `--out DIR`"
        reason = "nothing was built into it or beside the logged files"
        _report_missing(here, reason, report, hint)


def _pieces(logs: Sequence[Path], stdin: BinaryIO, report: Diagnostics) -> Iterator[bytes]:
    """Yield the content of the logs as it arrives."""
    if not logs:
        yield from _read(stdin)
    for path in logs:
        try:
            with open_file(path) as file:
                yield from _read(file)
        except OSError as error:
            report_unreadable(path, error, None, report, "a log")


def _read(stream: BinaryIO | FileIO) -> Iterator[bytes]:
    # `read1` returns available data; `read` would wait for the full amount.
    while data := getattr(stream, "read1", stream.read)(_AT_ONCE):
        yield data


def _report_missing(
    out: Path, reason: str, report: Diagnostics, hint: str = "build the model into it again"
) -> None:
    report.report("no-source-map", path=out, reason=reason, help=hint)
