"""Jinja templates of generators, compiled once and kept between runs."""

from __future__ import annotations

import os
import sys
from contextlib import suppress
from pathlib import Path

from jinja2 import Environment, FileSystemBytecodeCache, FileSystemLoader, StrictUndefined
from jinja2.bccache import Bucket

from swarmdsl import __version__


def environment(folder: Path) -> Environment:
    """The templates in a folder: what is undefined is an error, blocks leave no lines behind."""
    return Environment(
        loader=FileSystemLoader(folder),
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        bytecode_cache=_cache(),
    )


class _Cache(FileSystemBytecodeCache):
    """Compiled templates in files, which Jinja replaces at once; nothing where that fails."""

    def get_source_checksum(self, source: str) -> str:
        # Another version may compile the same text in another way.
        return super().get_source_checksum(f"{__version__} {source}")

    def dump_bytecode(self, bucket: Bucket) -> None:
        with suppress(OSError):
            super().dump_bytecode(bucket)


def _cache() -> _Cache | None:
    """The cache of the user, None where there is none or Python is to write no bytecode."""
    if sys.dont_write_bytecode:
        return None
    given = Path(os.environ.get("XDG_CACHE_HOME") or os.environ.get("LOCALAPPDATA") or "")
    try:
        folder = (given if given.is_absolute() else Path.home() / ".cache") / "swarmdsl"
        folder.mkdir(mode=0o700, parents=True, exist_ok=True)
    except (OSError, RuntimeError):
        return None
    return _Cache(str(folder))
