"""Changes of the files in an output folder, as plain data."""

from __future__ import annotations

from enum import Enum
from pathlib import Path

from swarmdsl.base.records import dataclass

PARKED = ".parked"
"""Folder for files that are put aside; ROS tools skip folders with such a name."""

Renames = tuple[tuple[str, str], ...]
"""Old and new names of model elements."""


class Action(Enum):
    """Kind of change of a file."""

    CREATE = "create"
    CHANGE = "change"
    MERGE = "merge"
    OVERWRITE = "overwrite"
    REMOVE = "remove"
    PARK = "park"
    RESTORE = "restore"
    MOVE = "move"


NEW_TEXT = (Action.CREATE, Action.CHANGE, Action.MERGE, Action.OVERWRITE)
"""Actions that write generated content; the others, except REMOVE, move a file."""


@dataclass(frozen=True)
class Change:
    """Change of a file: its content before and after, None if there is no file.

    Paths are relative to the output folder. `source` is the old path of a moved file, with the
    permissions `mode`; `replaced` is the content at the new path before the move.
    """

    action: Action
    path: str
    before: bytes | None
    after: bytes | None
    source: str | None = None
    executable: bool = False
    mode: int | None = None
    replaced: bytes | None = None

    @property
    def target(self) -> str:
        """Target of the file, before it was put aside."""
        of = self.source if self.action is Action.PARK and self.source else self.path
        return of.partition("/")[0]


@dataclass(frozen=True)
class Written:
    """Planned or applied changes, with paths relative to the output folder.

    `kept` are files to fill in that the user has filled in, `edited` are other files that the user
    has edited, `conflicts` are edited files that could not be merged. None of them changes.
    """

    folder: Path
    changes: tuple[Change, ...] = ()
    unchanged: tuple[str, ...] = ()
    kept: tuple[str, ...] = ()
    edited: tuple[str, ...] = ()
    conflicts: tuple[str, ...] = ()

    def paths(self, *actions: Action) -> tuple[str, ...]:
        """Return the files changed by one of the actions."""
        return tuple(change.path for change in self.changes if change.action in actions)

    @property
    def written(self) -> tuple[str, ...]:
        """Files that get generated content."""
        return self.paths(*NEW_TEXT)

    @property
    def removed(self) -> tuple[str, ...]:
        """Files that are not generated any more."""
        return self.paths(Action.REMOVE)


@dataclass(frozen=True)
class WriteOptions:
    """Options of writing to an output folder.

    `force` discards edits of the user that are in the way, except in files to fill in. `dry`
    changes nothing; `check` changes nothing and reports what would change. `renames` are renamed
    model elements. `command` is the command line to show in hints, `model` the name of the model.
    """

    force: bool = False
    dry: bool = False
    check: bool = False
    renames: Renames = ()
    command: tuple[str, ...] = ("swarmc", "build")
    model: str = ""
