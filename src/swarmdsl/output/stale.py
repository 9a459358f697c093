"""Report stale output as diagnostics, for `swarmc build --check`."""

from __future__ import annotations

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.output import manifest
from swarmdsl.output.changes import Action, Written
from swarmdsl.output.warnings import NEW, NOTE

_BUILD = "build again"
_EDITED = "build again, and put the edit into a region, a file of yours, or the model"
# Fault and fix of a file by its planned change.
_FAULTS = {
    Action.CREATE: ("is missing", _BUILD),
    Action.CHANGE: ("is out of date", _BUILD),
    Action.MERGE: ("has been edited, and is out of date", _EDITED),
    Action.REMOVE: ("is not generated any more", _BUILD),
    Action.PARK: (
        "is not generated any more, and has edits of yours",
        "build again to put it aside",
    ),
    Action.RESTORE: ("was put aside, and is generated again", _BUILD),
}


# The other remarks are about changes that a build made.
_LASTING = (
    "outdated-code",
    "renamed-element",
    "merge-conflict",
    "damaged-region",
    "other-model",
)


def report_stale(
    written: Written, manifest_changed: bool, remarks: Diagnostics, report: Diagnostics
) -> None:
    """Report each file that a build would change, and each edited generated file.

    `other_list` is True if the manifest would change. Notes beside files of the user are not
    output.
    """
    if manifest_changed and not written.changes:
        place = str(written.folder / manifest.NAME)
        report.report("stale-output", path=place, fault="is out of date", way=_BUILD)
    report.include(remark for remark in remarks if remark.name in _LASTING)
    for change in written.changes:
        if change.path.endswith((NEW, NOTE)):
            continue
        fault, way = _FAULTS[change.action]
        path = change.source if change.action is Action.PARK and change.source else change.path
        place = str(written.folder / path)
        report.report("stale-output", path=place, fault=fault, way=way)
    for path in written.edited:
        way = "put the edit into a region, a file of yours, or the model"
        place = str(written.folder / path)
        report.report("stale-output", path=place, fault="has been edited", way=way)
