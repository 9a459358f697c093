"""Does what was decided: all files are written beside their places first, and then moved there.

When it is interrupted, each file is as it was or as it is to be, and the next build goes on: the
texts that are generated are known before the first of them is in its place, and what goes away
goes when all else is there.
"""

from __future__ import annotations

from contextlib import suppress

from swarmdsl import manifest
from swarmdsl.manifest import Manifest, content_hash
from swarmdsl.output.changes import Change
from swarmdsl.output.plan import Plan
from swarmdsl.staging import Staging


def carry_out(plan: Plan) -> None:
    """Change the files; OSError when that fails, its `filename` is the file."""
    out, before, after = plan.disk.out, plan.before, plan.manifest
    list_file = out / manifest.NAME
    listed = after.files or after.parked
    changed = after != before or (listed and not list_file.exists())
    arriving = [change for change in plan.changes if change.after is not None]
    with Staging() as staging, Staging() as last:
        if changed or arriving or (listed and plan.texts.missing):
            marks = (owner.rpartition(" ")[2] for owner in after.owners.values())
            plan.texts.stage(_known(plan), marks, staging)
        for change in arriving:
            assert change.after is not None
            staging.add(out / change.path, change.after, change.executable, change.mode)
        if changed:
            last.add(list_file, manifest.to_bytes(after))
        done = dict(before.files)
        try:
            for place in staging.move_in_place():
                path = place.relative_to(out).as_posix()
                if path in after.files:
                    done[path] = after.files[path]
            for change in plan.changes:
                _clear(plan, change)
            for _ in last.move_in_place():
                pass
        except BaseException:
            if done != before.files:
                parked, maps = {**before.parked, **after.parked}, {**before.maps, **after.maps}
                _save_what_is_done(plan, Manifest(done, parked, after.owners, maps))
            raise


def _known(plan: Plan) -> set[str]:
    """The hashes of the texts that files are made from, or were until now."""
    manifests = (plan.before, plan.manifest)
    wanted = {
        hash_ for each in manifests for hash_ in (*each.files.values(), *each.parked.values())
    }
    # What an interrupted build has left is in neither.
    wanted |= {content_hash(change.before) for change in plan.changes if change.before is not None}
    return wanted


def _clear(plan: Plan, change: Change) -> None:
    if change.source is not None:
        plan.disk.remove(change.source)
    elif change.after is None:
        plan.disk.remove(change.path)


def _save_what_is_done(plan: Plan, done: Manifest) -> None:
    """Keep the list true when only some files could be replaced, as far as that is possible."""
    with suppress(OSError), Staging() as staging:
        staging.add(plan.disk.out / manifest.NAME, manifest.to_bytes(done))
        for _ in staging.move_in_place():
            pass
