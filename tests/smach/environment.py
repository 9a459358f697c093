"""Installation of the real SMACH, as far as a package index has it.

`python tests/smach/environment.py FOLDER` installs it there, once. `standalone-smach` is package
`smach` of SMACH 2.5.0 for ROS 1, without `smach_ros`: the stand-in for that remains.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

REQUIREMENT = "standalone-smach==0.0.9"
FOLDER = Path(__file__).resolve().parents[2] / ".smach"
STAND_IN = Path(__file__).resolve().parent / "stand_in"
_READY = "ready.txt"


def ready(folder: Path) -> bool:
    """Return True if it is installed."""
    mark = folder / _READY
    return mark.is_file() and mark.read_text() == REQUIREMENT


def installed(smach_ros: Path) -> tuple[Path, ...]:
    """Return the folders to import the real SMACH from, none if there is none.

    `smach_ros` is the folder to take that from if the real SMACH is without it.
    """
    named = os.environ.get("SWARMDSL_SMACH_PATH")
    if named is not None:
        folders = tuple(map(Path, named.split(os.pathsep)))
    elif ready(FOLDER):
        folders = (_source(FOLDER),)
    else:
        return ()
    if any((each / "smach_ros").is_dir() for each in folders):
        return folders
    return (*folders, smach_ros)


def make(folder: Path) -> None:
    """Install it, unless it is there."""
    if ready(folder):
        return
    source = _source(folder)
    shutil.rmtree(source, ignore_errors=True)
    pip = [sys.executable, "-m", "pip", "install", "--quiet", "--disable-pip-version-check"]
    with tempfile.TemporaryDirectory() as scratch:
        subprocess.run([*pip, "--no-deps", "--target", scratch, REQUIREMENT], check=True)
        shutil.copytree(Path(scratch, "smach"), source / "smach")
    # As in SMACH 2.5.1: Python 3.9 has renamed the method.
    concurrence = source / "smach" / "concurrence.py"
    text = concurrence.read_text(encoding="utf-8")
    concurrence.write_text(text.replace(".isAlive()", ".is_alive()"), encoding="utf-8")
    (folder / _READY).write_text(REQUIREMENT)


def _source(folder: Path) -> Path:
    """Return the folder to import from; manifests are looked for two levels above."""
    return folder / "smach" / "src"


if __name__ == "__main__":
    make(Path(sys.argv[1]).resolve())
