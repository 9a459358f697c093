"""Build what the extension brings: the server, and the sources of swarmdsl to install.

`python editors/vscode/bundle/make.py` fills the folder `server`, which an interpreter can run. All
of it is pure Python, so one extension serves every platform and every Python from 3.10. Compiled
packages and those that only generators import are left out: this copy serves editors and builds
nothing. `swarmdsl.zip` has the whole package, for pip to install where one asks for it. The same
checkout gives the same files.
"""

from __future__ import annotations

import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
EXTENSION = HERE.parent
ROOT = HERE.parents[2]
REQUIREMENTS = HERE / "requirements.txt"
WHEELS = EXTENSION / ".wheels"
ARCHIVE = EXTENSION / "swarmdsl.zip"
SERVER = EXTENSION / "server"

# What pip needs to build the package.
_SOURCES = (
    *("pyproject.toml", "README.md", "LICENSE", "docs/swarmc.1"),
    *("src/swarmdsl", "grammar", "generators"),
)
# Installation records of a wheel; its licence stays.
_RECORDS = {"RECORD", "WHEEL", "entry_points.txt", "top_level.txt"}


def make() -> None:
    """Recreate the folder and the archive."""
    shutil.rmtree(SERVER, ignore_errors=True)
    for wheel in _wheels():
        with zipfile.ZipFile(wheel) as archive:
            for name in archive.namelist():
                if not (".dist-info/" in name and Path(name).name in _RECORDS):
                    archive.extract(name, SERVER)
    made = shutil.ignore_patterns("__pycache__")
    shutil.copytree(ROOT / "src" / "swarmdsl", SERVER / "swarmdsl", ignore=made)
    shutil.copytree(ROOT / "grammar", SERVER / "swarmdsl" / "grammar")
    shutil.copy(HERE / "main.py", SERVER / "__main__.py")
    _archive()


def _archive() -> None:
    """Write the archive of the sources."""
    found = [path for name in _SOURCES for path in (ROOT / name, *(ROOT / name).rglob("*"))]
    with zipfile.ZipFile(ARCHIVE, "w") as archive:
        for path in sorted(found):
            if path.is_file() and "__pycache__" not in path.parts:
                info = zipfile.ZipInfo(f"swarmdsl/{path.relative_to(ROOT).as_posix()}")
                info.external_attr = 0o644 << 16
                archive.writestr(info, path.read_bytes(), zipfile.ZIP_DEFLATED)


def _wheels() -> list[Path]:
    """Return the required wheels, downloading them once."""
    wanted = REQUIREMENTS.read_text(encoding="utf-8")
    mark = WHEELS / REQUIREMENTS.name
    if not mark.exists() or mark.read_text(encoding="utf-8") != wanted:
        shutil.rmtree(WHEELS, ignore_errors=True)
        command = [
            *(sys.executable, "-m", "pip", "download", "--quiet", "--disable-pip-version-check"),
            *("--only-binary=:all:", "--platform=any", "--implementation=py", "--abi=none"),
            *("--python-version=3.10", "--no-deps", "--require-hashes"),
            *("--requirement", str(REQUIREMENTS), "--dest", str(WHEELS)),
        ]
        subprocess.run(command, check=True)
        mark.write_text(wanted, encoding="utf-8")
    return sorted(WHEELS.glob("*.whl"))


if __name__ == "__main__":
    make()
