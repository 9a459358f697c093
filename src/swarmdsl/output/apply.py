"""Apply a plan, all or nothing; the next build completes an interrupted one.

All generated contents are staged before the first file is moved in place, and files are removed
last.
"""

from __future__ import annotations

from contextlib import ExitStack
from pathlib import Path

from swarmdsl.base.atomic_write import Staging
from swarmdsl.base.read_files import exists
from swarmdsl.output import journal, manifest, texts
from swarmdsl.output.changes import Action, Change, Renames
from swarmdsl.output.disk import Disk
from swarmdsl.output.journal import Journal, Step, fingerprint
from swarmdsl.output.plan import Plan
from swarmdsl.output.warnings import report_changed_meanwhile


def apply_plan(plan: Plan) -> None:
    """Change the files; raises OSError with the path in `filename`.

    A file that was changed since the plan was made stays as it is, and is reported. A failure
    after the first change is like an interruption.
    """
    if not _has_changes(plan):
        return
    disk = plan.disk
    packed, listed = _texts(plan), manifest.to_bytes(plan.manifest)
    arriving = [_own(disk, texts.NAME, packed)] if packed is not None else []
    arriving += [*plan.changes, _own(disk, manifest.NAME, listed)]
    with ExitStack() as until_all_is_staged:
        staging = until_all_is_staged.enter_context(Staging())
        places = {change.path: disk.out / change.path for change in arriving}
        steps = [_step(change, places[change.path], staging) for change in arriving]
        to_do = Journal(tuple(steps[:-1]), steps[-1], plan.options.renames)
        staging.make_folder(disk.out)
        until_all_is_staged.callback(disk.remove, journal.NAME)
        (disk.out / journal.NAME).write_bytes(journal.to_bytes(to_do))
        for change in arriving:
            if change.after is not None:
                place = places[change.path]
                staging.add(place, change.after, change.executable, change.mode)
        until_all_is_staged.pop_all()
    left = journal.complete(disk, to_do, resumed=False)
    plan.changes = [change for change in plan.changes if change.path not in left]
    for path in left:
        report_changed_meanwhile(disk.out / path, plan.report)


def resume(disk: Disk) -> Renames:
    """Complete an interrupted build, or remove what it staged.

    Returns the renames that are completed with it. Raises OSError like `apply_plan`.
    """
    found = journal.read(disk)
    if found is None:
        disk.remove(journal.NAME)
        return ()
    if journal.must_be_completed(disk, found):
        journal.complete(disk, found, resumed=True)
        return found.renames
    renames = found.renames if journal.is_done(disk, found) else ()
    journal.discard(disk, found)
    return renames


def _has_changes(plan: Plan) -> bool:
    listed = plan.manifest.files or plan.manifest.parked
    stored = exists(plan.disk.out / manifest.NAME) and not plan.texts.missing
    return bool(plan.changes or plan.manifest != plan.before or (listed and not stored))


def _own(disk: Disk, path: str, content: bytes) -> Change:
    """Return the change of a file that swarmc itself owns."""
    return Change(Action.CHANGE, path, disk.content(path), content)


def _step(change: Change, place: Path, staging: Staging) -> Step:
    """Return the journal step of a change, with the file contents it was planned for."""
    before = fingerprint(change.before)
    if change.after is None:
        return Step(change.path, before)
    folder, slash, _ = change.path.rpartition("/")
    staged = f"{folder}{slash}{staging.beside(place).name}"
    after = fingerprint(change.after)
    if change.source is None:
        return Step(change.path, before, after, staged)
    return Step(change.path, fingerprint(change.replaced), after, staged, change.source, before)


def _texts(plan: Plan) -> bytes | None:
    """Pack the contents that files are, or were until now, generated from."""
    manifests = (plan.before, plan.manifest)
    wanted = {
        hash_ for each in manifests for hash_ in (*each.files.values(), *each.parked.values())
    }
    marks = (owner.rpartition(" ")[2] for owner in plan.manifest.owners.values())
    return plan.texts.packed(wanted, marks)
