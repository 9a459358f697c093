"""What every change of an output folder begins with: it is whole, and nobody else is at it."""

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
from swarmdsl.output.changes import How
from swarmdsl.output.disk import Disk, report_os_error
from swarmdsl.output.lock import locked
from swarmdsl.output.manifest import Manifest
from swarmdsl.output.plan import Plan


@contextmanager
def opened(out: Path, how: How, report: Diagnostics) -> Iterator[Plan | None]:
    """A plan for a folder, with nothing in it yet; None when something stands in the way.

    What an interrupted build had begun is completed before. An OSError is reported. The folder is
    made before, for there is nothing else to lock; it goes again where nothing is written to it.
    """
    with Staging() as folders:
        if not (how.dry or how.check):
            with suppress(OSError):  # which is told of when something is to be written there
                folders.make_folder(out)
        with locked(out):
            plan = None
            with _told(out, report):
                plan = _plan(Disk(out), how, report)
            with _told(out, report):
                yield plan


@contextmanager
def _told(out: Path, report: Diagnostics) -> Iterator[None]:
    try:
        yield
    except OSError as error:
        report_os_error(Path(error.filename or out), error, report)


def _plan(disk: Disk, how: How, report: Diagnostics) -> Plan | None:
    listed = _listed(disk, report)
    if listed is None:
        return None
    if how.dry or how.check:
        pending = journal.read(disk)
        if pending is not None and journal.is_to_be_completed(disk, pending):
            help_ = "build, which completes that one first"
            report.report("interrupted-build", path=str(disk.out), help=help_)
            return None
    elif os.path.lexists(disk.out / journal.NAME):  # even a link that leads nowhere
        # The command that was interrupted may be repeated as it is.
        done = resume(disk)
        how = replace(how, renames=tuple(pair for pair in how.renames if pair not in done))
        listed = _listed(disk, report)
    return None if listed is None else Plan(disk, listed, how, report)


def _listed(disk: Disk, report: Diagnostics) -> Manifest | None:
    """The list of files; None where it cannot be read, which is reported."""
    try:
        return manifest.read(disk.out)
    except (OSError, ValueError) as error:
        place = str(disk.out / manifest.NAME)
        reason = error.strerror if isinstance(error, OSError) else str(error)
        help_ = (
            "take it from version control; or delete it: then only files that are as swarmc "
            "wrote them count as generated"
        )
        report.report("unreadable-list", path=place, reason=reason, help=help_)
        return None
