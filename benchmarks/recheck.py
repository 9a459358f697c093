"""Times what an editor waits for: python benchmarks/recheck.py FOLDER FILE.

Prints the processor's seconds from a key to all that is wrong then, as JSON: `again` for keys
in one file of a workspace, `keys` for keys in a file of its own.
"""

from __future__ import annotations

import gc
import json
import sys
from collections.abc import Iterator
from pathlib import Path
from random import Random
from time import process_time

from swarmdsl.workspace import Workspace

SEED = 11
PLACES = 12
WORD = "Moved"


def typed(text: str) -> Iterator[str]:
    """The text after each key: a word is typed somewhere, and taken back; most are mistakes."""
    random = Random(SEED)
    for _ in range(PLACES):
        at = random.randrange(len(text) + 1)
        for end in range(1, len(WORD) + 1):
            yield text[:at] + WORD[:end] + text[at:]
        yield text


def times(workspace: Workspace, file: Path) -> list[float]:
    """The time of each key in a file of the workspace."""
    found = []
    for text in typed(file.read_text(encoding="utf-8")):
        start = process_time()
        workspace.update({file: text})
        list(workspace.report)
        found.append(process_time() - start)
        gc.collect()  # as an editor does between two keys
    return found


def opened(*paths: Path) -> Workspace:
    """A workspace without mistakes."""
    workspace = Workspace(paths)
    if workspace.report.has_errors:
        sys.exit("\n".join(found.message for found in workspace.report))
    gc.collect()
    gc.freeze()
    return workspace


def main() -> None:
    """Print the times."""
    folder, single = map(Path, sys.argv[1:])
    files = sorted(folder.glob("area*.swarm"))
    again = times(opened(folder), files[len(files) // 2])
    keys = times(opened(single), single)
    print(json.dumps({"again": again, "keys": keys}))


if __name__ == "__main__":
    main()
