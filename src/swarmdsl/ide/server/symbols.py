"""Document outline and workspace symbol search."""

from __future__ import annotations

from collections.abc import Iterator

from swarmdsl.analysis.node_kinds import KINDS, kind_name
from swarmdsl.base.records import dataclass
from swarmdsl.base.source import Span
from swarmdsl.driver.workspace import Workspace
from swarmdsl.driver.workspace.references import owners
from swarmdsl.project.loader import File
from swarmdsl.syntax.ast import Node, Optimization, children, name_of


@dataclass(frozen=True)
class Symbol:
    """Named element with its span, the span of its name, and its children."""

    name: str
    kind: type[Node]
    detail: str
    span: Span
    selection: Span
    inside: list[Symbol]


def outline(file: File) -> list[Symbol]:
    """Return the declarations of a file in source order."""
    found = [symbol for owner in owners(file) for symbol in symbols_of(owner)]
    return sorted(found, key=lambda symbol: symbol.span.start)


def search(workspace: Workspace, query: str) -> Iterator[Symbol]:
    """Yield symbols of a workspace whose name contains the letters of the query, in order."""
    for file in workspace.project.files:
        if file.source.path is not None and not file.library:
            work = outline(file)
            while work:
                symbol = work.pop(0)
                work[:0] = symbol.inside
                if _matches(query.lower(), symbol.name.lower()):
                    yield symbol


def _matches(query: str, name: str) -> bool:
    letters = iter(name)
    return all(letter in letters for letter in query)


def symbols_of(node: Node) -> Iterator[Symbol]:
    """Yield the symbols declared in a node, including the node itself if it is named."""
    inside = [symbol for child in children(node) for symbol in symbols_of(child)]
    if not isinstance(node, Optimization) and type(node) not in KINDS:
        yield from inside
        return
    if not isinstance(node, Optimization) and not name_of(node).span.text:
        yield from inside  # the name is not typed yet, and editors refuse an empty one
        return
    span = node.span.absolute
    if isinstance(node, Optimization):
        name = node.swarm.span.absolute
        yield Symbol(f"optimize {node.swarm.name}", type(node), "", span, name, inside)
    else:
        name = name_of(node).span.absolute
        yield Symbol(name.text, type(node), kind_name(node), span, name, inside)
