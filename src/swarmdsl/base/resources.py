"""Where the grammar and the bundled generators lie: in the checkout or in the installed package."""

from __future__ import annotations

from functools import cache
from pathlib import Path

_PACKAGE = Path(__file__).resolve().parents[1]


def checkout_root() -> Path | None:
    """The root of the source checkout this package runs from, None when it is installed."""
    root = _PACKAGE.parents[1]
    return root if (root / "grammar" / "swarm.tx").is_file() else None


def library() -> Path:
    """The folder of the packages that come with swarmdsl."""
    return _PACKAGE / "project" / "library"


def engine() -> Path:
    """Folder of the engine's sources, which generated packages get a copy of."""
    return _PACKAGE / "execution" / "engine"


def grammar() -> Path:
    """The folder of the grammar files."""
    return (checkout_root() or _PACKAGE) / "grammar"


@cache
def grammar_checksum() -> int:
    """A number that is another one when a grammar file has changed."""
    # Imported here because it is a library of its own, and most models follow the grammar.
    from zlib import crc32

    checksum = 0
    for path in sorted(grammar().glob("*.tx")):
        checksum = crc32(path.read_bytes(), checksum)
    return checksum
