"""What is to be done in an output folder, and the steps that it is made of.

Nothing on disk changes: `swarmdsl.output.apply` does that.
"""

from __future__ import annotations

from contextlib import suppress
from functools import cached_property

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.records import dataclass
from swarmdsl.codegen.api import OutputFile
from swarmdsl.output import user_regions, warnings
from swarmdsl.output.changes import PARKED, Action, Change, How, Written
from swarmdsl.output.disk import Disk
from swarmdsl.output.manifest import Hashes, Manifest, content_hash
from swarmdsl.output.names import Names
from swarmdsl.output.source_maps import Maps, Positions
from swarmdsl.output.texts import Texts
from swarmdsl.output.warnings import NEW


@dataclass(frozen=True)
class Found:
    """What stands for a file: its content, and the hash of the text that it was made from.

    `source` is where it is, if not in its place; `names` how its element was called before.
    """

    content: bytes
    base: str | None
    source: str | None = None
    names: Names | None = None


class Plan:
    """What is to be done in a folder; all paths are below it.

    `before` is the manifest as it was, `hashes` the files of it as they will be. What is found
    goes to `report`, and nothing may be done where that is an error; `remarks` are told beside
    what is done. `moved` says of a file under a new name where it is, and how it is called anew.
    """

    def __init__(self, disk: Disk, before: Manifest, how: How, report: Diagnostics) -> None:
        self.disk, self.before, self.how, self.report = disk, before, how, report
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
        """What becomes of the files."""
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
        """The list as it will be."""
        model = self.how.model or self.before.model
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
        """Write a text of the generator, with what is the user's in it."""
        replaced = None
        if source is not None:
            before, replaced = self.disk.content(source), self.disk.content(path)
        change = Change(action, path, before, after, source, file.executable, replaced=replaced)
        self.changes.append(change)

    def bring(self, path: str, found: Found, content: bytes) -> None:
        """Put a file in its place that is in another one."""
        assert found.source is not None
        action = Action.RESTORE if found.names is None else Action.MOVE
        mode = self.disk.mode(found.source)
        before, replaced = self.disk.content(found.source), self.disk.content(path)
        self.changes.append(
            Change(action, path, before, content, found.source, False, mode, replaced)
        )

    def add_neighbour(self, path: str, content: bytes) -> None:
        """Write a file beside another one, if the user has not written in it."""
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
                # What the user has seen of what is generated is in it, and nothing newer.
                self.hashes[path] = known or self.texts.add("")
                self.edited.append(path)
                warnings.report_neighbour(self.disk.out / path, self.remarks)

    def is_pristine(self, path: str, content: bytes, base: str | None) -> bool:
        """Whether a file is as swarmc wrote it, with no line of the user in a region."""
        # What would be in place of another file has the lines from there.
        is_copy = path.endswith(NEW)
        return self.is_generated(content, base) and (is_copy or not user_regions.kept(content))

    def is_generated(self, content: bytes, base: str | None) -> bool:
        """The same, but for what is in regions."""
        return content_hash(content) == base or self.texts.knows(content)

    def is_inside(self, path: str) -> bool:
        """Whether a file is in the output folder, whatever links lead there; if not, report it."""
        if self.leads_inside(path):
            return True
        warnings.report_link(self.disk.link_outside(path), path, self.report)
        return False

    def leads_inside(self, path: str) -> bool:
        """The same without a report."""
        return self.disk.leads_inside(path)

    @cached_property
    def parks(self) -> bool:
        """Whether there is anything that was put aside."""
        return self.is_there(PARKED)

    def is_there(self, path: str) -> bool:
        """Whether there is something of that name."""
        return (self.disk.out / path).exists()
