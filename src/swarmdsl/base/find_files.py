"""The files below a folder."""

from __future__ import annotations

import os
from pathlib import Path


def files_below(folder: Path, ending: str) -> list[Path]:
    """The files below a folder whose names end so, in a stable order.

    Folders whose names begin with a dot are passed over: environments and caches, with files of
    others. So are those that vanish or cannot be read, as a build beside it makes and removes
    them. Links to folders are not followed.
    """
    found = []
    for place, folders, names in os.walk(folder):
        folders[:] = [each for each in folders if not each.startswith(".")]
        found += [Path(place, name) for name in names if name.endswith(ending)]
    return sorted(each for each in found if each.is_file())
