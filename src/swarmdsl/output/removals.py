"""Remove files that are not generated any more, or put them aside if edited."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from contextlib import contextmanager, suppress

from swarmdsl.base.relative_paths import clash_key
from swarmdsl.output import warnings
from swarmdsl.output.changes import PARKED, Action, Change
from swarmdsl.output.disk import UnreadableError, report_os_error
from swarmdsl.output.plan import Plan


def drop_stale(plan: Plan, targets: Collection[str]) -> None:
    """Plan the removal of the stale files of these targets."""
    for path in [path for path in plan.parked if not plan.is_there(f"{PARKED}/{path}")]:
        del plan.parked[path]
    new = {clash_key(path): path for path in plan.hashes}
    # A set: to look through all new paths for each old one is a product.
    present = {*plan.hashes, *(source for source, _ in plan.moved.values())}
    for path, old in plan.before.files.items():
        if path.partition("/")[0] not in targets:
            plan.hashes[path] = old
        elif path not in present:
            _drop(plan, path, old, new.get(clash_key(path)))
    _keep_entries(plan)


def remove_generated(plan: Plan, targets: Collection[str]) -> None:
    """Plan the removal of all unedited files of these targets."""
    for path, hash_ in plan.before.files.items():
        plan.hashes[path] = hash_
        if path.partition("/")[0] in targets and plan.is_inside(path):
            with _reporting_unreadable(plan, path):
                _remove(plan, path, hash_)
    _keep_entries(plan)


def _remove(plan: Plan, path: str, hash_: str) -> None:
    content = plan.disk.content(path)
    if content is None:
        del plan.hashes[path]
        return
    if plan.disk.is_link(path) or not plan.is_pristine(path, content, hash_):
        plan.edited.append(path)
        return
    del plan.hashes[path]
    plan.changes.append(Change(Action.REMOVE, path, content, None))


@contextmanager
def _reporting_unreadable(plan: Plan, path: str) -> Iterator[None]:
    """Report unreadable files; anything else than a file is not from swarmc."""
    with suppress(OSError):
        try:
            yield
        except UnreadableError as error:
            report_os_error(plan.disk.out / path, error, plan.report)


def _keep_entries(plan: Plan) -> None:
    """Keep the manifest entries of files that were not processed."""
    for path, owner in plan.before.owners.items():
        if path in plan.hashes or path in plan.parked:
            plan.owners.setdefault(path, owner)
    for path, map_ in plan.before.maps.items():
        if path in plan.hashes:
            plan.maps.setdefault(path, map_)


def _drop(plan: Plan, path: str, old: str, successor: str | None) -> None:
    """Remove a file, or put it aside if it was edited."""
    with _reporting_unreadable(plan, path):
        if plan.disk.is_link(path) or not plan.leads_inside(path):
            return
        if successor is not None and plan.disk.same(path, successor):
            return  # one file under two names, on a case-insensitive file system
        content = plan.disk.content(path)
        if content is None:
            return
        if plan.is_pristine(path, content, old):
            plan.changes.append(Change(Action.REMOVE, path, content, None))
        else:
            _park(plan, path, content, old)


def _park(plan: Plan, path: str, content: bytes, old: str) -> None:
    aside, number = f"{PARKED}/{path}", 1
    while plan.is_there(aside) and plan.disk.content(aside) != content:
        aside, number = f"{PARKED}/{path}.{number}", number + 1
    if not plan.is_inside(aside):
        return
    plan.parked[aside.removeprefix(f"{PARKED}/")] = old
    mode, replaced = plan.disk.mode(path), plan.disk.content(aside)
    change = Change(Action.PARK, aside, content, content, path, mode=mode, replaced=replaced)
    plan.changes.append(change)
    out = plan.disk.out
    warnings.report_parked(out / path, out / aside, plan.remarks)
