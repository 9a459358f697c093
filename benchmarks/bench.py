"""Measure swarmdsl and comparable tools, and update docs/performance.md.

Usage: `python benchmarks/bench.py [GROUP[,GROUP...]] [--show]`

Default: all GROUPS. Each measured group replaces its block of the page; with `--show`, the page is
not changed.
"""

from __future__ import annotations

import re
import signal
import sys
from collections.abc import Callable
from pathlib import Path
from tempfile import TemporaryDirectory

import cold
import drawing
import editing
import engine
import experiments
import generation
import growth
import importing
import large
import parsing
import peers
import player
import ros1
import ros2
import simulation
import verification
import world
from measure import Section

PAGE = Path(__file__).resolve().parents[1] / "docs" / "performance.md"

GROUPS: dict[str, Callable[[Path], Section]] = {
    "parse": parsing.section,
    "cold": cold.section,
    "generation": generation.section,
    "workspace": large.section,
    "engine": engine.section,
    "simulate": simulation.section,
    "verify": verification.section,
    "world": world.section,
    "experiments": experiments.section,
    "lsp": editing.section,
    "import": importing.section,
    "diagram": drawing.section,
    "player": player.section,
    "growth": growth.section,
    "ros1": ros1.section,
    "ros2": ros2.section,
}


def main() -> None:
    """Measure the groups given on the command line."""
    words = [word for word in sys.argv[1:] if word != "--show"]
    names = [name for word in words for name in word.split(",") if name] or list(GROUPS)
    unknown = [name for name in names if name not in GROUPS]
    if unknown:
        sys.exit(f"no group {', '.join(unknown)}; there are {', '.join(GROUPS)}")
    # What a group has started ends with it, also if this process is ended.
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(128 + signal.SIGTERM))
    for name in names:
        with TemporaryDirectory() as folder:
            text = (
                f"Measured on {peers.surroundings()}.\n\n" + GROUPS[name](Path(folder)).markdown()
            )
        print(f"## {name}\n\n{text}", flush=True)
        if "--show" not in sys.argv:
            page = PAGE.read_text(encoding="utf-8")
            PAGE.write_text(replaced(page, name, text), encoding="utf-8")


def replaced(page: str, name: str, text: str) -> str:
    """Replace the block of a group in the page."""
    begin, end = f"<!-- bench {name} -->", f"<!-- end of {name} -->"
    block = re.compile(f"{re.escape(begin)}\n.*?{re.escape(end)}", re.DOTALL)
    made, count = block.subn(lambda _: f"{begin}\n\n{text}\n{end}", page)
    if count != 1:
        sys.exit(f"{PAGE.name} has no block for {name}")
    return made


if __name__ == "__main__":
    main()
