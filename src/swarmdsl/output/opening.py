"""What every change of an output folder begins with: it is whole, and nobody else is at it."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from swarmdsl import manifest
from swarmdsl.dataclass import replace
from swarmdsl.diagnostics import Diagnostics
from swarmdsl.output import journal
from swarmdsl.output.carry_out import resume
from swarmdsl.output.changes import How
from swarmdsl.output.disk import Disk, report_os_error
from swarmdsl.output.lock import locked
from swarmdsl.output.plan import Plan


@contextmanager
def opened(out: Path, how: How, report: Diagnostics) -> Iterator[Plan | None]:
    """A plan for a folder, with nothing in it yet; None when something stands in the way.

    What an interrupted build had begun is completed before. An OSError inside is reported.
    """
    try:
        with locked(out):
            yield _plan(Disk(out), how, report)
    except OSError as error:
        report_os_error(Path(error.filename or out), error, report)


def _plan(disk: Disk, how: How, report: Diagnostics) -> Plan | None:
    if how.dry or how.check:
        pending = journal.read(disk)
        if pending is not None and journal.is_to_be_completed(disk, pending):
            help_ = "build, which completes that one first"
            report.report("interrupted-build", path=str(disk.out), help=help_)
            return None
    else:
        # The command that was interrupted may be repeated as it is.
        done = resume(disk)
        how = replace(how, renames=tuple(pair for pair in how.renames if pair not in done))
    try:
        return Plan(disk, manifest.read(disk.out), how, report)
    except (OSError, ValueError) as error:
        place = str(disk.out / manifest.NAME)
        reason = error.strerror if isinstance(error, OSError) else str(error)
        help_ = (
            "take it from version control; or delete it: then only files that are as swarmc "
            "wrote them count as generated"
        )
        report.report("unreadable-list", path=place, reason=reason, help=help_)
        return None
