"""`swarmc trace`: from logs to the same logs with notes."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import BinaryIO

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.driver.config import find_settings
from swarmdsl.output import manifest
from swarmdsl.project.read_source import read_bytes
from swarmdsl.tools.trace.annotations import Notes
from swarmdsl.tools.trace.generated_files import Folders, nearby
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
    """Write the logs with notes; the standard input where none is named.

    `outs` are output folders, those that are likely here where none is named. What cannot be
    read and what has no source maps is reported.
    """
    here = Path()
    folders = Folders(outs or (find_settings((), Diagnostics()).out, *nearby(here.absolute())))
    tracer = Tracer(folders, Notes(colour))
    for data in _pieces(logs, stdin, report):
        stdout.write(tracer.feed(data))
        stdout.flush()
    stdout.write(tracer.end())
    stdout.flush()
    for out in outs:
        if not (out / manifest.NAME).is_file():
            _report_missing(out, "nothing was built into it", report)
    for out in folders.unmapped:
        _report_missing(out, "it was built by a swarmc that wrote none", report)
    if not (outs or folders.found or folders.unmapped):
        hint = "name the folder that `swarmc build` has written to: `--out DIR`"
        _report_missing(here, "nothing was built into it, nor where logged files lie", report, hint)


def _pieces(logs: Sequence[Path], stdin: BinaryIO, report: Diagnostics) -> Iterator[bytes]:
    """What is in the logs, as soon as it is there."""
    if not logs:
        yield from _read(stdin)
    for path in logs:
        try:
            file = path.open("rb")
        except (OSError, ValueError):
            read_bytes(path, None, report, "a log")  # which says what is wrong
            continue
        with file:
            yield from _read(file)


def _read(stream: BinaryIO) -> Iterator[bytes]:
    # `read1` gives what has come, where `read` would wait for all that was asked for.
    while data := getattr(stream, "read1", stream.read)(_AT_ONCE):
        yield data


def _report_missing(
    out: Path, reason: str, report: Diagnostics, hint: str = "build the model again into it"
) -> None:
    report.report("no-source-map", path=out, reason=reason, help=hint)
