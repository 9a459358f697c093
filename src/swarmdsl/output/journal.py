"""Changes of many files that are made all or not at all, whatever ends the process of a build.

It is a redo log, as databases have them. What is to be done is written down first; then the new
contents are staged beside the places that they are for, that of the list of files as the last.
From there on the changes are made, however often that is interrupted: a step that was done is
seen by its file. Before, what was staged is only removed.
"""

from __future__ import annotations

import json
import os
from hashlib import sha256
from pathlib import Path

from swarmdsl.base.atomic_write import Staging
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
    """A file that gets another content, or goes; paths are below the output folder.

    `before` and `after` are the SHA-256 of what is in it, None where there is no file. The new
    content is at `staged` until then. `source` is the file that goes for it, with such a hash.
    """

    path: str
    before: str | None
    after: str | None = None
    staged: str | None = None
    source: str | None = None
    of_source: str | None = None

    @property
    def paths(self) -> tuple[str, ...]:
        """All files that it is about."""
        others = (self.staged, self.source)
        return (self.path, *(path for path in others if path is not None))


@dataclass(frozen=True)
class Journal:
    """What a build is to do: the steps, the last of them the list of files."""

    steps: tuple[Step, ...]
    listed: Step
    renames: Renames = ()


def fingerprint(content: bytes | None) -> str | None:
    """What tells one content of a file from another."""
    return None if content is None else sha256(content).hexdigest()


def to_bytes(journal: Journal) -> bytes:
    """A journal as it is stored."""
    steps = [vars(step) for step in (*journal.steps, journal.listed)]
    return json.dumps({"steps": steps, "renames": journal.renames}).encode()


def read(disk: Disk) -> Journal | None:
    """The journal in a folder; None where there is none, or none that is whole.

    It is stored before anything else is done, so that one with an end missing says nothing.
    """
    try:
        stored = json.loads((disk.out / NAME).read_bytes())
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


def is_to_be_completed(disk: Disk, journal: Journal) -> bool:
    """Whether all was staged when the build was interrupted, and not all done.

    The list is staged after all else. It arrives as the last, or is removed as the first.
    """
    return fingerprint(disk.content(_staged(journal.listed))) == journal.listed.after


def is_done(disk: Disk, journal: Journal) -> bool:
    """Whether the list has arrived, which tells that only where it is another one than before."""
    before, after = journal.listed.before, journal.listed.after
    return before != after and fingerprint(disk.content(journal.listed.path)) == after


def complete(disk: Disk, journal: Journal, *, resumed: bool) -> list[str]:
    """Make the changes that are not made yet; some are made where it is `resumed`.

    A file that somebody has changed since then stays, and counts as what it was before: these are
    returned.
    """
    left = [step for step in journal.steps if not _arrive(disk, step, resumed)]
    for step in journal.steps:
        if step not in left:
            _clear(disk, step)
    if left:
        _list_without(disk, journal.listed, left)
    else:
        _arrive(disk, journal.listed, resumed)
    discard(disk, journal)
    return [step.path for step in left]


def discard(disk: Disk, journal: Journal) -> None:
    """Remove what is staged yet, and the journal.

    The list goes first: without it, no step whose new content is gone is taken for one that was
    done.
    """
    for step in (journal.listed, *journal.steps):
        if step.staged is not None and os.path.lexists(disk.place(step.staged)):
            disk.remove(step.staged)
    disk.remove(NAME)


def _arrive(disk: Disk, step: Step, resumed: bool) -> bool:
    """Put the new content in its place, if it is not there; whether all is as was expected."""
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
        # `os.replace` is the one move that is atomic on every system.
        os.replace(disk.place(step.staged), place)  # noqa: PTH105
    except OSError as error:
        error.filename, error.filename2 = str(Path(place)), None
        raise
    return True


def _clear(disk: Disk, step: Step) -> None:
    """Remove the file that goes, if it is as it was."""
    gone, was = (step.path, step.before) if step.staged is None else (step.source, step.of_source)
    if gone is None or fingerprint(disk.content(gone)) != was:
        return
    arrived = gone != step.path and disk.content(step.path) is not None
    if gone == step.path or (arrived and not disk.same(gone, step.path)):
        disk.remove(gone)


def _staged(listed: Step) -> str:
    assert listed.staged is not None
    return listed.staged


def _list_without(disk: Disk, listed: Step, left: list[Step]) -> None:
    """Write the list, in which some files are as they were."""
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
