"""Document links: imports and world files."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from swarmdsl.base.read_files import is_file
from swarmdsl.base.source import Span
from swarmdsl.driver.workspace.references import owners
from swarmdsl.project.libraries import place_of
from swarmdsl.project.loader import File
from swarmdsl.syntax.ast import World, nodes_of


def document_links(file: File) -> Iterator[tuple[Span, Path]]:
    """Yield link spans with their target; an imported folder links to its first file."""
    seen = set()
    for statement, other in file.imports:
        if statement not in seen and other.source.path is not None:
            seen.add(statement)
            yield unquoted(place_of(statement).absolute), other.source.path
    for owner in owners(file):
        for world in nodes_of(owner, World):
            path = Path(file.source.name).parent / world.file
            if is_file(path):
                yield unquoted(world.file.span.absolute), path


def unquoted(span: Span) -> Span:
    """Return the span without its quotes."""
    quoted = span.text.startswith('"') and len(span.text) > 1
    return Span(span.source, span.start + 1, span.end - 1) if quoted else span
