"""Files in memory, cut into units; what an editor shows is read instead of what is on disk."""

from __future__ import annotations

import os
from collections.abc import Container, Sequence
from functools import partial
from itertools import accumulate, pairwise
from pathlib import Path

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.source import Piece, Source, Span
from swarmdsl.driver.workspace.fragments import Levels, Unit
from swarmdsl.project.loader import File, Reader, parsed_interface, report_empty
from swarmdsl.project.read_source import decoded, read_bytes, without_control_characters
from swarmdsl.project.rosidl.package_folder import InterfacePath
from swarmdsl.syntax.ast import Model
from swarmdsl.syntax.parse import Parsed, parse_segment
from swarmdsl.syntax.segments import is_self_contained, join_segments, split_declarations


class Sheet:
    """A file and its units; `said` is what is wrong with the file as a whole."""

    def __init__(self, source: Source, levels: Levels, interface: InterfacePath | None) -> None:
        nothing = Model(Span(source, 0, 0), None, [], [], [])
        self.file = File(source, Parsed(nothing))
        self.interface = interface
        self.units: list[Unit] = []
        self.said = Diagnostics(levels)
        self._levels = levels
        if interface is None:
            self.replace(source)
        else:
            parser = partial(parsed_interface, interface)
            self.units.append(Unit(source, self.file, parser, levels))
            self.join()

    def replace(self, source: Source) -> tuple[list[Unit], list[Unit]]:
        """Give the file another text; return the units that are gone and those that are new."""
        self._control = Diagnostics(self._levels)
        whole = without_control_characters(source, self._control)
        text, old = whole.text, self.units
        pieces = self._pieces(text)
        texts = [text[start:end] for start, end in pieces]
        most = min(len(old), len(texts))
        before = after = 0
        while before < most and old[before].source.text == texts[before]:
            before += 1
        while after < most - before and old[-1 - after].source.text == texts[-1 - after]:
            after += 1
        new = []
        for each in texts[before : len(texts) - after]:
            piece = Piece(whole.name, each, whole.path, whole=whole)
            new.append(Unit(piece, self.file, parse_segment, self._levels))
        last = len(old) - after
        gone = old[before:last]
        self.units = [*old[:before], *new, *old[last:]]
        self.file.source = whole
        for unit, (start, _) in zip(self.units, pieces, strict=True):
            assert isinstance(unit.source, Piece)
            unit.source.whole, unit.source.base = whole, start
        self.join()
        return gone, new

    def _pieces(self, text: str) -> list[tuple[int, int]]:
        """The text cut into pieces; only around what changed, where the rest goes on as before."""
        old = self.units
        before = max(_same_before(old, text) - 1, 0)
        after = max(_same_after(old[before:], text) - 1, 0)
        last = len(old) - after
        start = sum(len(unit.source.text) for unit in old[:before])
        end = len(text) - sum(len(unit.source.text) for unit in old[last:])
        local = (
            start <= end and is_self_contained(text[start:end]) and all(unit.closed for unit in old)
        )
        if not local or start == end:
            return split_declarations(text)
        places = [
            (start + first, start + end) for first, end in split_declarations(text[start:end])
        ]
        lengths = [len(unit.source.text) for unit in old]
        ends = list(accumulate(lengths[:before]))
        head = list(zip([0, *ends], ends, strict=False))
        ends = list(accumulate(lengths[last:], initial=end))
        return [*head, *places, *pairwise(ends)]

    def join(self) -> None:
        """Make the tree of the file of those of its units."""
        if self.interface is not None:
            self.file.parsed = self.units[0].parsed
            return
        source = self.file.source
        self.said = Diagnostics(self._levels)
        self.said.include(self._control)
        self.file.parsed = join_segments(source, [unit.parsed for unit in self.units], self.said)
        if not len(self.said) and not any(len(unit.syntax) for unit in self.units):
            report_empty(source, self.file.model, self.said)


def _same_before(units: Sequence[Unit], text: str) -> int:
    """How many of the first units are what the text begins with."""
    at = 0
    for count, unit in enumerate(units):
        if not text.startswith(unit.source.text, at):
            return count
        at += len(unit.source.text)
    return len(units)


def _same_after(units: Sequence[Unit], text: str) -> int:
    """How many of the last units are what the text ends with."""
    end = len(text)
    for count, unit in enumerate(reversed(units)):
        if not text.endswith(unit.source.text, 0, end):
            return count
        end -= len(unit.source.text)
    return len(units)


class Desk(Reader):
    """All sheets, by the real paths of their files; each file is read from disk once.

    `wanted` are the real paths of those that were asked for since it was last emptied, `asked`
    the paths of all, also of those that cannot be read, and of folders that were looked into.
    What does not lie `within` some folders is not read, nor what has more than `most` bytes.
    """

    def __init__(
        self, levels: Levels, within: Container[Path] | None = None, most: int | None = None
    ) -> None:
        self.sheets: dict[str, Sheet] = {}
        self.wanted: set[str] = set()
        self.asked: set[Path] = set()
        self._levels = levels
        self._within = within
        self._most = most
        self._edited: dict[str, bytes] = {}

    def look(self, path: Path) -> None:
        """Hear of a file or folder that was looked for."""
        self.asked.add(path)

    def allows(self, path: Path, at: Span | None, report: Diagnostics) -> bool:
        """Whether a file or folder may be read; one that may not is reported at `at`."""
        if self._within is None or path in self._within:
            return True
        report.report(
            "outside-workspace",
            at,
            path=path,
            help="open its folder in the editor, too, "
            "or name it in `libraries` of the project file `swarm.toml`",
        )
        return False

    def edit(self, path: Path, text: str | None) -> None:
        """Take a text for the content of a file; None for what is on disk."""
        identity = os.path.realpath(path)
        if text is None:
            self._edited.pop(identity, None)
        else:
            self._edited[identity] = text.encode("utf-8", "surrogatepass")

    def edited(self, path: Path) -> str | None:
        """The text that was taken for the content of a file, None for one that is on disk."""
        text = self._edited.get(os.path.realpath(path))
        return text.decode("utf-8", "surrogatepass") if text is not None else None

    def sheet(self, path: Path) -> Sheet | None:
        """The sheet of a file, if there is one."""
        return self.sheets.get(os.path.realpath(path))

    def drop(self, path: Path) -> None:
        """Forget a file: it is read from disk when it is wanted."""
        self.sheets.pop(os.path.realpath(path), None)

    def tidy(self) -> None:
        """Forget the files that are not wanted."""
        self.sheets = {key: sheet for key, sheet in self.sheets.items() if key in self.wanted}

    def reread(self, sheet: Sheet) -> Source | None:
        """The text of a .swarm file as it is now; None where it must be loaded anew."""
        path = sheet.file.source.path
        if path is None or sheet.interface is not None:
            return None
        return self.source(path, None, Diagnostics())

    def source(self, path: Path, at: Span | None, report: Diagnostics) -> Source | None:
        """The text of a file; None for one that cannot be read, which is reported at `at`."""
        content = self._edited.get(os.path.realpath(path))
        if content is None and self.allows(path, at, report):
            content = read_bytes(path, at, report, most=self._most)
        elif content is not None and self._most is not None and len(content) > self._most:
            report.report("too-large", at, path=path, most=self._most // 2**20)
            return None
        return decoded(path, content, at, report) if content is not None else None

    def model(self, path: Path, at: Span | None, report: Diagnostics) -> File | None:
        """Read and parse a .swarm file."""
        return self._file(path, None, at, report)

    def interface(
        self, interface: InterfacePath, at: Span | None, report: Diagnostics
    ) -> File | None:
        """Read a ROS interface file as a file with one declaration."""
        return self._file(interface.path, interface, at, report)

    def _file(
        self, path: Path, interface: InterfacePath | None, at: Span | None, report: Diagnostics
    ) -> File | None:
        identity = os.path.realpath(path)
        self.asked.add(path)
        sheet = self.sheets.get(identity)
        if sheet is None or (sheet.file.source.name, sheet.interface) != (str(path), interface):
            source = self.source(path, at, report)
            if source is None:
                return None
            sheet = self.sheets[identity] = Sheet(source, self._levels, interface)
        self.wanted.add(identity)
        return sheet.file
