"""What becomes of the files of an output folder, as plain data."""

from __future__ import annotations

from enum import Enum
from pathlib import Path

from swarmdsl.base.records import dataclass

PARKED = ".parked"
"""The folder for files that are put aside. Tools of ROS pass over a folder of such a name."""

Renames = tuple[tuple[str, str], ...]
"""The old and the new name of elements of the model."""


class Action(Enum):
    """What happens to a file."""

    CREATE = "create"
    CHANGE = "change"
    MERGE = "merge"
    OVERWRITE = "overwrite"
    REMOVE = "remove"
    PARK = "park"
    RESTORE = "restore"
    MOVE = "move"


NEW_TEXT = (Action.CREATE, Action.CHANGE, Action.MERGE, Action.OVERWRITE)
"""What writes a file in its place; of the rest, all but REMOVE bring one from another place."""


@dataclass(frozen=True)
class Change:
    """A file that changes: its content before and after, None where there is none.

    Paths are below the output folder. `source` is where the file was, if that is another place;
    it is gone then. `mode` are the permissions of such a file, and `replaced` is what is in its
    new place until then.
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
        """The target that the file is, or was, of."""
        of = self.source if self.action is Action.PARK and self.source else self.path
        return of.partition("/")[0]


@dataclass(frozen=True)
class Written:
    """What becomes of each file, or became of it, as paths below the output folder.

    `kept` are files to fill in that are the user's by now, `edited` others that the user has
    written in, `conflicts` those of them in which what is new has no place. None of them changes.
    """

    folder: Path
    changes: tuple[Change, ...] = ()
    unchanged: tuple[str, ...] = ()
    kept: tuple[str, ...] = ()
    edited: tuple[str, ...] = ()
    conflicts: tuple[str, ...] = ()

    def paths(self, *actions: Action) -> tuple[str, ...]:
        """The files to which one of these things happens."""
        return tuple(change.path for change in self.changes if change.action in actions)

    @property
    def written(self) -> tuple[str, ...]:
        """The files that get a text of the generator."""
        return self.paths(*NEW_TEXT)

    @property
    def removed(self) -> tuple[str, ...]:
        """The files that were generated before and are not any more."""
        return self.paths(Action.REMOVE)


@dataclass(frozen=True)
class How:
    """How a folder is brought up to date.

    `force` gives up what the user has written where it is in the way, except in files that are
    the user's to fill in. `dry` changes nothing; `check` does not either, and reports what would
    change. `renames` are elements of the model that had another name. `command` are the words
    that a person would repeat, `model` what the model is called.
    """

    force: bool = False
    dry: bool = False
    check: bool = False
    renames: Renames = ()
    command: tuple[str, ...] = ("swarmc", "build")
    model: str = ""
