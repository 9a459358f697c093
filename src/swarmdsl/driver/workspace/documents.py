"""Open documents, split into fragments; edited content replaces that on disk."""

from __future__ import annotations

import os
from collections.abc import Container, Sequence
from functools import partial
from itertools import accumulate, pairwise
from pathlib import Path

from swarmdsl.base.diagnostics.collector import Diagnostics
from swarmdsl.base.read_files import MOST
from swarmdsl.base.source import Piece, Source, Span
from swarmdsl.driver.workspace.fragments import Fragment, Levels
from swarmdsl.project.loader import File, Reader, parsed_interface, report_empty
from swarmdsl.project.read_source import decoded, read_bytes, without_control_characters
from swarmdsl.project.rosidl.package_folder import InterfacePath
from swarmdsl.syntax.ast import Model
from swarmdsl.syntax.parse import Parsed, parse_segment
from swarmdsl.syntax.segments import is_self_contained, join_segments, split_declarations


class Document:
    """A file and its fragments; `diagnostics` are about the file as a whole."""

    def __init__(self, source: Source, levels: Levels, interface: InterfacePath | None) -> None:
        nothing = Model(Span(source, 0, 0), None, [], [], [])
        self.file = File(source, Parsed(nothing))
        self.interface = interface
        self.fragments: list[Fragment] = []
        self.diagnostics = Diagnostics(levels)
        self._levels = levels
        if interface is None:
            self.replace(source)
        else:
            parser = partial(parsed_interface, interface)
            self.fragments.append(Fragment(source, self.file, parser, levels))
            self.join()

    def replace(self, source: Source) -> tuple[list[Fragment], list[Fragment]]:
        """Replace the content of the file; return the removed and the new fragments."""
        self._control = Diagnostics(self._levels)
        whole = without_control_characters(source, self._control)
        text, old = whole.text, self.fragments
        pieces = self._segments(text)
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
            new.append(Fragment(piece, self.file, parse_segment, self._levels))
        last = len(old) - after
        removed = old[before:last]
        self.fragments = [*old[:before], *new, *old[last:]]
        self.file.source = whole
        for fragment, (start, _) in zip(self.fragments, pieces, strict=True):
            assert isinstance(fragment.source, Piece)
            fragment.source.whole, fragment.source.base = whole, start
        self.join()
        return removed, new

    def _segments(self, text: str) -> list[tuple[int, int]]:
        """Split the text, but reuse the fragments before and after the change if possible."""
        old = self.fragments
        before = max(_common_prefix(old, text) - 1, 0)
        after = max(_common_suffix(old[before:], text) - 1, 0)
        last = len(old) - after
        start = sum(len(fragment.source.text) for fragment in old[:before])
        end = len(text) - sum(len(fragment.source.text) for fragment in old[last:])
        local = (
            start <= end
            and is_self_contained(text[start:end])
            and all(fragment.closed for fragment in old)
        )
        if not local or start == end:
            return split_declarations(text)
        places = [
            (start + first, start + end) for first, end in split_declarations(text[start:end])
        ]
        lengths = [len(fragment.source.text) for fragment in old]
        ends = list(accumulate(lengths[:before]))
        head = list(zip([0, *ends], ends, strict=False))
        ends = list(accumulate(lengths[last:], initial=end))
        return [*head, *places, *pairwise(ends)]

    def join(self) -> None:
        """Join the trees of the fragments into that of the file."""
        if self.interface is not None:
            self.file.parsed = self.fragments[0].parsed
            return
        source = self.file.source
        self.diagnostics = Diagnostics(self._levels)
        self.diagnostics.include(self._control)
        self.file.parsed = join_segments(
            source, [fragment.parsed for fragment in self.fragments], self.diagnostics
        )
        if not len(self.diagnostics) and not any(
            len(fragment.syntax) for fragment in self.fragments
        ):
            report_empty(source, self.file.model, self.diagnostics)


def _common_prefix(fragments: Sequence[Fragment], text: str) -> int:
    """Count the first fragments that are a prefix of the text."""
    at = 0
    for count, fragment in enumerate(fragments):
        if not text.startswith(fragment.source.text, at):
            return count
        at += len(fragment.source.text)
    return len(fragments)


def _common_suffix(fragments: Sequence[Fragment], text: str) -> int:
    """Count the last fragments that are a suffix of the text."""
    end = len(text)
    for count, fragment in enumerate(reversed(fragments)):
        if not text.endswith(fragment.source.text, 0, end):
            return count
        end -= len(fragment.source.text)
    return len(fragments)


class DocumentStore(Reader):
    """All documents by the real path of their file; reads each file from disk once.

    `in_use` are the real paths requested since it was last cleared. `requested` are all requested
    paths, including unreadable files and searched folders. Files outside of `within` or larger
    than `most` bytes are not read.
    """

    def __init__(
        self, levels: Levels, within: Container[Path] | None = None, most: int = MOST
    ) -> None:
        self.documents: dict[str, Document] = {}
        self.in_use: set[str] = set()
        self.requested: set[Path] = set()
        self._levels = levels
        self._within = within
        self._most = most
        self._edited: dict[str, bytes] = {}

    def look(self, path: Path) -> None:
        """Record a file or folder that was looked for."""
        self.requested.add(path)

    def allows(self, path: Path, at: Span | None, report: Diagnostics) -> bool:
        """Return True if a path may be read; otherwise report it at `at`."""
        if self._within is None or path in self._within:
            return True
        report.report(
            "outside-workspace",
            at,
            path=path,
            help="open its folder in the editor too, or add it to `libraries` in `swarm.toml`",
        )
        return False

    def edit(self, path: Path, text: str | None) -> None:
        """Override the content of a file; None restores that on disk."""
        identity = os.path.realpath(path)
        if text is None:
            self._edited.pop(identity, None)
        else:
            self._edited[identity] = text.encode("utf-8", "surrogatepass")

    def edited(self, path: Path) -> str | None:
        """Return the overriding content of a file, None if it is on disk."""
        text = self._edited.get(os.path.realpath(path))
        return text.decode("utf-8", "surrogatepass") if text is not None else None

    def document(self, path: Path) -> Document | None:
        """Return the document of a file, if loaded."""
        return self.documents.get(os.path.realpath(path))

    def drop(self, path: Path) -> None:
        """Forget a file, so that it is read from disk again."""
        self.documents.pop(os.path.realpath(path), None)

    def drop_unused(self) -> None:
        """Forget the files that are not in use."""
        self.documents = {
            key: document for key, document in self.documents.items() if key in self.in_use
        }

    def reload(self, document: Document) -> Source | None:
        """Read a .swarm file again; None if it has to be loaded anew."""
        path = document.file.source.path
        if path is None or document.interface is not None:
            return None
        return self.source(path, None, Diagnostics())

    def source(self, path: Path, at: Span | None, report: Diagnostics) -> Source | None:
        """Read a file; None if it is unreadable, which is reported at `at`."""
        content = self._edited.get(os.path.realpath(path))
        if content is None and self.allows(path, at, report):
            content = read_bytes(path, at, report, most=self._most)
        elif content is not None and len(content) > self._most:
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
        self.requested.add(path)
        document = self.documents.get(identity)
        if document is None or (document.file.source.name, document.interface) != (
            str(path),
            interface,
        ):
            source = self.source(path, at, report)
            if source is None:
                return None
            document = self.documents[identity] = Document(source, self._levels, interface)
        self.in_use.add(identity)
        return document.file
