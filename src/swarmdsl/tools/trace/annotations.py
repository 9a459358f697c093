"""Notes below a log line: the location in the model, with its source line."""

from __future__ import annotations

import os
from collections.abc import Iterator
from functools import cache
from io import StringIO
from pathlib import Path

from swarmdsl.base.diagnostics.collector import Diagnostics, Label
from swarmdsl.base.diagnostics.render.printable import printable
from swarmdsl.base.diagnostics.render.text import Piece, place
from swarmdsl.base.source import Source, Span
from swarmdsl.output.source_maps import Position, digest
from swarmdsl.project.read_source import read_source
from swarmdsl.tools.trace.generated_files import GeneratedFile
from swarmdsl.tools.trace.source_locations import LineKind, Location, LogLine

_STYLE = "bold cyan"
_FRAME = "blue"


class Annotator:
    """Writes notes on generated files; repeated locations are written in short form."""

    def __init__(self, colour: bool) -> None:
        self._colour = colour
        self._shown: set[object] = set()

    def annotate(self, line: LogLine, found: list[tuple[Location, GeneratedFile]]) -> str:
        """Return the notes below a log line, each with the process prefix of that line."""
        pieces: list[Piece] = []
        for mention, file in found:
            if line.kind is not LineKind.CHAIN:
                pieces += self._notes_on(mention, file)
            elif (position := file.position(mention.line)) is not None:
                pieces += self._position(position, file, "", short=True)
        text = _render(pieces, self._colour)
        return "".join(f"{line.process}{each}\n" for each in text.splitlines())

    def _notes_on(self, mention: Location, file: GeneratedFile) -> Iterator[Piece]:
        name = file.path.rpartition("/")[2]
        if file.map.of_user:
            yield from self._note(file.path, f"`{name}` is yours to implement", file)
        elif file.is_users_line(mention.line):
            yield from self._note((file.path, mention.line), f"you wrote this line of `{name}`")
        elif (position := file.position(mention.line)) is not None:
            yield from self._position(position, file, "")
            if file.lost_original:
                edited = f"`{name}` was edited after the build: the location may be wrong"
                yield from self._note((file.path, "edited"), edited)
        elif file.map.origin is not None:
            about = f"the whole of `{name}` is generated from this"
            yield from self._position(file.map.origin, file, about)
        else:
            text = f"`{name}` is generated, but not from a single element of the model"
            yield from self._note(file.path, text)

    def _position(
        self, position: Position, file: GeneratedFile, about: str, *, short: bool = False
    ) -> Iterator[Piece]:
        path = position.model.place(file.out)
        gutter = len(str(position.line))
        yield f"{'':{gutter}}--> ", _FRAME
        yield f"{_display_path(path)}:{position.line}:{position.column}\n", ""
        if short or (position, about) in self._shown:
            return
        self._shown.add((position, about))
        source, fault = _read_model(path, position.model.digest)
        if source is None:
            yield from self._note(path, fault)
            return
        start = source.line_starts[position.line - 1] + position.column - 1
        span = Span(source, start, start + position.length)
        # The first two lines repeat the location.
        _, _, *excerpt = place(Label(span), gutter, "^", _STYLE, about)
        yield from excerpt

    def _note(
        self, key: object, text: str, of_user: GeneratedFile | None = None
    ) -> Iterator[Piece]:
        if key in self._shown:
            return
        self._shown.add(key)
        origin = of_user.map.origin if of_user is not None else None
        if of_user is not None and origin is not None:
            path = _display_path(origin.model.place(of_user.out))
            text += f", for {path}:{origin.line}:{origin.column}"
        yield "  = ", _FRAME
        yield "note", "bold"
        yield f": {printable(text)}\n", ""


@cache
def _read_model(path: Path, expected_digest: str) -> tuple[Source | None, str]:
    """Source of a model as it was built, or a note that replaces its excerpt."""
    name = printable(path.name)
    source = read_source(path, None, Diagnostics())
    if source is None:
        return None, f"`{name}` is missing, so its line cannot be shown"
    if digest(source.text) != expected_digest:
        return None, f"`{name}` was edited after the build: the line may be wrong"
    return source, ""


def _display_path(path: Path) -> str:
    """Path relative to the current folder if it is inside."""
    here = Path.cwd()
    near = path.relative_to(here) if path.is_relative_to(here) else path
    return printable(os.fspath(near))


def _render(pieces: list[Piece], colour: bool) -> str:
    plain = "".join(text for text, _ in pieces)
    if not colour or not plain:
        return plain
    # Imported here because it is slow and only needed for colours.
    from rich.console import Console
    from rich.text import Text

    stream = StringIO()
    console = Console(
        file=stream, force_terminal=True, color_system="standard", highlight=False, soft_wrap=True
    )
    console.print(Text.assemble(*pieces), end="")
    return stream.getvalue()
