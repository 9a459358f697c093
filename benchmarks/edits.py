"""Measures how long it takes from an edit to all that is wrong then: of one large file, of many."""

from __future__ import annotations

import gc
import platform
import sys
from collections.abc import Sequence
from pathlib import Path
from random import Random
from statistics import median, quantiles
from tempfile import TemporaryDirectory
from time import perf_counter

from swarmdsl.workspace import Workspace

sys.path.insert(0, str(Path(__file__).parent))
from workspace import write  # noqa: E402 - the other benchmark

SEED = 11
EDITS = 60
LINES = 10_000
WORD = "Moved"


def keystrokes(text: str, dice: Random) -> list[str]:
    """The file after each of some keystrokes, most of which are in the middle of a word."""
    found = []
    while len(found) < EDITS:
        lines = text.splitlines(keepends=True)
        at = dice.randrange(len(lines))
        line = lines[at].rstrip("\n")
        column = dice.randrange(len(line) + 1)
        for end in range(1, len(WORD) + 1):
            typed = f"{line[:column]}{WORD[:end]}{line[column:]}\n"
            found.append("".join([*lines[:at], typed, *lines[at + 1 :]]))
        found.append(text)
    return found[:EDITS]


def measured(workspace: Workspace, path: Path, texts: Sequence[str]) -> list[float]:
    """The milliseconds from each text to all that is wrong with it."""
    times = []
    for text in texts:
        start = perf_counter()
        workspace.update({path: text})
        list(workspace.report)
        times.append((perf_counter() - start) * 1000)
        gc.collect()  # what an editor has time for between two keystrokes
    return times


def show(what: str, times: Sequence[float]) -> None:
    """Print a line of the table."""
    high = quantiles(times, n=20)[-1]
    figures = (min(times), median(times), high, max(times))
    print(f"{what:<34}" + "".join(f"{figure:>9.1f}" for figure in figures))


def main() -> None:
    """Measure and print."""
    print(f"Python {platform.python_version()}, milliseconds from an edit to the diagnostics")
    print(f"{'':<34}{'min':>9}{'median':>9}{'p95':>9}{'max':>9}")
    with TemporaryDirectory() as name:
        folder = Path(name)
        write(folder / "one", files=2, lines=LINES)
        write(folder / "many")
        for part, file in (("one", "area0.swarm"), ("many", "area7.swarm")):
            start = perf_counter()
            workspace = Workspace([folder / part])
            first = (perf_counter() - start) * 1000
            gc.collect()
            gc.freeze()
            path = folder / part / file
            text = path.read_text(encoding="utf-8")
            times = measured(workspace, path, keystrokes(text, Random(SEED)))
            show(f"{workspace.files} files, first run {first:.0f} ms", times)


if __name__ == "__main__":
    main()
