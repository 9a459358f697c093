"""Which places in files a line of a log names, and which lines below it belong to it.

Those of Python (tracebacks, PyYAML), of gcc and clang and what writes places as they do (CMake,
pytest, engines of SCXML), and of ROS, whose formats for the console and the log files have
`${file}:${line}` and `{file_name}:{line_number}`.
"""

from __future__ import annotations

import re
from enum import Enum
from typing import NamedTuple

# Sequences that steer a terminal (ECMA-48, 5.4 and 8.3.89): colours, and links.
_ESCAPES = re.compile(r"\x1b(?:\[[0-?]*[ -/]*[@-~]|\][^\x07\x1b]*(?:\x07|\x1b\\)|[@-Z\\-_])")
# What ros2 launch and colcon put before what a process says.
_PROCESS = re.compile(r"(?:\[[\w./-]+(?:-\d+|:std(?:out|err))\] ?)+")
_QUOTED = re.compile(r'"([^"]{1,4096})", line (\d{1,9})')
# CMake writes `CMakeLists.txt:12 (find_package):`, rosout `[/a/b.py:12(start)]`.
_WORD = re.compile(r"[^\s\"'`()<>\[\]{},;=|]+")
_PLACE = re.compile(r"((?:[A-Za-z]:[\\/])?[^:]+):(\d{1,9})(?!\w|\.\d)")
_BELOW_GCC = re.compile(r"\s*\d*\s+\|")
_COLUMN = re.compile(r":\d+:\d+:")
_CHAIN = re.compile(r"\s*(?:In file included from|from) ")
# Nobody writes longer ones, and programs that do write no places in them.
_MOST = 1 << 14


class Kind(Enum):
    """What a line is, which says where the lines end that belong to it."""

    PLAIN = "a line for itself"
    PYTHON = "a frame of a traceback: lines of code below it are deeper"
    COMPILER = "what a compiler says: lines of code below it have a bar in front"
    CHAIN = "a file that includes the one which a compiler is about to speak of"


class Mention(NamedTuple):
    """A place in a file: its path as it is written, and the line, counted from 1."""

    path: str
    line: int


class Line(NamedTuple):
    """A line of a log; `process` is what stands before what a process has said, `depth` blanks."""

    text: str
    process: str
    depth: int
    kind: Kind
    mentions: tuple[Mention, ...]

    def owns(self, below: Line) -> bool:
        """Whether a line below it belongs to it."""
        if self.kind is Kind.PYTHON:
            return below.depth > self.depth and below.kind is not Kind.PYTHON
        return self.kind is Kind.COMPILER and bool(_BELOW_GCC.match(below.text))


def line_of(content: bytes) -> Line:
    """What a line of a log is; it may have any bytes, and need not be in UTF-8."""
    text = _ESCAPES.sub("", content[:_MOST].decode(errors="replace")).rstrip("\r\n")
    process = match[0] if (match := _PROCESS.match(text)) else ""
    text = text.removeprefix(process)
    found = [Mention(path, int(line)) for path, line in _QUOTED.findall(text)]
    kind = Kind.PYTHON if found and text.lstrip().startswith("File ") else Kind.PLAIN
    if not found:
        for word in _WORD.finditer(text):
            if (place := _PLACE.match(word[0])) is not None:
                found.append(Mention(place[1], int(place[2])))
        if found:
            kind = _kind(text)
    depth = len(text) - len(text.lstrip())
    return Line(text, process, depth, kind, tuple(dict.fromkeys(found)))


def _kind(text: str) -> Kind:
    if _CHAIN.match(text):
        return Kind.CHAIN
    return Kind.COMPILER if _COLUMN.search(text) else Kind.PLAIN
