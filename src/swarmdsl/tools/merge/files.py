"""Merge three files by declarations, or by lines if one has syntax errors."""

from __future__ import annotations

import re
from pathlib import Path

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.git import run_git
from swarmdsl.base.records import dataclass
from swarmdsl.project.read_source import decoded, read_bytes
from swarmdsl.syntax.parse import parse
from swarmdsl.tools.merge.outline import Item, outline
from swarmdsl.tools.merge.three_way import merge

_BOM = b"\xef\xbb\xbf"
_LINE_END = re.compile(rb"\r\n|\n|\r")


@dataclass(frozen=True)
class Result:
    """Merged content and the number of conflicts.

    `by_lines` is True if git merged lines because a file has syntax errors.
    """

    content: bytes
    conflicts: int
    by_lines: bool = False


def merge_files(base: Path, ours: Path, theirs: Path, report: Diagnostics) -> Result | None:
    """Merge two versions of a file; None if a file cannot be read.

    Line ends and byte order mark are taken from `ours`.
    """
    paths = (base, ours, theirs)
    contents = [read_bytes(path, None, report) for path in paths]
    outlines = [
        _outline(path, content, report) if content is not None else None
        for path, content in zip(paths, contents, strict=True)
    ]
    before, our_outline, their_outline = outlines
    if before is not None and our_outline is not None and their_outline is not None:
        merged = merge(before, our_outline, their_outline)
        return Result(_with_line_ends(contents[1] or b"", merged.text), merged.conflicts)
    if any(found.name in ("not-text", "file-not-found", "unreadable-file") for found in report):
        return None
    return _merge_lines(*paths) if None not in contents else None


def _outline(path: Path, content: bytes, report: Diagnostics) -> Item | None:
    source = decoded(path, content, None, report)
    if source is None:
        return None
    found = Diagnostics()
    parsed = parse(source, found)
    report.include(found)
    return None if found.has_errors else outline(source, parsed.model)


def _with_line_ends(content: bytes, text: str) -> bytes:
    encoded = text.encode()
    first = _LINE_END.search(content)
    if first is not None and first[0] == b"\r\n":
        encoded = encoded.replace(b"\n", b"\r\n")
    return _BOM + encoded if content.startswith(_BOM) else encoded


def _merge_lines(base: Path, ours: Path, theirs: Path) -> Result | None:
    names = ("-L", "ours", "-L", "base", "-L", "theirs")
    files = (str(path.absolute()) for path in (ours, base, theirs))
    try:
        done = run_git(Path(), "merge-file", "--stdout", "--quiet", *names, "--", *files)
    except FileNotFoundError:
        return None
    # The exit code is the number of conflicts, at most 127; larger codes are errors.
    return Result(done.stdout, done.returncode, by_lines=True) if done.returncode < 128 else None
