"""Files that a file names: what it imports, the world of an environment."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from swarmdsl.base.source import Span
from swarmdsl.driver.workspace.references import owners
from swarmdsl.project.libraries import place_of
from swarmdsl.project.loader import File
from swarmdsl.syntax.ast import World, nodes_of


def links(file: File) -> Iterator[tuple[Span, Path]]:
    """The places in a file that name others, and these; of a folder the first file in it."""
    seen = set()
    for statement, other in file.imports:
        if statement not in seen and other.source.path is not None:
            seen.add(statement)
            yield _inside(place_of(statement).absolute), other.source.path
    for owner in owners(file):
        for world in nodes_of(owner, World):
            path = Path(file.source.name).parent / world.file
            if path.is_file():
                yield _inside(world.file.span.absolute), path


def _inside(span: Span) -> Span:
    """What is between the quotes of a text."""
    quoted = span.text.startswith('"') and len(span.text) > 1
    return Span(span.source, span.start + 1, span.end - 1) if quoted else span
