"""Open an output folder for changes: lock it and complete an interrupted build."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from swarmdsl.base.atomic_write import Staging
from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.records import replace
from swarmdsl.output import journal, manifest
from swarmdsl.output.apply import resume
from swarmdsl.output.changes import WriteOptions
from swarmdsl.output.disk import Disk, report_os_error
from swarmdsl.output.lock import locked
from swarmdsl.output.manifest import Manifest
from swarmdsl.output.plan import Plan


@contextmanager
def open_plan(out: Path, options: WriteOptions, report: Diagnostics) -> Iterator[Plan | None]:
    """Yield an empty plan for a folder; None if that is impossible.

    Completes an interrupted build first. Reports OSErrors. Creates the folder, which is needed for
    the lock, and removes it if nothing is written.
    """
    with Staging() as folders:
        if not (options.dry or options.check):
            with suppress(OSError):  # reported when something is written there
                folders.make_folder(out)
        with locked(out):
            plan = None
            with _reporting_os_errors(out, report):
                plan = _plan(Disk(out), options, report)
            with _reporting_os_errors(out, report):
                yield plan


@contextmanager
def _reporting_os_errors(out: Path, report: Diagnostics) -> Iterator[None]:
    try:
        yield
    except OSError as error:
        report_os_error(Path(error.filename or out), error, report)


def _plan(disk: Disk, options: WriteOptions, report: Diagnostics) -> Plan | None:
    listed = _read_manifest(disk, report)
    if listed is None:
        return None
    if options.dry or options.check:
        pending = journal.read(disk)
        if pending is not None and journal.must_be_completed(disk, pending):
            help_ = "build again: this completes the interrupted build first"
            report.report("interrupted-build", path=str(disk.out), help=help_)
            return None
    elif os.path.lexists(disk.out / journal.NAME):  # even a broken link
        # The interrupted command may be repeated unchanged.
        done = resume(disk)
        options = replace(
            options, renames=tuple(pair for pair in options.renames if pair not in done)
        )
        listed = _read_manifest(disk, report)
    return None if listed is None else Plan(disk, listed, options, report)


def _read_manifest(disk: Disk, report: Diagnostics) -> Manifest | None:
    """Read the manifest; None if it is unreadable, which is reported."""
    try:
        return manifest.read(disk.out)
    except (OSError, ValueError) as error:
        place = str(disk.out / manifest.NAME)
        reason = error.strerror if isinstance(error, OSError) else str(error)
        help_ = (
            "restore it from version control, or delete it: then only unedited files "
            "count as generated"
        )
        report.report("unreadable-list", path=place, reason=reason, help=help_)
        return None
