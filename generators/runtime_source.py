"""Python modules that are copied into generated packages.

They are in folders `runtime` of the targets, as ordinary source that linters, mypy and tests read.
A module of a `runtime` folder that no package gets is a stand-in: it gives type checkers a module
that the package gets from elsewhere.
"""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path

_SHEBANG = re.compile(r"#!.*\n")


def runtime_source(path: Path, header: str, **constants: object) -> str:
    """Return the source of a module with the comment lines `header` above its docstring.

    `constants` are new values for constants of the module, by their names: `_CANCEL=5` replaces
    the line `_CANCEL = 60`.
    """
    text = _read(path)
    for name, value in constants.items():
        text, count = re.subn(rf"(?m)^{name} = .*$", f"{name} = {value!r}", text)
        assert count == 1, f"{path.name} has {count} constants {name}"
    shebang = _SHEBANG.match(text)
    start = shebang.end() if shebang else 0
    return f"{text[:start]}{header}\n{text[start:]}"


@cache
def _read(path: Path) -> str:
    return path.read_text(encoding="utf-8")
