"""Redo log: apply changes of many files atomically, even if the process is killed.

The changes are written to the journal first. Then the new contents are staged beside their
destinations, the manifest last. Once that is staged, the changes are applied and can be resumed
any number of times: the content of its file shows if a step is done. Before that, the staged files
are only removed.
"""

from __future__ import annotations

import json
import os
from hashlib import sha256
from pathlib import Path

from swarmdsl.base.atomic_write import Staging
from swarmdsl.base.read_files import MOST_RECORDED, read_file
from swarmdsl.base.records import dataclass
from swarmdsl.base.relative_paths import stays_inside
from swarmdsl.output import manifest
from swarmdsl.output.changes import PARKED, Renames
from swarmdsl.output.disk import Disk
from swarmdsl.output.manifest import Manifest

NAME = ".swarmdsl.pending"

_NO_FILE = (FileNotFoundError, NotADirectoryError)


@dataclass(frozen=True)
class Step:
    """A file that is replaced or removed; paths are relative to the output folder.

    `before` and `after` are SHA-256 hashes of its content, None for no file. The new content is
    staged at `staged`. `source` is the file that is moved there, with the hash `of_source`.
    """

    path: str
    before: str | None
    after: str | None = None
    staged: str | None = None
    source: str | None = None
    of_source: str | None = None

    @property
    def paths(self) -> tuple[str, ...]:
        """All files that the step touches."""
        others = (self.staged, self.source)
        return (self.path, *(path for path in others if path is not None))


@dataclass(frozen=True)
class Journal:
    """Steps of a build; `listed` is the last one, of the manifest."""

    steps: tuple[Step, ...]
    listed: Step
    renames: Renames = ()


def fingerprint(content: bytes | None) -> str | None:
    """Hash the content of a file."""
    return None if content is None else sha256(content).hexdigest()


def to_bytes(journal: Journal) -> bytes:
    """Serialize a journal."""
    steps = [vars(step) for step in (*journal.steps, journal.listed)]
    return json.dumps({"steps": steps, "renames": journal.renames}).encode()


def read(disk: Disk) -> Journal | None:
    """Read the journal of a folder; None if it is missing or incomplete.

    It is written before anything else, so that an incomplete one means that nothing was changed.
    """
    try:
        stored = json.loads(read_file(disk.out / NAME, MOST_RECORDED))
        *steps, listed = (Step(**step) for step in stored["steps"])
        renames = tuple((str(old), str(new)) for old, new in stored["renames"])
        paths = [path for step in (*steps, listed) for path in step.paths]
        inside = all(_is_inside(disk, path) for path in paths)
    except (*_NO_FILE, ValueError, TypeError, KeyError, RecursionError):
        return None
    whole = inside and listed.staged is not None
    return Journal(tuple(steps), listed, renames) if whole else None


def _is_inside(disk: Disk, path: object) -> bool:
    return isinstance(path, str) and stays_inside(path) and disk.leads_inside(path)


def must_be_completed(disk: Disk, journal: Journal) -> bool:
    """Return True if everything was staged and the build was interrupted after that.

    The manifest is staged last, and is the last to be moved or the first to be removed.
    """
    return fingerprint(disk.content(_staged(journal.listed))) == journal.listed.after


def is_done(disk: Disk, journal: Journal) -> bool:
    """Return True if the new manifest is in place and differs from the old one."""
    before, after = journal.listed.before, journal.listed.after
    return before != after and fingerprint(disk.content(journal.listed.path)) == after


def complete(disk: Disk, journal: Journal, *, resumed: bool) -> list[str]:
    """Apply the changes; if `resumed`, some of them are applied already.

    Files that were changed in the meantime stay as they are; their paths are returned.
    """
    left = [step for step in journal.steps if not _arrive(disk, step, resumed)]
    for step in journal.steps:
        if step not in left:
            _clear(disk, step)
    if left:
        _write_manifest_without(disk, journal.listed, left)
    else:
        _arrive(disk, journal.listed, resumed)
    discard(disk, journal)
    return [step.path for step in left]


def discard(disk: Disk, journal: Journal) -> None:
    """Remove the staged files and the journal.

    The manifest goes first: without it, no step with a missing staged file counts as done.
    """
    for step in (journal.listed, *journal.steps):
        if step.staged is not None and os.path.lexists(disk.place(step.staged)):
            disk.remove(step.staged)
    disk.remove(NAME)


def _arrive(disk: Disk, step: Step, resumed: bool) -> bool:
    """Move staged content in place if needed; return True if the file is as expected."""
    now = fingerprint(disk.content(step.path))
    if step.staged is None:
        return now in (step.before, None)
    if resumed:
        staged = fingerprint(disk.content(step.staged))
        if staged is None:
            return now != step.before or step.before == step.after
        if staged != step.after:
            return False
    if now != step.before:
        return False
    place = disk.place(step.path)
    try:
        # `os.replace` is atomic on every system.
        os.replace(disk.place(step.staged), place)  # noqa: PTH105
    except OSError as error:
        error.filename, error.filename2 = str(Path(place)), None
        raise
    return True


def _clear(disk: Disk, step: Step) -> None:
    """Remove the old file of a step if it is unchanged."""
    gone, was = (step.path, step.before) if step.staged is None else (step.source, step.of_source)
    if gone is None or fingerprint(disk.content(gone)) != was:
        return
    arrived = gone != step.path and disk.content(step.path) is not None
    if gone == step.path or (arrived and not disk.same(gone, step.path)):
        disk.remove(gone)


def _staged(listed: Step) -> str:
    assert listed.staged is not None
    return listed.staged


def _write_manifest_without(disk: Disk, listed: Step, left: list[Step]) -> None:
    """Write the manifest with the old entries of the skipped steps."""
    before = manifest.read(disk.out)
    after = manifest.read(disk.out, _staged(listed))
    for path in {path for step in left for path in step.paths}:
        _as_before(path.removeprefix(f"{PARKED}/"), before, after)
    with Staging() as staging:
        staging.add(disk.out / listed.path, manifest.to_bytes(after))
        for _ in staging.move_in_place():
            pass


def _as_before(path: str, before: Manifest, after: Manifest) -> None:
    for then, now in (
        (before.files, after.files),
        (before.parked, after.parked),
        (before.owners, after.owners),
    ):
        now.pop(path, None)
        if path in then:
            now[path] = then[path]
