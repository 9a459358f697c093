"""Source maps in the manifest: model positions of generated lines.

Version 1 of the format is an object with the models, each as its path and a digest of its content,
and one string per file. Its first word is the position of the file as a whole, the others are
positions of its lines, each from that line on:

    {"models": [["../lab.swarm", "1f0c4a"]], "files": {"smach/lab/node.py": "0:3:9+4 12=0:5:3+8"}}

The file is from line 3 of the first model, column 9, 4 characters; its lines from 12 on are from
line 5. `-` means no position; the prefix `yours` marks a file that belongs to the user.
"""

# No annotated locals: typing would evaluate annotation strings one by one.
import os
import re
from collections.abc import Mapping
from hashlib import sha256
from pathlib import Path
from typing import NamedTuple

from swarmdsl.base import resources
from swarmdsl.base.read_files import is_file
from swarmdsl.base.records import dataclass
from swarmdsl.base.source import Source, Span
from swarmdsl.codegen.api import OutputFile
from swarmdsl.codegen.source_map import MappedText

VERSION = 1
_OURS = "swarmdsl:"
_YOURS = "yours"
_WORD = r"(?:([0-9]{1,9})=)?(?:-|([0-9]{1,9}):([0-9]{1,9}):([0-9]{1,9})\+([0-9]{1,9}))"


class Model(NamedTuple):
    """Model file: its path relative to the output folder, and a digest of its content.

    Paths of bundled libraries begin with `swarmdsl:`.
    """

    path: str
    digest: str

    def place(self, out: Path) -> Path:
        """Return its path, which may not exist."""
        if self.path.startswith(_OURS):
            return resources.library() / self.path.removeprefix(_OURS)
        return Path(os.path.normpath(out / self.path))


class Position(NamedTuple):
    """Position in a model: line and column from 1, and length in characters."""

    model: Model
    line: int
    column: int
    length: int


@dataclass(frozen=True)
class FileMap:
    """Positions of a file and of its lines, each from the given line on."""

    origin: Position | None = None
    lines: tuple[tuple[int, Position | None], ...] = ()
    of_user: bool = False

    def position(self, line: int) -> Position | None:
        """Return the position of a line, from 1; None if only that of the file is known."""
        found = None
        for first, position in self.lines:
            if first > line:
                break
            found = position
        return found


Maps = dict[str, FileMap]
"""Source maps by path below the output folder."""


class Positions:
    """Convert spans of models to positions relative to an output folder."""

    def __init__(self, out: Path) -> None:
        self._out = os.path.realpath(out)
        self._models: dict[Source, Model | None] = {}

    def file_map(self, file: OutputFile) -> FileMap:
        """Return the map of a generated file."""
        entries = file.text.entries if isinstance(file.text, MappedText) else ()
        lines = tuple((line, self._position(origin)) for line, origin in entries)
        return FileMap(self._position(file.origin), () if file.keep else lines, file.keep)

    def _position(self, origin: Span | None) -> Position | None:
        if origin is None:
            return None
        source, start, end = origin.absolute
        if source not in self._models:
            self._models[source] = self._model(source)
        model = self._models[source]
        if model is None:
            return None
        line, column = source.line_column(start)
        room = source.line_range(line)[1] - start
        return Position(model, line, column, max(1, min(end - start, room)))

    def _model(self, source: Source) -> Model | None:
        """Return the model of a source; None if it is not in a file."""
        if source.path is None or not is_file(source.path):
            return None
        place = os.path.realpath(source.path)
        ours = os.path.realpath(resources.library())
        if Path(place).is_relative_to(ours):
            path = _OURS + os.path.relpath(place, ours)
        else:
            try:
                path = os.path.relpath(place, self._out)
            except ValueError:  # on another drive
                path = place
        return Model(path.replace(os.sep, "/"), digest(source.text))


def digest(text: str) -> str:
    """Hash the content of a model."""
    return sha256(text.encode("utf-8", "surrogatepass")).hexdigest()[:12]


def to_json(maps: Mapping[str, FileMap]) -> dict[str, object]:
    """Serialize the maps."""
    positions = [
        position
        for each in maps.values()
        for position in (each.origin, *(position for _, position in each.lines))
        if position is not None
    ]
    models = sorted({position.model for position in positions})
    numbers = {model: number for number, model in enumerate(models)}
    files = {path: _written(each, numbers) for path, each in maps.items()}
    return {"version": VERSION, "models": [list(model) for model in models], "files": files}


def _written(file: FileMap, numbers: Mapping[Model, int]) -> str:
    def word(position: Position | None) -> str:
        if position is None:
            return "-"
        return f"{numbers[position.model]}:{position.line}:{position.column}+{position.length}"

    words = [_YOURS] if file.of_user else []
    words.append(word(file.origin))
    words += (f"{line}={word(position)}" for line, position in file.lines)
    return " ".join(words)


def from_json(data: object) -> Maps:
    """Deserialize maps; malformed entries are ignored."""
    match data:
        case {"version": 1, "models": [*models], "files": {**files}}:
            known = [
                Model(str(model[0]), str(model[1]))
                for model in models
                if isinstance(model, list) and len(model) == 2
            ]
            return {
                str(path): _read(text, known)
                for path, text in files.items()
                if isinstance(text, str)
            }
    return {}


def _read(text: str, models: list[Model]) -> FileMap:
    words = text.split()
    of_user = words[:1] == [_YOURS]
    origin: Position | None = None
    lines: list[tuple[int, Position | None]] = []
    read = re.compile(_WORD).fullmatch
    for word in words[of_user:]:
        found = read(word)
        if found is None:
            continue
        start, model, *place = found.groups()
        position = None
        if model is not None and int(model) < len(models):
            position = Position(models[int(model)], *(max(1, int(number)) for number in place))
        if start is None:
            origin = position
        else:
            lines.append((int(start), position))
    return FileMap(origin, tuple(lines), of_user)
