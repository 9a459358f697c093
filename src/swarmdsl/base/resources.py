"""Paths of the grammar and other data: in the checkout or in the installed package."""

from __future__ import annotations

from functools import cache
from pathlib import Path

from swarmdsl.base.read_files import is_file, read_file

_PACKAGE = Path(__file__).resolve().parents[1]


def checkout_root() -> Path | None:
    """Return the root of the source checkout, None if the package is installed."""
    root = _PACKAGE.parents[1]
    return root if is_file(root / "grammar" / "swarm.tx") else None


def library() -> Path:
    """Return the folder of the packages that come with swarmdsl."""
    return _PACKAGE / "project" / "library"


def engine() -> Path:
    """Return the folder of the engine's sources, which generated packages copy."""
    return _PACKAGE / "execution" / "engine"


def monitors() -> Path:
    """Return the folder of the sources of monitors, which generated packages copy."""
    return _PACKAGE / "execution" / "monitor"


def grammar() -> Path:
    """Return the folder of the grammar files."""
    return (checkout_root() or _PACKAGE) / "grammar"


@cache
def grammar_checksum() -> int:
    """Return a checksum of the grammar files."""
    # Imported here because it is a library of its own, and most models follow the grammar.
    from zlib import crc32

    checksum = 0
    for path in sorted(grammar().glob("*.tx")):
        checksum = crc32(read_file(path), checksum)
    return checksum
