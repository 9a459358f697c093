"""Word that completion offers, with the text to insert and its place in the list."""

from __future__ import annotations

from swarmdsl.analysis.node_kinds import kind_name
from swarmdsl.base.records import dataclass
from swarmdsl.base.source import Span
from swarmdsl.syntax.ast import Node, TypeRef, name_of

# Places in the list; entries of the same rank stay in order.
BEST, LIKELY, POSSIBLE, KEYWORD, FUNCTION, UNLIKELY, IMPORTED = range(7)


@dataclass(frozen=True)
class Completion:
    """Word that fits at the cursor.

    `node` is its declaration, None for a keyword and for a built-in function.

    `text` is a snippet with fields (`${1:name}`) if the word alone is not enough. `replaced` is
    what it replaces, if not the word around the cursor. `added` is an import to add.
    """

    word: str
    detail: str
    node: Node | None = None
    text: str | None = None
    rank: int = LIKELY
    replaced: Span | None = None
    added: str | None = None


def entry_of(node: Node, text: str | None = None, word: str = "", rank: int = LIKELY) -> Completion:
    """Return the completion of a node, with its kind and type as detail."""
    type_ = getattr(node, "type", None)
    detail = kind_name(node)
    if isinstance(type_, TypeRef):
        detail += f" : {type_.span.text}"
    return Completion(word or str(name_of(node)), detail, node, text, rank)
