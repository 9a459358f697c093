"""What is said below a line of a log: the place in the model, with the line that stands there."""

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
from swarmdsl.tools.trace.generated_files import Generated
from swarmdsl.tools.trace.source_locations import Kind, Line, Mention

_STYLE = "bold cyan"
_FRAME = "blue"


class Notes:
    """Says of each place in a log where it comes from; of what was shown before it says less."""

    def __init__(self, colour: bool) -> None:
        self._colour = colour
        self._shown: set[object] = set()

    def below(self, line: Line, found: list[tuple[Mention, Generated]]) -> str:
        """The lines below a line that names generated files; each begins as that does."""
        pieces: list[Piece] = []
        for mention, file in found:
            if line.kind is not Kind.CHAIN:
                pieces += self._of(mention, file)
            elif (position := file.position(mention.line)) is not None:
                pieces += self._position(position, file, "", short=True)
        text = _drawn(pieces, self._colour)
        return "".join(f"{line.process}{each}\n" for each in text.splitlines())

    def _of(self, mention: Mention, file: Generated) -> Iterator[Piece]:
        name = file.path.rpartition("/")[2]
        if file.map.of_user:
            yield from self._note(file.path, f"`{name}` is yours to fill in", file)
        elif file.is_of_user(mention.line):
            yield from self._note(
                (file.path, mention.line), f"this line of `{name}` is yours: it was not generated"
            )
        elif (position := file.position(mention.line)) is not None:
            yield from self._position(position, file, "")
            if file.is_unknown:
                edited = f"`{name}` has been edited since: the place may be another one"
                yield from self._note((file.path, "edited"), edited)
        elif file.map.origin is not None:
            about = f"`{name}` as a whole is made for this"
            yield from self._position(file.map.origin, file, about)
        else:
            text = f"`{name}` is swarmc's, and stands for no single place in the model"
            yield from self._note(file.path, text)

    def _position(
        self, position: Position, file: Generated, about: str, *, short: bool = False
    ) -> Iterator[Piece]:
        path = position.model.place(file.out)
        gutter = len(str(position.line))
        yield f"{'':{gutter}}--> ", _FRAME
        yield f"{_shown_path(path)}:{position.line}:{position.column}\n", ""
        if short or (position, about) in self._shown:
            return
        self._shown.add((position, about))
        source, fault = _model(path, position.model.digest)
        if source is None:
            yield from self._note(path, fault)
            return
        start = source.line_starts[position.line - 1] + position.column - 1
        span = Span(source, start, start + position.length)
        # The first line, which says where it is, was told already.
        _, _, *excerpt = place(Label(span), gutter, "^", _STYLE, about)
        yield from excerpt

    def _note(self, key: object, text: str, of_user: Generated | None = None) -> Iterator[Piece]:
        if key in self._shown:
            return
        self._shown.add(key)
        origin = of_user.map.origin if of_user is not None else None
        if of_user is not None and origin is not None:
            path = _shown_path(origin.model.place(of_user.out))
            text += f", for {path}:{origin.line}:{origin.column}"
        yield "  = ", _FRAME
        yield "note", "bold"
        yield f": {printable(text)}\n", ""


@cache
def _model(path: Path, made_of: str) -> tuple[Source | None, str]:
    """The model as it was built, or what is said in place of its line."""
    name = printable(path.name)
    source = read_source(path, None, Diagnostics())
    if source is None:
        return None, f"`{name}` is not there to show the line"
    if digest(source.text) != made_of:
        return None, f"`{name}` has changed since it was built: the line may be another one now"
    return source, ""


def _shown_path(path: Path) -> str:
    """A path as a person in this folder writes it."""
    here = Path.cwd()
    near = path.relative_to(here) if path.is_relative_to(here) else path
    return printable(os.fspath(near))


def _drawn(pieces: list[Piece], colour: bool) -> str:
    plain = "".join(text for text, _ in pieces)
    if not colour or not plain:
        return plain
    # Imported here because it is slow and nobody else needs colours.
    from rich.console import Console
    from rich.text import Text

    stream = StringIO()
    console = Console(
        file=stream, force_terminal=True, color_system="standard", highlight=False, soft_wrap=True
    )
    console.print(Text.assemble(*pieces), end="")
    return stream.getvalue()
