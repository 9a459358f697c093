"""Compiled templates in the user's cache, where what cannot be kept is made again."""

from __future__ import annotations

import marshal
import os
import sys
from contextlib import suppress
from pathlib import Path
from types import CodeType
from zlib import crc32

from swarmdsl import __version__


def stamp(text: str, *filters: str) -> bytes:
    """What is another one when a template must be compiled anew."""
    # Another version may compile the same text in another way.
    about = [__version__, sys.version, *sorted(filters), text]
    return b"swarmdsl %08x %d\n" % (crc32("\0".join(about).encode()), len(text))


def load(template: Path, stamp: bytes) -> CodeType | None:
    """A template as it was compiled; None where that is not known, or not any more."""
    folder = _folder()
    if folder is None:
        return None
    try:
        content = (folder / _name(template)).read_bytes()
        code = marshal.loads(content.removeprefix(stamp)) if content.startswith(stamp) else None
    except (OSError, EOFError, ValueError, TypeError):
        return None
    return code if isinstance(code, CodeType) else None


def save(template: Path, stamp: bytes, code: CodeType) -> None:
    """Keep a compiled template, if that is possible."""
    folder = _folder()
    if folder is None:
        return
    from swarmdsl.staging import Staging

    with suppress(OSError), Staging() as staging:
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
        staging.add(folder / _name(template), stamp + marshal.dumps(code))
        for _ in staging.move_in_place():
            pass


def _name(template: Path) -> str:
    where = crc32(os.fsencode(template.parent))
    return f"{template.name}-{where:08x}.{sys.implementation.cache_tag}"


def _folder() -> Path | None:
    """The cache of the user, None where there is none or Python is to write no bytecode."""
    if sys.dont_write_bytecode:
        return None
    given = Path(os.environ.get("XDG_CACHE_HOME") or os.environ.get("LOCALAPPDATA") or "")
    try:
        return (given if given.is_absolute() else Path.home() / ".cache") / "swarmdsl"
    except RuntimeError:
        return None
