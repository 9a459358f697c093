"""Progress of a search on a terminal."""

from __future__ import annotations

import time
from typing import TextIO

_PAUSE = 0.2
"""Seconds between two reports of the progress."""


class Progress:
    """Number of states so far, on a terminal."""

    def __init__(self, stream: TextIO) -> None:
        self._stream = stream if stream.isatty() else None
        self._last = time.monotonic()

    def tell(self, states: int) -> None:
        """Show the number of states, not too often."""
        now = time.monotonic()
        if self._stream is not None and now - self._last > _PAUSE:
            self._last = now
            self._stream.write(f"\r{states:,} states")
            self._stream.flush()

    def clear(self) -> None:
        """Remove what was shown."""
        if self._stream is not None:
            self._stream.write("\r\033[K")
            self._stream.flush()
