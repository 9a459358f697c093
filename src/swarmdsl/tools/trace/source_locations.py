"""Find source locations in a log line, and the lines below that belong to it.

Formats: Python (tracebacks, PyYAML), gcc and clang and tools with the same notation (CMake, pytest,
SCXML engines), and ROS, whose console and log formats have `${file}:${line}` and
`{file_name}:{line_number}`.
"""

from __future__ import annotations

import re
from enum import Enum
from typing import NamedTuple

from swarmdsl.base.numerals import integer

# Terminal escape sequences (ECMA-48, 5.4 and 8.3.89): colours and links.
_ESCAPES = re.compile(r"\x1b(?:\[[0-?]*[ -/]*[@-~]|\][^\x07\x1b]*(?:\x07|\x1b\\)|[@-Z\\-_])")
# Prefix that ros2 launch and colcon put before the output of a process.
_PROCESS = re.compile(r"(?:\[[\w./-]+(?:-\d+|:std(?:out|err))\] ?)+")
_QUOTED = re.compile(r'"([^"]{1,4096})", line (\d{1,9})')
# CMake writes `CMakeLists.txt:12 (find_package):`, rosout `[/a/b.py:12(start)]`.
_TOKEN = re.compile(r"[^\s\"'`()<>\[\]{},;=|]+")
_LOCATION = re.compile(r"((?:[A-Za-z]:[\\/])?[^:]+):(\d{1,9})(?!\w|\.\d)")
_BELOW_GCC = re.compile(r"\s*\d*\s+\|")
_COLUMN = re.compile(r":\d+:\d+:")
_CHAIN = re.compile(r"\s*(?:In file included from|from) ")
# Longer lines are data, not messages.
_MAX_LENGTH = 1 << 14


class LineKind(Enum):
    """Kind of a line; it decides where the lines that belong to it end."""

    PLAIN = "a single line"
    PYTHON = "a frame of a traceback: lines of code below it are deeper"
    COMPILER = "a compiler message: lines of code below it begin with a bar"
    CHAIN = "a file that includes the file of the next compiler message"


class Location(NamedTuple):
    """Location in a file: path as written, and line number from 1."""

    path: str
    line: int


class LogLine(NamedTuple):
    """Line of a log: `process` is its process prefix, `depth` its indentation."""

    text: str
    process: str
    depth: int
    kind: LineKind
    locations: tuple[Location, ...]

    def owns(self, below: LogLine) -> bool:
        """Return True if the line `below` belongs to this line."""
        if self.kind is LineKind.PYTHON:
            return below.depth > self.depth and below.kind is not LineKind.PYTHON
        return self.kind is LineKind.COMPILER and bool(_BELOW_GCC.match(below.text))


def parse_line(content: bytes) -> LogLine:
    """Parse a log line; bytes that are not UTF-8 are allowed."""
    text = _ESCAPES.sub("", content[:_MAX_LENGTH].decode(errors="replace")).rstrip("\r\n")
    process = match[0] if (match := _PROCESS.match(text)) else ""
    text = text.removeprefix(process)
    found = [Location(path, integer(line)) for path, line in _QUOTED.findall(text)]
    kind = LineKind.PYTHON if found and text.lstrip().startswith("File ") else LineKind.PLAIN
    if not found:
        for word in _TOKEN.finditer(text):
            if (place := _LOCATION.match(word[0])) is not None:
                found.append(Location(place[1], integer(place[2])))
        if found:
            kind = _kind(text)
    depth = len(text) - len(text.lstrip())
    return LogLine(text, process, depth, kind, tuple(dict.fromkeys(found)))


def _kind(text: str) -> LineKind:
    if _CHAIN.match(text):
        return LineKind.CHAIN
    return LineKind.COMPILER if _COLUMN.search(text) else LineKind.PLAIN
