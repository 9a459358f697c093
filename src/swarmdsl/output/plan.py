"""Plan the changes of an output folder.

Nothing on disk changes: `swarmdsl.output.apply` does that.
"""

from __future__ import annotations

from contextlib import suppress
from functools import cached_property

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.read_files import exists
from swarmdsl.base.records import dataclass
from swarmdsl.codegen.api import OutputFile
from swarmdsl.output import user_regions, warnings
from swarmdsl.output.changes import PARKED, Action, Change, WriteOptions, Written
from swarmdsl.output.disk import Disk
from swarmdsl.output.manifest import Hashes, Manifest, content_hash
from swarmdsl.output.names import Names
from swarmdsl.output.source_maps import Maps, Positions
from swarmdsl.output.texts import Texts
from swarmdsl.output.warnings import NEW


@dataclass(frozen=True)
class Found:
    """Existing file: its content, and the hash of the content it was generated from.

    `source` is its path if it has to be moved; `names` is the rename of its element.
    """

    content: bytes
    base: str | None
    source: str | None = None
    names: Names | None = None


class Plan:
    """Planned changes of a folder; all paths are relative to it.

    `before` is the old manifest, `hashes` the files of the new one. Errors in `report` prevent all
    changes; `remarks` are reported along with the changes. `moved` maps a new path to its old one
    and the rename.
    """

    def __init__(
        self, disk: Disk, before: Manifest, options: WriteOptions, report: Diagnostics
    ) -> None:
        self.disk, self.before, self.options, self.report = disk, before, options, report
        self.remarks = Diagnostics()
        self.texts = Texts(disk.out)
        self.hashes: Hashes = {}
        self.parked = dict(before.parked)
        self.owners: dict[str, str] = {}
        self.maps: Maps = {}
        self.positions = Positions(disk.out)
        self.changes: list[Change] = []
        self.unchanged: list[str] = []
        self.kept: list[str] = []
        self.edited: list[str] = []
        self.conflicts: list[str] = []
        self.moved: dict[str, tuple[str, Names]] = {}

    @property
    def written(self) -> Written:
        """Changes of the files."""
        return Written(
            self.disk.out,
            tuple(self.changes),
            tuple(self.unchanged),
            tuple(self.kept),
            tuple(self.edited),
            tuple(self.conflicts),
        )

    @property
    def manifest(self) -> Manifest:
        """The new manifest."""
        model = self.options.model or self.before.model
        return Manifest(self.hashes, self.parked, self.owners, self.maps, model)

    def change(
        self,
        action: Action,
        path: str,
        before: bytes | None,
        after: bytes,
        file: OutputFile,
        source: str | None = None,
    ) -> None:
        """Write generated content, with the edits of the user."""
        replaced = None
        if source is not None:
            before, replaced = self.disk.content(source), self.disk.content(path)
        change = Change(action, path, before, after, source, file.executable, replaced=replaced)
        self.changes.append(change)

    def bring(self, path: str, found: Found, content: bytes) -> None:
        """Move a file to its new path."""
        assert found.source is not None
        action = Action.RESTORE if found.names is None else Action.MOVE
        mode = self.disk.mode(found.source)
        before, replaced = self.disk.content(found.source), self.disk.content(path)
        self.changes.append(
            Change(action, path, before, content, found.source, False, mode, replaced)
        )

    def add_beside(self, path: str, content: bytes) -> None:
        """Write a file beside another one, unless the user has edited it."""
        self.hashes[path] = content_hash(content)
        with suppress(OSError):
            old = self.disk.content(path)
            known = self.before.files.get(path)
            if old == content:
                self.unchanged.append(path)
            elif old is None:
                self.changes.append(Change(Action.CREATE, path, None, content))
            elif self.is_pristine(path, old, known):
                self.changes.append(Change(Action.CHANGE, path, old, content))
            else:
                # Its base stays the generated version that the user has seen.
                self.hashes[path] = known or self.texts.add("")
                self.edited.append(path)
                warnings.report_neighbour(self.disk.out / path, self.remarks)

    def is_pristine(self, path: str, content: bytes, base: str | None) -> bool:
        """Return True if a file is as swarmc wrote it, with empty user regions."""
        # The copy of a file that could not be merged contains its user regions.
        is_copy = path.endswith(NEW)
        return self.is_generated(content, base) and (is_copy or not user_regions.kept(content))

    def is_generated(self, content: bytes, base: str | None) -> bool:
        """Return True if a file is as swarmc wrote it, except in user regions."""
        return content_hash(content) == base or self.texts.knows(content)

    def is_inside(self, path: str) -> bool:
        """Return True if a path stays in the output folder; otherwise report it."""
        if self.leads_inside(path):
            return True
        warnings.report_link(self.disk.link_outside(path), path, self.report)
        return False

    def leads_inside(self, path: str) -> bool:
        """Return True if a path stays in the output folder, through all links."""
        return self.disk.leads_inside(path)

    @cached_property
    def parks(self) -> bool:
        """True if files were put aside."""
        return self.is_there(PARKED)

    def is_there(self, path: str) -> bool:
        """Return True if the path exists."""
        return exists(self.disk.out / path)
