"""A log as a stream of bytes, to which notes are added and from which nothing is taken away."""

from __future__ import annotations

from swarmdsl.tools.trace.annotations import Notes
from swarmdsl.tools.trace.generated_files import Folders
from swarmdsl.tools.trace.source_locations import Kind, Line, line_of

_MOST = 1 << 16
"""How much of a line is looked at, and how much is held back at most."""


class Tracer:
    """Adds notes to a log that comes in pieces.

    Whatever comes goes out at once, but for what comes after a line with a note that belongs
    below the next lines: until one of these has ended, it is held back.
    """

    def __init__(self, folders: Folders, notes: Notes) -> None:
        self._folders = folders
        self._notes = notes
        self._line = b""  # what has come of a line
        self._above: Line | None = None  # the line that waits for its note
        self._note = b""
        self._has_note = False  # whether the line before this one has a note
        self._held = b""

    def feed(self, data: bytes) -> bytes:
        """What is to be written for the next piece of the log."""
        *lines, rest = data.split(b"\n")
        out = bytearray()
        for line in lines:
            out += self._take(line)
            out += self._end_line()
        out += self._take(rest)
        return bytes(out)

    def end(self) -> bytes:
        """What is to be written in the end."""
        if not self._line:
            return self._flush()
        # The log ends within a line, which has an end only where something is to follow.
        out = self.feed(b"\n") + self._flush()
        return out if self._has_note else out[:-1]

    def _take(self, piece: bytes) -> bytes:
        self._line += piece[: max(0, _MOST - len(self._line))]
        if self._above is None:
            return piece
        self._held += piece
        return self._flush() if len(self._held) > _MOST else b""

    def _end_line(self) -> bytes:
        line, self._line = line_of(self._line), b""
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
        if note and line.kind in (Kind.PYTHON, Kind.COMPILER):
            self._above, self._note = line, note
            return out
        return out + note

    def _note_for(self, line: Line) -> str:
        found = [
            (mention, file)
            for mention in line.mentions
            if (file := self._folders.file(mention.path)) is not None
        ]
        return self._notes.below(line, found) if found else ""

    def _flush(self) -> bytes:
        out = self._note + self._held
        self._above, self._note, self._held = None, b"", b""
        return out
