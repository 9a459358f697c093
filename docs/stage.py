"""Copy the sources of the handbook to `build/handbook`: `python docs/stage.py`.

The pages keep their paths in the project, so that their links work as on a forge. Attributes
after the language of a code block are for the tests, and are removed.
"""

from __future__ import annotations

import re
import shutil
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
STAGE = ROOT / "build" / "handbook"
_SHOWN = (
    "*.md",
    "LICENSE",
    "docs/**/*",
    "examples/**/*",
    "generators/**/*.md",
    "editors/*/README.md",
)
# Source files that pages link to.
_LINKED = ("src/swarmdsl/driver/pipeline.py",)
_FENCE = re.compile(r"^(`{3,}\w+) [^\n]*$", re.MULTILINE)


def shown() -> Iterator[Path]:
    """Yield the files of the handbook."""
    for pattern in (*_SHOWN, *_LINKED):
        for path in sorted(ROOT.glob(pattern)):
            if path.is_file() and "node_modules" not in path.parts:
                yield path


def stage(folder: Path = STAGE) -> None:
    """Recreate the folder."""
    shutil.rmtree(folder, ignore_errors=True)
    for path in shown():
        _copy(path, folder / path.relative_to(ROOT))


def _copy(path: Path, place: Path) -> None:
    place.parent.mkdir(parents=True, exist_ok=True)
    if path.suffix == ".md":
        place.write_text(_FENCE.sub(r"\1", path.read_text(encoding="utf-8")), encoding="utf-8")
    else:
        shutil.copyfile(path, place)


if __name__ == "__main__":
    stage()
