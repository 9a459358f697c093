"""Times what an editor waits for: python benchmarks/recheck.py FOLDER FILE.

Prints the processor's seconds as JSON: `again` for a workspace that is checked again after an
edit of one file, `keys` for a file that is checked after each key.
"""

from __future__ import annotations

import gc
import json
import sys
from collections.abc import Sequence
from pathlib import Path
from time import process_time

from swarmdsl import compiler

EDITS = 5
KEYS = 40


def checked(paths: Sequence[Path]) -> float:
    """Check a model without errors; how long that took."""
    start = process_time()
    result = compiler.check(paths)
    taken = process_time() - start
    if result.report.has_errors:
        sys.exit("\n".join(found.message for found in result.report))
    return taken


def edited(file: Path, times: int, paths: Sequence[Path]) -> list[float]:
    """The times of checks, each after an edit: a letter more in a comment in the middle."""
    text = file.read_text(encoding="utf-8")
    place = text.index("/// ", len(text) // 2) + len("/// ")
    found = []
    for count in range(times):
        file.write_text(text[:place] + "x" * (count + 1) + text[place:], encoding="utf-8")
        found.append(checked(paths))
        gc.collect()
    return found


def main() -> None:
    """Print the times."""
    gc.disable()
    folder, single = map(Path, sys.argv[1:])
    paths = sorted(folder.iterdir())
    checked(paths)
    again = edited(paths[len(paths) // 2], EDITS, paths)
    checked([single])
    keys = edited(single, KEYS, [single])
    print(json.dumps({"again": again, "keys": keys}))


if __name__ == "__main__":
    main()
