"""Search of folders."""

from __future__ import annotations

import os
from pathlib import Path


def files_below(folder: Path, ending: str) -> list[Path]:
    """Return the files below a folder with an ending, sorted.

    Folders whose names begin with a dot, such as environments and caches, are skipped, and so are
    files and folders that vanish or cannot be read while another program changes them. Links to
    folders are not followed.
    """
    found = []
    for place, folders, names in os.walk(folder):
        folders[:] = [each for each in folders if not each.startswith(".")]
        found += [Path(place, name) for name in names if name.endswith(ending)]
    return sorted(each for each in found if each.is_file())
