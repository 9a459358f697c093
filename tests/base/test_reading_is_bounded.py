"""All files are read through `swarmdsl.base.read_files`, which bounds what it reads.

Files, folders and names are looked up there too: `Path.exists` raises an error for a long name.
"""

from __future__ import annotations

import ast
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FOLDERS = (ROOT / "src" / "swarmdsl", ROOT / "generators")

# Methods that read a file, and functions by the module that they are of.
READS = {"read_text", "read_bytes", "exists", "is_file", "is_dir", "rglob", "samefile"}
OPENS = {"open", "os.open", "io.open", "io.FileIO", "os.walk", "os.stat", "ElementTree.parse"}
OPENS |= {"os.path.isfile", "os.path.isdir", "os.path.exists", "path.open", "file.open"}

ALLOWED = {
    "base/read_files.py": "it is the door",
    "base/find_files.py": "it bounds the search of folders",
    "base/atomic_write.py": "it writes files that did not exist, and looks at what it replaces",
    "base/write_stream.py": "it writes, and looks first at what is there",
    "cli/__init__.py": "it closes standard output with the null device",
    "cli/watch.py": "it looks at times of files and reads none",
    "execution/experiments/time_limit.py": "it sends what nobody reads to the null device",
    "ide/server/start.py": "it closes standard output with the null device",
    "ide/preview/serving.py": "its `open` is that of an editor",
    "output/disk.py": "it looks at permissions of files that it wrote",
    "output/lock.py": "it locks a folder",
    "tools/doctor.py": "it reads what pip says about the installed package",
    "syntax/pegen/": "it is a tool of developers and reads the grammar",
    "generators/": "they read their own templates and runtime modules",
    "project/libraries.py": "it looks into folders of installed packages",
}


def test_no_module_reads_around_the_door() -> None:
    around = [
        f"{name}:{line}: {call}"
        for name, line, call in calls()
        if not any(name.startswith(allowed) for allowed in ALLOWED)
    ]
    assert around == []


def test_each_exception_is_needed() -> None:
    used = {allowed for name, _, _ in calls() for allowed in ALLOWED if name.startswith(allowed)}
    assert used == set(ALLOWED)


def calls() -> Iterator[tuple[str, int, str]]:
    """Yield the calls that read or look up files: the module, the line, the function."""
    for folder in FOLDERS:
        for path in sorted(folder.rglob("*.py")):
            name = path.relative_to(folder if folder.name == "swarmdsl" else ROOT).as_posix()
            if "template" in path.parts or "templates" in path.parts:
                continue
            for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
                if isinstance(node, ast.Call):
                    call = ast.unparse(node.func)
                    last = call.rpartition(".")[2]
                    if last == "resolve" and not node.args and "__file__" not in call:
                        yield name, node.lineno, call  # an error for a link to itself
                    if call in OPENS or ("." in call and last in {*READS, "open"}):
                        yield name, node.lineno, call
