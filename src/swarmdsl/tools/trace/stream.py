"""Add notes to a log stream without removing anything from it."""

from __future__ import annotations

from swarmdsl.tools.trace.annotations import Annotator
from swarmdsl.tools.trace.generated_files import OutputFolders
from swarmdsl.tools.trace.source_locations import LineKind, LogLine, parse_line

_MAX_LENGTH = 1 << 16
"""Bytes of a line that are parsed, and bytes that are held back, at most."""


class Tracer:
    """Adds notes to a log that arrives in chunks.

    Input is passed on at once, except after a line whose note goes below the lines that belong to
    it: it is held back until they end.
    """

    def __init__(self, folders: OutputFolders, notes: Annotator) -> None:
        self._folders = folders
        self._notes = notes
        self._line = b""  # the incomplete line
        self._above: LogLine | None = None  # the line whose note is pending
        self._note = b""
        self._has_note = False  # of the previous line
        self._held = b""

    def feed(self, data: bytes) -> bytes:
        """Return the output for the next chunk."""
        *lines, rest = data.split(b"\n")
        out = bytearray()
        for line in lines:
            out += self._take(line)
            out += self._end_line()
        out += self._take(rest)
        return bytes(out)

    def end(self) -> bytes:
        """Return the remaining output."""
        if not self._line:
            return self._flush()
        # The last line is incomplete: terminate it only if a note follows.
        out = self.feed(b"\n") + self._flush()
        return out if self._has_note else out[:-1]

    def _take(self, piece: bytes) -> bytes:
        self._line += piece[: max(0, _MAX_LENGTH - len(self._line))]
        if self._above is None:
            return piece
        self._held += piece
        return self._flush() if len(self._held) > _MAX_LENGTH else b""

    def _end_line(self) -> bytes:
        line, self._line = parse_line(self._line), b""
        if self._above is None:
            out = b"\n"
        elif self._above.owns(line):
            out, self._held = self._held + b"\n", b""
            return out
        else:
            self._held += b"\n"
            out = self._flush()
        note = self._note_for(line).encode(errors="replace")
        self._has_note = bool(note)
        if note and line.kind in (LineKind.PYTHON, LineKind.COMPILER):
            self._above, self._note = line, note
            return out
        return out + note

    def _note_for(self, line: LogLine) -> str:
        found = [
            (mention, file)
            for mention in line.locations
            if (file := self._folders.file(mention.path)) is not None
        ]
        return self._notes.annotate(line, found) if found else ""

    def _flush(self) -> bytes:
        out = self._note + self._held
        self._above, self._note, self._held = None, b"", b""
        return out
