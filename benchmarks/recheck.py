"""Time checks after edits.

Usage: `python benchmarks/recheck.py FOLDER FILE`

Prints the CPU seconds from a key to its diagnostics as JSON: `again` for keys in one of many files,
`keys` for keys in one large file.
"""

from __future__ import annotations

import gc
import json
import sys
from collections.abc import Sequence
from pathlib import Path
from random import Random
from time import process_time

from swarmdsl.driver.workspace import Workspace

SEED = 11
KEYS = 60
WORD = "Moved"


def keystrokes(text: str) -> list[str]:
    """Return the text after each key, as a word is typed and deleted in many places."""
    dice = Random(SEED)
    found = []
    while len(found) < KEYS:
        at = dice.randrange(len(text))
        found += [text[:at] + WORD[:end] + text[at:] for end in range(1, len(WORD) + 1)]
        found.append(text)
    return found[:KEYS]


def times(paths: Sequence[Path], file: Path) -> list[float]:
    """Return the seconds of the check after each key in a file of a model."""
    workspace = Workspace(paths)
    if workspace.report.has_errors:
        sys.exit("\n".join(found.message for found in workspace.report))
    gc.collect()
    gc.freeze()
    found = []
    for text in keystrokes(file.read_text(encoding="utf-8")):
        start = process_time()
        workspace.update({file: text})
        list(workspace.report)
        found.append(process_time() - start)
        gc.collect()  # runs between two keys
    gc.unfreeze()
    return found


def main() -> None:
    """Print the times."""
    gc.disable()
    folder, single = map(Path, sys.argv[1:])
    paths = sorted(folder.iterdir())
    print(
        json.dumps({"again": times(paths, paths[len(paths) // 2]), "keys": times([single], single)})
    )


if __name__ == "__main__":
    main()
