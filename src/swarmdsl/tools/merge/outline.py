"""A file as a tree of declarations and statements that together are all of its text."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Sequence

from swarmdsl.base.records import dataclass
from swarmdsl.base.source import Source
from swarmdsl.syntax.ast import (
    Activity,
    BehaviorUse,
    Branch,
    Connector,
    Documented,
    Entry,
    EnvironmentUse,
    Exit,
    FitnessUse,
    ImportFile,
    ImportLibrary,
    ImportRos,
    Initial,
    Model,
    Node,
    Package,
    Transition,
    children,
)

Key = tuple[str, ...]
"""By what something is known again: its kind, and its name or what it is for."""

_COMMENT = re.compile(r"//[^\n]*|/\*(?:[^*]|\*(?!/))*\*/")
_REST_OF_LINE = re.compile(r"[ \t]*(?:/\*(?:[^*\n]|\*(?!/))*\*/[ \t]*)*(?://[^\n]*)?\n?")


@dataclass(frozen=True)
class Item:
    """A declaration or statement with all before it that belongs to nothing else.

    `lead` are the comments and blank lines above, `head` is the rest or, of a block, what is
    before its `inner` items; `tail` is what is behind these.
    """

    key: Key
    lead: str
    head: str
    inner: tuple[Item, ...] = ()
    tail: str = ""

    @property
    def text(self) -> str:
        """All of it."""
        return "".join((self.lead, self.head, *(each.text for each in self.inner), self.tail))


def outline(source: Source, model: Model) -> Item:
    """The items of a file without syntax errors; their text is that of the file."""
    text = source.text
    found = _cut(text, model, 0)
    inner, end = found if found is not None else ((), 0)
    return Item((), "", "", inner, text[end:])


def _cut(text: str, node: Node, start: int) -> tuple[tuple[Item, ...], int] | None:
    """The items in a block that begins at an offset, and where the last of them ends.

    None where it cannot be cut between them: several are on a line, or sections are around them.
    """
    nodes = sorted(
        (child for child in children(node) if isinstance(child, Documented)),
        key=lambda child: child.span.start,
    )
    if not nodes:
        return None
    items: list[Item] = []
    seen: Counter[Key] = Counter()
    at = start
    for child in nodes:
        if child.span.start < at or not _is_blank(text[at : child.span.start]):
            return None
        rest = _REST_OF_LINE.match(text, child.span.end)
        assert rest is not None  # it matches even nothing
        end = rest.end()
        if end < len(text) and text[end - 1] != "\n":
            return None
        key = _key(child)
        seen[key] += 1
        items.append(_item(text, child, (*key, str(seen[key])), at, end))
        at = end
    return tuple(items), at


def _item(text: str, node: Documented, key: Key, start: int, end: int) -> Item:
    line = text.rfind("\n", 0, node.span.start) + 1
    lead, own = text[start:line], max(start, line)
    opening = text.find("{", node.span.start, node.span.end)
    if opening >= 0:
        rest = _REST_OF_LINE.match(text, opening + 1)
        assert rest is not None
        found = _cut(text, node, rest.end()) if text[rest.end() - 1] == "\n" else None
        if found is not None and _is_blank(text[found[1] : node.span.end - 1]):
            inner, at = found
            return Item(key, lead, text[own : rest.end()], inner, text[at:end])
    return Item(key, lead, text[own:end])


def _is_blank(text: str) -> bool:
    return not _COMMENT.sub("", text).strip()


def _key(node: Documented) -> Key:
    kind = type(node).__name__
    match node:
        case Package() | Initial() | Entry() | Exit() | Activity() | BehaviorUse():
            return (kind,)
        case EnvironmentUse() | FitnessUse():
            return (kind,)
        case Transition(triggers=triggers):
            return kind, *(_words(each) for each in triggers)
        case Branch(guard=guard):
            return kind, _words(guard) if guard is not None else ""
        case Connector() | ImportFile() | ImportLibrary() | ImportRos():
            return kind, _words(node)
    name = getattr(node, "name", None)
    return (kind, str(name)) if name else (kind, _words(node))


def _words(node: Node) -> str:
    return " ".join(node.span.text.split())


def keys(items: Sequence[Item]) -> list[Key]:
    """The keys of items, in their order."""
    return [item.key for item in items]
